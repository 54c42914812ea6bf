# Sixty cases of scripts/fuzz: nothing crashes, hangs, is silently wrong or writes
# outside of the run's folder, and each refusal has a remedy.
program=$1 root=$2 folder=$3
rm -rf "$folder"
"$root/scripts/fuzz" --program "$program" --output "$folder" --jobs 1 --verbose \
  --seed 1 --values 20 --pairs 10 --names 10 --files 2
