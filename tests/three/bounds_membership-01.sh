# Stresses of lower bounds at random points of all tetrahedra do not exceed the strength, whose
# formulas stand here again, and reach it somewhere; they are in equilibrium with the weight.
program=$1 root=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
for law in Mohr-Coulomb Drucker-Prager
do
  "$program" "$root/tests/three/bounds_solver.prm" --quiet --output "$law" \
    --set "Materials/clay/Type = $law" --set 'Analysis/Stresses = quadratic' \
    --set 'Output/Certificates = true'
done
/usr/bin/python3 -B - <<'PYTHON'
import json
import numpy as np

random = np.random.default_rng(1)
for law in "Mohr-Coulomb", "Drucker-Prager":
    with open(f"{law}/certificate_lower.json") as file:
        data = json.load(file)
    x = np.array(data["vertices"])[np.array(data["tetrahedra"])]
    coefficients = np.array(data["stress"])[..., [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    pairs = np.array(data["nodes"])

    def stress(w):  # Bernstein: w_i^2 and 2 w_i w_j
        basis = (1. + (pairs[:, 0] != pairs[:, 1])) * w[..., pairs[:, 0]] * w[..., pairs[:, 1]]
        return np.einsum("tqn,tnab->tqab", basis, coefficients)

    w = random.dirichlet(np.full(4, 0.5), (len(x), 500))
    s = stress(w)
    of = data["materials"][0]
    if law == "Mohr-Coulomb":
        e, phi = np.linalg.eigvalsh(s), np.radians(of["friction_angle"])
        share = ((1. + np.sin(phi)) * e[..., 2] - (1. - np.sin(phi)) * e[..., 0]) / (
            2. * of["cohesion"] * np.cos(phi))
    else:
        p = np.trace(s, axis1=-2, axis2=-1) / 3.
        share = (np.linalg.norm(s - p[..., None, None] * np.eye(3), axis=(-2, -1)) +
                 of["slope"] * np.sqrt(3.) * p) / of["strength"]
    print(law, "largest share of the strength at 12000 points:", share.max())
    assert 0.9 < share.max() <= 1. + 1e-9, law

    # div s + b = 0 by central differences, which are exact for quadratic stresses.
    frame = np.linalg.inv(x[:, 1:] - x[:, :1])  # columns: gradients of w_1, w_2, w_3
    gradient = np.concatenate([-frame.sum(2)[:, None], np.moveaxis(frame, 2, 1)], axis=1)
    div = 0.
    for a in range(3):
        step = 0.1 * gradient[:, None, :, a]
        div = div + (stress(w + step) - stress(w - step))[..., a] / 0.2
    weight = data["load_factor"] * np.array([0., -1., 0.]) * 100. * 10.
    size = np.linalg.norm(weight)
    assert np.abs(div + weight).max() < 1e-8 * size, (law, np.abs(div + weight).max() / size)
PYTHON
