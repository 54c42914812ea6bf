# Cycles by finite elements decide what the shakedown factor of the strip, 1, says: with 0.95 times the loads
# its end moves no further after some cycles, with 1.05 times it moves on by the same in each.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for factor in 0.95 1.05; do
  "$program" "$root/prm/shakedown/strip_steps.prm" --quiet --output "$factor" \
    --set 'Output/Pictures = false' --set 'Output/Fields = false' \
    --set 'Loading/cycles/Duration = 11' --set 'Loading/cycles/Step size = 0.25' \
    --set "Tractions/tension/Traction x = $factor*1500*min(1, t)" \
    --set "Tractions/moment/Traction x = $factor*2000*y*min(1, t)*cos(pi*t)" > said 2>&1
done
python3 - << 'END'
import csv


def growth(folder, first, last):
    """Displacement of the end between two times."""
    with open(f"{folder}/statistics.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    at = {round(float(row["time (s)"]), 6): float(row["displacement of point 1 x (m)"])
          for row in rows}
    return at[last] - at[first]


assert abs(growth("0.95", 9., 11.)) < 1e-12, growth("0.95", 9., 11.)
each, last = growth("1.05", 7., 9.), growth("1.05", 9., 11.)
assert last > 1e-4 and abs(last / each - 1.) < 0.05, (each, last)
END
