# Values that no solver can use are refused by name before anything is written, also
# where they concern a method that does not run; a tolerance at the edge of what a
# computer's numbers allow ends at the floor of rounding.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  timeout 60 "$program" "$root/tests/footing_coarse.prm" --quiet \
    --set 'Output/Report for tests = none' --set 'Loading/push/Duration = 0.02' \
    --set 'Mesh/Cell size = 0.5' --set 'Time stepping/Maximum halvings = 0' \
    --set 'Boundary conditions/footing/Box = 0, -0.1; 0.5, 0.1' \
    --set 'Observation/Reference = 5000' --output results "$@" >log 2>&1
}
refused() {
  if run --set "$1"; then echo "accepted: $1"; exit 1; fi
  entry=${1%% =*}
  if ! grep -q "${entry##*/}" log; then cat log; exit 1; fi
  if [ -e results ]; then echo "written: $1"; exit 1; fi
}
while read -r setting; do refused "$setting"; done <<'END'
Output/Freeze steps = -1
Output/Freeze steps = 0
Output/Freeze steps = 2
Newton/Tolerance = 1e-300
Newton/Tolerance = 2
Newton/Tolerance = nan
Newton/Absolute tolerance = -1
Newton/Absolute tolerance = 1e300
Newton/Maximum iterations = -1
Newton/Maximum iterations = 4000000000
Newton/Rho = 1e300
Newton/Rho = 0
Newton/First iterate sweeps = 0
Newton/First iterate sweeps = 4000000000
Newton/Formulation = dual
Newton/Globalisation = hope
Newton/First iterate = zero
Linear solver/Name = Pardiso
Time stepping/Friction = implicit
Materials/soil/Friction memory = nan
Materials/soil/Friction memory = -1
Material point method/Transfer = TPIC
Material point method/FLIP part = 2
Material point method/Advection = grid
Material point method/Consistent mass part = -0.1
Material point method/Integration = Runge-Kutta
Material point method/Start = zero
Explicit/Order = MUSCL
Material point method/FLIP part = -1
Explicit/Time step = -1
Explicit/Largest strain increment = -1
Explicit/Sort every = 0
END

run --set 'Newton/Tolerance = 1e-15'
grep -q '"steps_at_rounding_floor": 1' results/summary.json
rm -r results
# Far-off values that are allowed end with a reason.
for setting in 'Newton/Rho = 1e6' 'Newton/Rho = 1e-6'; do
  run --set "$setting" --set 'Newton/Formulation = natural map' ||
    grep -q 'remedy: ' log
  rm -rf results
done
