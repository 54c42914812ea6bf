# Some thirty cases of scripts/fuzz whose end is known: formulas, names, one scene described in two
# ways, study files, and foreign files in the folder of a run.
program=$1 root=$2 folder=$3
rm -rf "$folder"
"$root/scripts/fuzz" --program "$program" --output "$folder" --jobs 1 --verbose \
  --seed 2 --formulas 9 --titles 5 --descriptions 5 --studies 8 --foreign 4
