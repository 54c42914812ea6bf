# Effects of the constants of the slope cut: known ones are found, and which cannot be told
# from each other; the design of the study is what its variants say.
program=$1 source=$2 folder=$3
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
PYTHONPATH=$source/python /usr/bin/python3 -B "$source/tests/study/effects.py" \
  "$source/studies/slope_cut_parameters.toml"
