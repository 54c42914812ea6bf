# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""How wide does a footing act? A small study in Python, in cells that editors run one by
one. From the folder of the source:

    PYTHONPATH=python python3 doc/cookbook/footing_study.py

It leaves results/footing_study.png and a folder for each run; half a minute."""

# %% Runs: the footing on three meshes of material points. A second call reads them.
from pathlib import Path

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402 pylint: disable=wrong-import-position

import geocone  # noqa: E402 pylint: disable=wrong-import-position
from geocone.style import COLORS, RATES  # noqa: E402 pylint: disable=wrong-import-position

WIDTH = 0.2  # of the footing, m
# Without what reduces this error: B-bar, and double knots, which need grid lines at the edges.
PLAIN = {"Discretisation/B-bar": False, "Discretisation/Double knots x": "",
         "Output/Pictures": False}
runs = {}
for size in 0.1, 0.0667, 0.05:
    folder = Path("results") / f"footing_study_{size:g}"
    runs[size] = (geocone.read(folder) if folder.exists() else
                  geocone.run("prm/footing_mpm.prm",
                              {**PLAIN, "Mesh/Cell size": size}, output=folder))

# %% What each has found: the limit load, its error, and what it took.
print("cells (m)  unknowns  load (N/m)  error (%)  iterations per step")
for size, run in runs.items():
    print(f"{size:9g}  {run.value('size/dofs'):8d}  {run.value('limit_load/value'):10.1f}"
          f"  {100. * run.value('limit_load/relative_error'):9.2f}"
          f"  {run.value('newton/iterations_mean'):19.1f}")

# %% Errors grow with the cells: the footing acts wider than it is, by a part of a cell.
sizes = np.array(list(runs))
errors = np.array([run.value("limit_load/relative_error") for run in runs.values()])
part = np.polyfit(sizes, WIDTH * errors, 1)[0]
print(f"the footing acts as if it were {part:.2f} cells wider")

# %% Load against displacement, and where the soil flows at the end.
figure, (curves, flow) = plt.subplots(1, 2, figsize=(12., 3.6), constrained_layout=True,
                                      gridspec_kw={"width_ratios": [2., 3.]})
for color, (size, run) in zip(COLORS, runs.items()):
    curves.plot(1e3 * run.statistics["displacement (m)"],
                run.statistics["load (N/m)"] / 1e3, "o-", markersize=3.5, color=color,
                label=f"cells of {size:g} m")
exact = runs[0.05].value("limit_load/reference")
curves.axhline(exact / 1e3, color="black", linestyle="--", linewidth=1.2, label="Prandtl")
curves.set(xlabel="displacement (mm)", ylabel="load (kN/m)", ylim=(0., None),
           title="load on three meshes")
curves.legend()

mesh = runs[0.05].fields("points")  # of meshio, which writes any format
rate = mesh.point_data["plastic_strain_rate"]
order = np.argsort(rate)
drawn = flow.scatter(*mesh.points[order].T, c=rate[order], s=7., cmap=RATES,
                     norm=matplotlib.colors.LogNorm(1e-3 * rate.max(), rate.max()))
flow.set(xlim=(-0.9, 0.9), ylim=(-0.55, 0.08), aspect="equal", xlabel="x (m)",
         ylabel="y (m)", title=f"cells of 0.05 m, t = {mesh.info['time']:g} s")
flow.grid(False)
figure.colorbar(drawn, ax=flow, label="plastic strain rate (1/s)", extend="min",
                shrink=0.9)
figure.savefig("results/footing_study.png", dpi=110)

# %% A parameter that the program refuses is an exception with its words.
try:
    geocone.run("prm/footing_mpm.prm", {"Materials/soil/Friction angle": 95})
except geocone.RunFailed as problem:
    print(f"refused: {problem}")
