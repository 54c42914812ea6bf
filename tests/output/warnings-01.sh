# A run that starts with a stress outside of the strength says so, once, and goes on;
# so does one whose midpoint rule goes with particles that move by their own velocity.
program=$1 root=$2 folder=$3
. "$root/tests/fails.sh"
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/footing_coarse.prm" \
    --set 'Output/Report for tests = none' --set 'Initial stress/Type = given' \
    --set 'Loading/push/Duration = 0.02' "$@" >log 2>&1
}
# c = 2 kPa, phi = 25: a shear stress of 10 kPa is too much at 10 kPa of pressure.
stress() {
  run --set "Initial stress/Stress xx = $1" --set "Initial stress/Stress yy = $2" \
    --output "run$1$2"
}
stress -1000 -30000
[ "$(grep -c 'initial stress of .* points is outside of the strength' log)" = 1 ]
grep -q "material 'soil'" log
stress -10000 -10000
fails grep -q 'outside of the strength' log

# Gravity that grows has no released potential energy.
slope() {
  "$program" "$root/prm/slope_associated.prm" --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Loading/fall/Duration = 0.25' "$@" >log 2>&1
}
slope --set 'Material point method/Integration = midpoint' --output grid
fails grep -q 'lets the total energy grow' log
grep -q '"released_potential_J_per_m": [0-9]' grid/summary.json
slope --set 'Material point method/Integration = midpoint' --output particles \
  --set 'Material point method/Advection = particle velocity' \
  --set 'Gravity/Ramp duration = 1'
[ "$(grep -c 'lets the total energy grow' log)" = 1 ]
grep -q '"released_potential_J_per_m": null' particles/summary.json

# A body without cohesion that begins outside of its strength fails by name of that
# cause; the automatic K0 of its friction angle is inside.
ground() {
  "$program" "$root/tests/footing_coarse.prm" --set 'Output/Report for tests = none' \
    --set 'Materials/soil/Friction angle = 15' --set 'Materials/soil/Cohesion = 0' \
    --set 'Materials/soil/Dilatancy angle = 15' --set 'Mesh/Cell size = 0.5' \
    --set 'Boundary conditions/footing/Box = 0, -0.1; 0.5, 0.1' \
    --set 'Observation/Reference = none' --set 'Gravity/Acceleration = 0, -10' \
    --set 'Initial stress/Type = geostatic' --set 'Loading/push/Duration = 0.02' \
    --set 'Loading/push/Step size = 1e-5' \
    --set 'Newton/Maximum iterations = 2' --set 'Time stepping/Maximum halvings = 0' \
    "$@" >log 2>&1
}
if ground --output k0; then exit 1; fi
grep -q "cause: .*initial stress of .* points is outside .*'Initial stress/K0' = automatic" log
ground --set 'Initial stress/K0 = automatic' --output automatic || true
fails grep -q 'outside of the strength' log

# The mesh from the bounds begins with triangles of the cell size, or graded to the given
# points.
"$program" "$root/prm/safety/slope_steps.prm" --dry-run --set 'Mesh/Number of cells = 50' \
  --set 'Mesh/Cell size = 4' >log 2>&1
grep -q 'a mesh from the bounds: level' log
fails grep -q 'not used by this run' log
"$program" "$root/tests/fem/prandtl_adapted-01.prm" --output bounds \
  --set 'Mesh/Number of cells = 50' --set 'Output/Expectations =' >log 2>&1
fails grep -q 'not used by this run' log

# In explicit steps splines with B-bar make soil that dilates too strong; soil that keeps its
# volume they suit.
bar() {
  "$program" "$root/prm/validation/vertical_cut_explicit.prm" \
    --set 'Discretisation/Element = B-spline 2' \
    --set 'Mesh/Cell size = 0.25' --set 'Loading/stand/Duration = 0.01' \
    --set 'Materials/clay/Type = Mohr-Coulomb' --set 'Materials/clay/Friction angle = 25' \
    --set 'Output/Pictures = false' --set 'Output/Fields = false' \
    --set 'Output/Expectations = ' "$@" >log 2>&1
}
bar --set 'Materials/clay/Dilatancy angle = 25' --output dilatant
[ "$(grep -c 'B-bar makes soil that dilates too strong' log)" = 1 ]
bar --set 'Materials/clay/Dilatancy angle = 0' --output isochoric
fails grep -q 'B-bar makes' log

# Values that are not linear in space are not interpolated by Bernstein's polynomials.
plate() {
  "$program" "$root/prm/verification/elastic_plate.prm" --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Output/Expectations =' \
    --set 'Mesh/Cell size = 0.5' "$@" >log 2>&1
}
plate --output lagrange
fails grep -q 'are not linear in space' log
plate --set 'Discretisation/Basis = Bernstein' --output bernstein
[ "$(grep -c 'are not linear in space' log)" = 1 ]

# Bounds take the loads of obstacles at t = 0.
block() {
  "$program" "$root/prm/safety/slope_block.prm" --set 'Analysis/Kind = strength reduction' \
    --set 'Mesh/Type = unstructured' --set 'Output/Expectations =' \
    --set 'Analysis/Maximum levels = 1' --set 'Output/Pictures = false' "$@" >log 2>&1
}
block --output full
fails grep -q 'is zero at t = 0' log
block --output ramp --set 'Obstacles/block/Force y = -60000*min(t, 1)'
[ "$(grep -c "load of the obstacle 'block' is zero at t = 0" log)" = 1 ]

# A quarter of a footing, 0.1 m wide at 0.02 m/s, remembers as the whole one of 0.2 m does.
"$program" "$root/prm/three/square_footing.prm" --dry-run --set 'Discretisation/B-bar = false' \
  --set 'Materials/soil/Type = Mohr-Coulomb' --set 'Materials/soil/Friction angle = 25' \
  --set 'Materials/soil/Dilatancy angle = 0' >log 2>&1
grep -q 'friction has a memory of 0.01 s' log

# Explicit steps that create energy say so, once; energies that grow and are half a step
# apart do not.
created() {
  name=$1
  shift
  "$program" "$root/prm/$name.prm" --set 'Output/Pictures = false' \
    --set 'Output/Fields = false' --set 'Output/Expectations =' "$@" >log 2>&1
}
created explicit/two_discs --set 'Explicit/Order = USL' --set 'Discretisation/Element = Q1' \
  --set 'Loading/flight/Duration = 1.5' --output discs
[ "$(grep -c 'the numerical method has created' log)" = 1 ]
created verification/absorbing_column_explicit --output column
fails grep -q 'the numerical method has created' log

# The bounded load is the reaction along the velocity; the load of steps may be another one.
observed() {
  "$program" "$root/prm/limit_load/footing_rough.prm" --dry-run "$@" >log 2>&1
}
observed
fails grep -q 'the bounded load is' log
observed --set 'Observation/Component = x'
grep -q 'bounded load is 2 times the reaction in the direction (0, -1) .* component x' log
observed --set 'Observation/Factor = 2'
grep -q 'the load of steps is 2 times its component y' log

# Values in other units.
magnitude() {
  "$program" "$root/prm/safety/slope_water.prm" --dry-run --set "$1" >log 2>&1
}
magnitude 'Water/Unit weight = 9.81'
grep -q 'water weighs 9.81 N/m^3 .* about 10000 N/m^3' log
magnitude 'Gravity/Acceleration = 0, -9810'
grep -q 'gravity is 9810 m/s^2' log
magnitude 'Output/Pictures = false'
fails grep -Eq 'weighs|gravity (is|acts)|is it meant' log

# Soil that drains is not called undrained.
dilating() {
  "$program" "$root/prm/consolidation/terzaghi.prm" --dry-run \
    --set 'Materials/clay/Type = Mohr-Coulomb' --set 'Materials/clay/Cohesion = 1e4' \
    --set 'Materials/clay/Friction angle = 20' --set 'Materials/clay/Dilatancy angle = 20' \
    --set "Time stepping/Consolidation = $1" >log 2>&1
}
dilating true
fails grep -q 'the undrained soil' log
dilating false
grep -q "the undrained soil 'clay' dilates" log
