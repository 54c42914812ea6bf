# Samples of random soil have pictures and a page of their own: those of time steps ended in an error.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
"$program" "$root/prm/reliability/slope.prm" --quiet --output run --set 'Analysis/Samples = 8' \
  --set 'Analysis/Maximum levels = 1' --set 'Mesh/Cell size = 4' \
  --set 'Materials/clay/Cohesion = 25000' > said 2>&1
for name in model.png reliability.png sample.png report.html; do
  [ -s "run/$name" ]
  grep -qx "$name" run/files.txt
done
