# A block of von Mises soil is sheared and squeezed in plane strain, where the stress s_zz
# grows with the plastic strain: FEM, particles that stay and particles that move have
# the same dissipation, and no step creates energy. (Particles once told their plastic
# strain from s_zz at the end of the step: twice the dissipation.)
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
run() {
  "$program" "$root/tests/methods/hardening.prm" --quiet --output "$@" \
    --set 'Materials/soil/Type = von Mises' --set 'Materials/soil/Hardening modulus = 0' \
    --set 'Initial velocity/Velocity y = -1e-4*y' \
    --set 'Boundary conditions/sides/Velocity y = -1e-4*y'
}
run fem
run stay --set 'Discretisation/Method = MPM' \
  --set 'Material point method/Advection = none'
run move --set 'Discretisation/Method = MPM'
/usr/bin/python3 - <<'PYTHON'
import json

energy = {name: json.load(open(f"{name}/summary.json"))["energy"]
          for name in ("fem", "stay", "move")}
exact = energy["fem"]["dissipation_J_per_m"]
assert exact > 0.1 * energy["fem"]["external_work_J_per_m"], energy
for name, allowed in (("fem", 0.), ("stay", 1e-6), ("move", 1e-3)):
    found = energy[name]["dissipation_J_per_m"]
    assert abs(found / exact - 1.) <= allowed, (name, found, exact)
    assert energy[name]["least_step_loss_relative"] >= 0., (name, energy[name])
PYTHON
