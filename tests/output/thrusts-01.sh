# Thrusts of pore water that no equation has are said: on sides that are closed and dry
# outside, on free obstacles, on plates at a side, and where the pressure jumps within a cell.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
says() { # TEXT CALL...
  "$program" "${@:2}" --quiet --dry-run 2>err
  grep -q "warning: $1" err
}

# Water of 4 m at rest, which only the left side knows: u = 9810 (4 - y), 78.48 kN/m.
block=("$root/tests/limit_load/closed_side-01.prm" --set 'Tractions/Names =')
says "the side 'right' is not in 'Seepage', .* up to 3.9[0-9]*e+04 Pa, 7.84[78]e+04 N/m" "${block[@]}"
fails says 'the side' "${block[@]}" --set 'Seepage/Names = left, right' \
  --set 'Seepage/right/Sides = right' --set 'Seepage/right/Level = none'
fails says 'the side' "${block[@]}" --set 'Tractions/Names = closed' \
  --set 'Tractions/closed/Traction normal = 9810*(4-y)'

# A wall of 4 m, 0.4 m wide, with water to its top behind it and to the ground before it:
# 80 and 20 kN/m, uplift of 2 to 4 m of water, about its centre.
wall=("$root/prm/safety/excavation_wall_bounds.prm"
  --set 'Water/Table = -8, 0; -0.2, 0; 0.2, 2; 8, 2' --set 'Water/Unit weight = 10000')
says "obstacles feel .* 'Force x' = -6e+04, 'Force y' = 1.2e+04 and 'Moment' = -2.64e+04" "${wall[@]}"

# A plate on the left side of a body of 5 m, and a line of water that falls before it.
plate=("$root/tests/footing_coarse.prm" --set 'Geometry/Box = 0, 0; 10, 5'
  --set 'Mesh/Cell size = 0.5' --set 'Mesh/Grading points =' --set 'Boundary conditions/Names = bottom, sides' --set 'Boundary conditions/sides/Sides = right'
  --set 'Observation/Conditions =' --set 'Observation/Reference = none'
  --set 'Structures/Names = wall' --set 'Structures/wall/Type = plate'
  --set 'Structures/wall/Points = 0, 0; 0, 5' --set 'Structures/wall/Axial stiffness = 1e8'
  --set 'Structures/wall/Bending stiffness = 1e8' --set 'Water/Table = 0, 5'
  --set 'Gravity/Acceleration = 0, -9.81')
says "the plate 'wall' is on a side .* -1.22[67]e+05, " "${plate[@]}"
fails says 'the plate' "${plate[@]}" --set 'Structures/wall/Points = 5, 0; 5, 5'
# Lines that fall by 1.2 m or 11.8 kPa within a millimetre, on an edge of cells, and over two cells.
table='Water/Table = 0, 1.8; 1.9995, 1.8; 2.0005, 0.6; 4, 0.6'
says 'the pore pressure changes by 6050 Pa within the cell at (2.1' "${plate[@]}" --set "$table"
fails says 'the pore pressure changes' "${plate[@]}" \
  --set 'Water/Table = 0, 1.8; 1.5, 1.8; 2.5, 0.6; 4, 0.6'
