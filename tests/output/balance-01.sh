# Supports that share corners with one or two others: each nodal force counts once, so
# that reactions and loads, and their moments, are in balance, on 1 and 2 ranks, by FEM
# and MPM, and for particles held by rows beside a plane of nodes. What two ranks find is
# what one does.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() # NAME RANKS OPTION ...
{
  local name=$1 ranks=$2 launcher=()
  shift 2
  [ "$ranks" = 1 ] || launcher=(mpirun -np "$ranks")
  local options=()
  for option in "$@"; do options+=(--set "$option"); done
  "${launcher[@]}" "$program" "$root/tests/output/balance.prm" --quiet \
    --output "$name-$ranks" "${options[@]}"
}
mpm=('Discretisation/Method = MPM' 'Discretisation/Element = B-spline 2'
  'Mesh/Box = 0, 0; 2, 1' 'Particles/Layout = Gauss'
  'Tractions/load/Traction x = 0' 'Tractions/load/Traction y = 0')
for ranks in 1 2; do
  run FEM $ranks
  run Q3 $ranks 'Discretisation/Element = Q3'
  run nodes $ranks "${mpm[@]}"
  for imposition in points 'cell averages' segments; do
    run "${imposition/ /_}" $ranks "${mpm[@]}" \
      "Boundary conditions/plate/Imposed on = $imposition" \
      'Boundary conditions/Names = plate, bottom, right, left, corner' \
      'Boundary conditions/left/Velocity y = free' \
      'Boundary conditions/plate/Velocity x = free'
  done
done
/usr/bin/python3 - <<'PYTHON'
import csv
names = "bottom", "right", "plate", "left", "corner"
failed = False
for run in "FEM", "Q3", "nodes", "points", "cell_averages", "segments":
    lines = []
    for ranks in 1, 2:
        lines.append({key: float(value) for key, value in list(
            csv.DictReader(open(f"{run}-{ranks}/statistics.csv")))[-1].items()})
        row = lines[-1]
        R = [sum(row[f"reaction {name} {d} (N/m)"] for name in names) for d in "xy"]
        M = sum(row[f"moment {name} (N m/m)"] for name in names)
        scale = sum(abs(row[f"reaction {name} {d} (N/m)"]) for name in names
                    for d in "xy")
        # Weight 2 m^2 x 2000 kg/m^3 at (1, 0.5); tractions over 0.5 m at (2, 0.75); the
        # moment is about (0.3, -0.2).
        fem = run in ("FEM", "Q3")
        load = [4000. - fem * 1500., -40000. + fem * 500.]
        moment = 0.7 * -40000. - 0.7 * 4000. + fem * (1.7 * 500. + 0.95 * 1500.)
        # The file has 12 digits; particles have inertia, and move a little.
        limit = 1e-11 if fem else 1e-7
        defects = [abs(R[0] + load[0]), abs(R[1] + load[1]), abs(M + moment)]
        good = max(defects) <= limit * scale
        failed = failed or not good
        print(run, ranks, ["%.1e" % (d / scale) for d in defects],
              "" if good else "FAILED")
    for key in lines[0]:
        if key.startswith(("reaction", "moment")):
            if abs(lines[0][key] - lines[1][key]) > 1e-8 * scale:
                failed = True
                print(run, key, lines[0][key], "on one,", lines[1][key], "on two ranks")
raise SystemExit(failed)
PYTHON
