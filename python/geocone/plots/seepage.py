# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""flow_net.png: pore pressures with the lines of equal head, the lines along which the water
flows, and the free surface; discharge.png: the discharge on each mesh."""

import numpy as np
from matplotlib.tri import LinearTriInterpolator, Triangulation

from geocone.plots import overlay
from geocone.plots.answer import heading
from geocone.plots.bounds import cells_of, column, plain_ticks
from geocone.plots.point_values import vertices_of
from geocone.style import BLUE, WATER, Skipped, add_bar, panels, plain, save, subplots

HEADS = 14  # lines of equal head
LATTICE = 120  # places along the longer side on which lines of flow are followed


class Mesh:
    """A field of triangles with one node at each vertex."""

    def __init__(self, field):
        of_vertices = vertices_of(field.points)
        _, first, number = np.unique(of_vertices, return_index=True, return_inverse=True)
        self.number, self.cells = number.ravel(), number.ravel()[field.cells]
        self.points = field.points[first]

    def at_nodes(self, values):
        """Means of the values of the cells at a vertex."""
        return np.bincount(self.number, values) / np.bincount(self.number)

    def triangles(self, mask=None):
        """For matplotlib."""
        return Triangulation(*self.points.T, self.cells, mask=mask)


def draw_lines_of_flow(axes, mesh, velocity, is_wet):
    """Draws lines along the velocity where the soil is saturated."""
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    step = (high - low).max() / LATTICE
    x, y = (np.linspace(low[d], high[d], max(int((high[d] - low[d]) / step), 2))
            for d in range(2))
    grid = np.meshgrid(x, y)
    components = [LinearTriInterpolator(mesh.triangles(), values)(*grid).filled(0.)
                  for values in velocity]
    wet = LinearTriInterpolator(mesh.triangles(), is_wet.astype(float))(*grid).filled(0.)
    size = np.hypot(*components)
    hidden = (wet < 0.5) | (size < 1e-4 * size.max())
    axes.streamplot(x, y, *(np.ma.array(values, mask=hidden) for values in components),
                    color="#303030", linewidth=0.6, arrowsize=0.7, density=0.9)


def draw_net(run, path):
    """Draws the flow net."""
    field, = run.states("seepage")
    if field.cells.shape[1] == 4:
        from geocone.plots import seepage_solid
        seepage_solid.draw_net(run, field, path)
        return
    mesh = Mesh(field)
    pressure, head = (mesh.at_nodes(field.data[name][:, 0]) for name in ("pore_pressure", "head"))
    is_wet = pressure > 0.
    if not np.any(is_wet):
        raise Skipped("the soil is dry")
    figure, (axes,) = panels(1, (mesh.points.min(axis=0), mesh.points.max(axis=0)))
    drawn = axes.tripcolor(mesh.triangles(), pressure * run.mass_unit / 1e3, shading="gouraud",
                           cmap="Blues", vmin=0.)
    add_bar(axes, drawn, "pore pressure (kPa)")
    heads = head[is_wet]
    if np.ptp(heads) > 1e-9 * max(np.abs(heads).max(), 1e-300):
        levels = np.linspace(heads.min(), heads.max(), HEADS + 2)[1:-1]
        axes.tricontour(mesh.triangles(~np.all(is_wet[mesh.cells], axis=1)), head, levels=levels,
                        colors=[WATER], linewidths=0.9)
        draw_lines_of_flow(axes, mesh, [mesh.at_nodes(values) for values in
                                        field.data["seepage_velocity"][:, :2].T], is_wet)
    overlay.draw_scene(axes, run, field)
    axes.set_title(heading(run))
    save(figure, run, path, cropped=True)


def draw_discharge(run, path):
    """Draws the discharge against the triangles of the meshes; of a transient flow the flow
    through each boundary against time."""
    table = run.table("seepage")
    times, (cells, name_of_cells) = table["time (s)"], cells_of(table)
    if len(cells) < 2:
        raise Skipped("there is one mesh only")
    discharge, unit = column(table, "discharge")
    figure, axes = subplots(1, 1, figsize=(6.5, 4.4))
    if run.value("seepage/stored") is not None:
        name, second = ("days", 86400.) if times[-1] > 2. * 86400. else ("s", 1.)
        for key in table:
            if key.startswith("inflow of "):
                axes.plot(times / second, -table[key],
                          label=plain(key.removeprefix("inflow of ").rsplit(" (", 1)[0]))
        axes.legend()
        axes.set(xlabel=f"time ({name})", ylabel=f"outflow ({unit})", title=heading(run))
        save(figure, run, path)
        return
    axes.semilogx(cells, discharge, "o-", color=BLUE)
    reference = run.value("reference/expected")
    if reference is not None and run.value("reference/quantity") == "seepage/discharge":
        axes.axhline(reference, color="k", linestyle="--", linewidth=1.2, label="reference")
        axes.legend()
    axes.set(xlabel=name_of_cells, ylabel=f"discharge ({unit})", title=heading(run))
    plain_ticks(axes.xaxis)
    save(figure, run, path)


def pictures(_run):
    """Drawing functions by picture."""
    return {"flow_net.png": draw_net, "discharge.png": draw_discharge}
