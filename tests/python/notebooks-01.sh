# The notebooks run from the first cell to the last, with coarse meshes, and show what they
# promise: loads above Prandtl's, brackets that hold what is known, strengths of closed form.
root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder/pages" && cd "$folder"
export PYTHONPATH=$root/python PYTHONDONTWRITEBYTECODE=1 IPYTHONDIR=$folder/ipython
export PYDEVD_DISABLE_FILE_VALIDATION=1
export JUPYTER_RUNTIME_DIR=$folder/runtime JUPYTER_CONFIG_DIR=$folder/config
/usr/bin/python3 "$root/tests/python/notebooks.py" "$root/doc/notebooks" pages > said
[ "$(xargs < said)" = 'calibration element_tests footing slope_factor_of_safety' ]
