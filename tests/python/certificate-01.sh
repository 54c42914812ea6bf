# Bounds are verified from the files of their fields by a script that does not use the program:
# a reaction, live weight with a cut-off, a factor of safety with water, obstacles on sand with a
# dead load. Fields, loads and strengths that were changed are found.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/prm/$1.prm" --quiet --output "$2" --set 'Output/Certificates = true' \
    --set 'Analysis/Maximum levels = 1' --set 'Analysis/Gap tolerance = 9' \
    --set 'Output/Fields = false' --set 'Output/Pictures = false' --set 'Output/Expectations =' \
    --set 'Reference/Quantity =' || exit 1
}
run limit_load/footing_rough reaction
run limit_load/vertical_cut_tension weight
run safety/slope_water factor
run limit_load/trapdoor obstacles
/usr/bin/python3 -B "$root/tests/python/certificate.py" "$root/scripts/check_certificate"
