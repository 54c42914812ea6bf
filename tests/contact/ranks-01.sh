# Two ranks find what one does, in each step and to 1e-8 of the largest value of the same unit in
# statistics.csv: a block of particles that slides over a base of particles, so that pairs of nodes
# that touch go over from the first rank to the second, and sand of particles that yields
# before a rough wall. Newton's tolerance is such that what iterations leave is below this.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME SCENE OPTION
{
  local ranks launcher
  for ranks in 1 2; do
    launcher=()
    [ "$ranks" = 1 ] || launcher=(mpirun -np "$ranks")
    "${launcher[@]}" "$program" "$root/tests/contact/$2.prm" --quiet --output "$1-$ranks" \
      --set 'Output/Report for tests = none' --set 'Output/Expectations =' \
      --set 'Newton/Tolerance = 1e-12' --set "$3" 2>"$1-$ranks.err" || { cat "$1-$ranks.err"; exit 1; }
  done
}
run block incline_bodies-MPM-01 'Loading/slide/Step size = 0.02'
run wall wall_passive_rough-MPM-01 'Loading/push/Step size = 0.2'
/usr/bin/python3 - <<'PYTHON'
import csv

# Not compared: how many iterations an error of rounding more or less takes, and points that
# are on their cone, which rounding may count or not; the largest plastic strain, since
# velocities of a flow need not be unique.
LEFT_OUT = ("iterations (-)", "plastic points (-)", "apex points (-)", "largest plastic strain (-)")
# What rounding and iterations leave of nothing: small on both.
DEFECTS = ("residual", "excess", "error", "violation", "complementarity", "penetration")
faults = []
for name in "block", "wall":
    one, two = (list(csv.DictReader(open(f"{name}-{ranks}/statistics.csv")))
                for ranks in (1, 2))
    assert len(one) == len(two) > 9 and list(one[0]) == list(two[0])
    table = [{column: [float(row[column]) for row in rows] for column in one[0]}
             for rows in (one, two)]
    largest = {column: max(map(abs, values)) for column, values in table[0].items()}
    unit = lambda column: column.rpartition("(")[2]
    scale_of = {}
    for column, size in largest.items():
        scale_of[unit(column)] = max(size, scale_of.get(unit(column), 0.))
    compared = 0
    for column in one[0]:
        if column in LEFT_OUT:
            continue
        a, b = (values[column] for values in table)
        if any(word in column for word in DEFECTS):
            if max(map(abs, a + b)) > 1e-7:
                faults.append((name, column, largest[column]))
            continue
        # Energies are parts of one balance, some of them differences, and of forces some are
        # nothing but rounding.
        scale = scale_of[unit(column)]
        apart = max(abs(x - y) for x, y in zip(a, b))
        compared += 1
        if apart > 1e-8 * scale:
            faults.append((name, column, scale, apart))
    print(name, len(one), "steps,", compared, "columns compared")
    assert compared > 15
assert not faults, faults
PYTHON
