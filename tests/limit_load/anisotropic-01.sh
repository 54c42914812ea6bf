# Undrained strengths by direction: nearly equal ones give the load of Tresca's law in as many
# factorisations, whatever their angle; axes that are turned by 90 degrees exchange the strengths;
# loads of ellipses with several ratios are between the bounds, which are proved from their files
# by the script that does not use the program (anisotropic.py).
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
/usr/bin/python3 -B "$root/tests/limit_load/anisotropic.py" "$program" "$root"
