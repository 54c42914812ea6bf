# A Young's modulus that is a formula in the coordinates: layers by a formula are those of two materials, by
# each method, elastic and plastic; one that is not positive somewhere, and one of a single point, are
# refused. A strength that is a part of the initial vertical stress is the gradient that it describes.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
scene=$root/tests/methods/stiffness_layers.prm
block() {
  "$program" "$scene" --quiet --output "$1" --set 'Output/If folder exists = overwrite' "${@:2}"
}
numbers() {  # FOLDER, without the time that was taken
  cut -d, -f4 --complement "$1/statistics.csv" | tr , '\n'
}
compared() {  # METHOD LAW
  call=(--set "Discretisation/Method = $1")
  both=()
  if [ "$2" = Mohr-Coulomb ]; then
    for name in upper lower; do
      both+=(--set "Materials/$name/Type = $2" --set "Materials/$name/Cohesion = 1000")
    done
  fi
  block layers "${call[@]}" "${both[@]}"
  block formula "${call[@]}" "${both[@]:0:4}" --set 'Materials/Names = upper' \
    --set 'Materials/upper/Young modulus formula = if(y > 0.5, 1e6, 3e6)'
  numbers layers > layers.txt
  numbers formula > formula.txt
  numdiff -q -r 1e-7 -a 1e-7 layers.txt formula.txt
  [ "$(wc -l < formula.txt)" -gt 100 ]
}
compared FEM Mohr-Coulomb
compared MPM Mohr-Coulomb
compared 'explicit MPM' Mohr-Coulomb
compared 'explicit MPM' 'linear elastic'

refused() {  # FORMULA OPTION ...
  fails "$program" "$scene" --dry-run --output none --set 'Materials/Names = upper' \
    --set "Materials/upper/Young modulus formula = $1" "${@:2}" 2> said
}
refused '1e6 * (0.5 - y)'
grep -q 'E > 0 Pa everywhere; here it is' said
refused '1e6 * t'
grep -q 'Young modulus formula' said
fails "$program" "$root/prm/element/biaxial_mohr_coulomb.prm" --output none 2> said \
  --set 'Materials/sand/Young modulus formula = 1e6'
grep -q 'a single point has no position' said

clay() {  # FOLDER OPTION ...
  "$program" "$root/tests/fem/growing_block-01.prm" --quiet --output "$1" \
    --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
    --set 'Materials/clay/Type = Tresca' --set 'Loading/squeeze/Duration = 2' \
    --set 'Gravity/Acceleration = 0, -10' --set 'Materials/clay/Density = 1000' \
    --set 'Initial stress/Type = geostatic' --set 'Initial stress/Surface level = 1' "${@:2}"
}
clay gradient --set 'Materials/clay/Cohesion formula = max(1000, 2500 * (1 - y))' \
  --set 'Materials/clay/Cohesion gradient = 0'
clay ratio --set 'Materials/clay/Cohesion ratio = 0.25' --set 'Materials/clay/Cohesion gradient = 0'
numbers gradient > gradient.txt
numbers ratio > ratio.txt
numdiff -q -r 1e-9 -a 1e-9 gradient.txt ratio.txt
fails "$program" "$root/tests/fem/growing_block-01.prm" --dry-run --output none \
  --set 'Materials/clay/Cohesion ratio = 0.25' 2> said
grep -q "Cohesion ratio' = '0.25'" said
