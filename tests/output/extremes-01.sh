# Values that no solver can use are refused by name before anything is written, also
# where they concern a method that does not run; a tolerance at the edge of what a
# computer's numbers allow ends at the floor of rounding.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
coarse=('Output/Report for tests = none' 'Loading/push/Duration = 0.02' 'Mesh/Cell size = 0.5'
  'Time stepping/Maximum halvings = 0' 'Boundary conditions/footing/Box = 0, -0.1; 0.5, 0.1'
  'Observation/Reference = 5000')
scene() { # SETTING ...: the lines of a parameter file
  echo "include $root/tests/footing_coarse.prm"
  local setting path
  for setting; do
    path=${setting%% =*}
    printf '%s\n' "$path" | tr '/' '\n' | sed '$d;s/^/subsection /'
    echo "set ${path##*/} =${setting#* =}"
    printf '%s\n' "$path" | tr '/' '\n' | sed '$d;s/.*/end/'
  done
}
run() {
  scene "${coarse[@]}" >coarse.prm
  timeout 60 "$program" coarse.prm --quiet --output results "$@" >log 2>&1
}
refused() {
  if run --set "$1"; then echo "accepted: $1"; exit 1; fi
  entry=${1%% =*}
  if ! grep -q "${entry##*/}" log; then cat log; exit 1; fi
  if [ -e results ]; then echo "written: $1"; exit 1; fi
}
cat >settings <<'END'
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
# One call checks all of them. What is wrong only when the run begins is run.
n=10
while read -r setting; do
  scene "${coarse[@]}" "$setting" >$((n++)).prm
done <settings
fails "$program" --check [1-9]*.prm >said 2>&1
n=10
while read -r setting; do
  sed -n "/^$n\.prm: /,/^$((n + 1))\.prm: /p" said | sed '/^error: /,/remedy:/!d' >error
  if [ -s error ]; then
    entry=${setting%% =*}
    grep -q "${entry##*/}" error || { echo "$setting"; cat error; exit 1; }
  else
    refused "$setting"
  fi
  n=$((n + 1))
done <settings
[ ! -e results ]

run --set 'Newton/Tolerance = 1e-15'
grep -q '"steps_at_rounding_floor": 1' results/summary.json
rm -r results
# Far-off values that are allowed end with a reason.
for setting in 'Newton/Rho = 1e6' 'Newton/Rho = 1e-6'; do
  run --set "$setting" --set 'Newton/Formulation = natural map' ||
    grep -q 'remedy: ' log
  rm -rf results
done
