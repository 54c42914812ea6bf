# Where no file can be larger than 16 kB, as where the disk is full, a run ends with
# one message, exit code 1, and no crash, in each format of the fields and on two
# ranks, too. No part of a file is left.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
limited() {
  (
    # What MPI keeps in files of its own is larger.
    export PMIX_MCA_gds=hash OMPI_MCA_btl=^vader
    trap '' XFSZ
    ulimit -f 16
    "$@"
  )
}
for scene in tests/footing_coarse.prm prm/footing_mpm.prm; do
  for format in vtu hdf5; do
    for ranks in 1 2; do
      name=$(basename $scene .prm)-$format-$ranks
      # On two ranks each method and each format once.
      case $name in footing_coarse-hdf5-2 | footing_mpm-vtu-2) continue ;; esac
      call=("$program")
      [ $ranks = 1 ] || call=(mpirun -np $ranks "$program")
      code=0
      limited "${call[@]}" "$root/$scene" --quiet --output "$name" \
        --set 'Output/Report for tests = none' --set 'Output/Pictures = false' \
        --set 'Output/Fields = true' --set "Output/Fields format = $format" \
        --set 'Loading/push/Duration = 0.02' >"$name.out" 2>&1 || code=$?
      [ $code = 1 ] || { echo "$name: exit code $code"; cat "$name.out"; exit 1; }
      grep -q "error: .*the file '$name/.*cannot be written: " \
        "$name.out" || { echo "$name:"; cat "$name.out"; exit 1; }
      fails grep -q 'HDF5-DIAG\|Segmentation\|signal' "$name.out"
      fails ls "$name"/*.part 2>/dev/null
    done
  done
done
