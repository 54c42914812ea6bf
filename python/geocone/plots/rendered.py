# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Images of the cells of a body in space by VTK, where it is installed.

VTK ends a process that finds no display, so it runs in one of its own: this file as a program,
`rendered.py TIME_LIMIT`, which reads a scene (npz) from its input and writes images (npy) to its
output."""

import os
import re
import signal
import subprocess
import sys
from importlib.util import find_spec
from io import BytesIO

import numpy as np

LARGEST = 1400  # pixels
TIME_LIMIT = 120.  # s
TYPES = {4: 10, 8: 12}  # of cells in VTK, by corners
SHARP = 35.  # degrees between faces with an edge of the body in between
WITHOUT_DISPLAY = 9, 4  # the first version that draws without a display
NO_DISPLAY = 3  # exit code


def can_render():
    """Whether VTK may be used: it is installed, and GEOCONE_VTK is not 0."""
    return os.environ.get("GEOCONE_VTK", "1") != "0" and find_spec("vtkmodules") is not None


def images_of(points, cells, fields, view, box, cut=None):
    """The cells as seen in parallel projection, in the colours of each of some fields.

    @param points, cells  those with a common corner share its point
    @param fields "cell" or "point", of which each has a value; the values as parts of the scale
        of colours (below 0: the colour for what is below the scale); and colormaps
    @param view, box  projection (solid.View), and the corners (low, high) of the picture in it
    @param cut corner (3) of the quarter that is cut out, whose sides are normal to x and z, on
        the side of the eye; None: nothing is
    @return images (rows, columns, 3), none where VTK cannot be used"""
    if not can_render():
        return []
    arrays = {"points": points, "cells": cells, "box": np.array(box), "right": view.right,
              "up": view.up, "towards": view.towards, "signs": view.signs,
              "cut": [] if cut is None else cut, "kinds": [kind for kind, _, _ in fields]}
    for i, (_, values, colors) in enumerate(fields):
        arrays[f"values{i}"] = values
        arrays[f"colors{i}"] = np.concatenate([colors(np.linspace(0., 1., 256)),
                                               [colors.get_under()]])
    try:
        scene = BytesIO()
        np.savez(scene, **arrays)
        # It ends by itself, even if this process has been ended; else a little later.
        done = subprocess.run([sys.executable, "-B", __file__, str(TIME_LIMIT)], check=False,
                              input=scene.getvalue(), capture_output=True,
                              timeout=TIME_LIMIT + 10.)
        if done.returncode == 0:
            return list(np.load(BytesIO(done.stdout)))
        why = why_not(done)
    except subprocess.TimeoutExpired:
        why = too_long()
    except (OSError, EOFError, ValueError) as error:
        why = str(error)
    if why:
        print(f"warning: pictures without VTK: {why}", file=sys.stderr)
    return []


def too_long():
    """Says that the time limit was exceeded."""
    return f"it took more than {TIME_LIMIT:g} s"


def why_not(done):
    """Why a process has drawn nothing; nothing where there is no display, as on servers."""
    if done.returncode == NO_DISPLAY:
        return ""
    if done.returncode == -signal.SIGALRM:
        return too_long()
    colors = r"\x1b\[[0-9;]*m"  # of a terminal
    said = re.sub(colors, "", done.stderr.decode(errors="replace")).split("\n")
    last = next((line.strip() for line in reversed(said) if line.strip()), "")
    how = (f"it ended with the exit code {done.returncode}" if done.returncode > 0 else
           f"it was ended by the signal {-done.returncode}")
    return f"{how}: {last}" if last else how


def render(source):
    """Reads a scene from a stream. @return its images (n, rows, columns, 3)"""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.vtkCommonCore import vtkVersion
    version = vtkVersion()
    if not os.environ.get("DISPLAY") and (version.GetVTKMajorVersion(),
                                          version.GetVTKMinorVersion()) < WITHOUT_DISPLAY:
        sys.exit(NO_DISPLAY)
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - registers the renderer
    from vtkmodules.util import numpy_support
    from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersCore import (vtkAppendFilter, vtkAppendPolyData,
                                           vtkClipPolyData, vtkCutter, vtkFeatureEdges)
    from vtkmodules.vtkFiltersExtraction import vtkExtractEdges
    from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper,
                                             vtkRenderer, vtkRenderWindow,
                                             vtkWindowToImageFilter)

    scene = np.load(BytesIO(source.read()))
    places, cells = scene["points"], scene["cells"]
    grid, points, corners = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
    points.SetData(numpy_support.numpy_to_vtk(places, deep=True))
    numbers = np.insert(cells, 0, cells.shape[1], axis=1).astype(np.int64).ravel()
    corners.SetCells(len(cells), numpy_support.numpy_to_vtkIdTypeArray(numbers, deep=True))
    grid.SetPoints(points)
    grid.SetCells(TYPES[cells.shape[1]], corners)
    kinds = scene["kinds"]
    for i, kind in enumerate(kinds):
        values = numpy_support.numpy_to_vtk(scene[f"values{i}"].astype(float), deep=True)
        values.SetName(str(i))
        (grid.GetCellData() if kind == "cell" else grid.GetPointData()).AddArray(values)

    def output(filter_, *inputs):
        for data in inputs:
            filter_.AddInputData(data)
        filter_.Update()
        return filter_.GetOutput()

    def plane_along(axis):
        """The plane of the cut with its normal towards the eye."""
        normal = np.zeros(3)
        normal[axis] = scene["signs"][axis // 2]
        plane = vtkPlane()
        plane.SetOrigin(scene["cut"])
        plane.SetNormal(normal)
        return plane

    def clipped(kind, data, plane, in_front):
        clip = kind()
        clip.SetInputData(data)
        clip.SetClipFunction(plane)
        clip.SetInsideOut(not in_front)
        clip.Update()
        return clip.GetOutput()

    def opened(kind, append, data):
        """Data without what is in front of both planes of the cut."""
        first, second = plane_along(0), plane_along(2)
        beside = clipped(kind, clipped(kind, data, first, True), second, False)
        return output(append(), clipped(kind, data, first, False), beside)

    def lines_of(data):
        edges = vtkExtractEdges()
        edges.SetInputData(data)
        edges.Update()
        return edges.GetOutput()

    surface = vtkGeometryFilter()
    surface.SetInputData(grid)
    surface.Update()
    lines, body = lines_of(surface.GetOutput()), grid
    if len(scene["cut"]):
        body = opened(vtkTableBasedClipDataSet, vtkAppendFilter, grid)
        sides = []
        for axis in 0, 2:
            cutter = vtkCutter()
            cutter.SetInputData(grid)
            cutter.SetCutFunction(plane_along(axis))
            cutter.GenerateTrianglesOff()
            cutter.Update()
            # Only what is behind the other side of the cut is seen.
            sides.append(clipped(vtkClipPolyData, lines_of(cutter.GetOutput()),
                                 plane_along(2 - axis), True))
        lines = output(vtkAppendPolyData(), opened(vtkClipPolyData, vtkAppendPolyData, lines),
                       *sides)
        surface.SetInputData(body)
        surface.Update()
    sharp = vtkFeatureEdges()
    sharp.SetInputData(surface.GetOutput())
    sharp.SetFeatureAngle(SHARP)
    sharp.BoundaryEdgesOn()
    sharp.NonManifoldEdgesOff()
    sharp.ColoringOff()
    sharp.Update()

    def colors_of(i):
        colors = vtkLookupTable()
        colors.SetNumberOfTableValues(256)
        colors.SetRange(0., 1.)
        for number, color in enumerate(scene[f"colors{i}"][:256]):
            colors.SetTableValue(number, *color)
        colors.SetBelowRangeColor(*scene[f"colors{i}"][256])
        colors.UseBelowRangeColorOn()
        return colors

    renderer = vtkRenderer()
    renderer.SetBackground(1., 1., 1.)
    low, high = scene["box"]
    size = np.ptp(scene["box"], axis=0)
    pixels = np.maximum(np.round(LARGEST * size / size.max()), 1).astype(int)

    def add(mapper, data):
        mapper.SetInputData(data)
        actor = vtkActor()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
        return actor

    painter = vtkPolyDataMapper()
    painter.UseLookupTableScalarRangeOn()
    painter.InterpolateScalarsBeforeMappingOn()
    faces = add(painter, surface.GetOutput()).GetProperty()
    faces.SetInterpolationToFlat()
    faces.SetAmbient(0.68)
    faces.SetDiffuse(0.36)
    for data, color, opacity, width in ((lines, 0.35, 0.3, 1.), (sharp.GetOutput(), 0.15, 0.9,
                                                                 2.)):
        mapper = vtkPolyDataMapper()
        mapper.ScalarVisibilityOff()
        mapper.SetResolveCoincidentTopologyToPolygonOffset()
        mapper.SetRelativeCoincidentTopologyLineOffsetParameters(0., -4.)
        line = add(mapper, data).GetProperty()
        line.SetColor(color, color, color)
        line.SetOpacity(opacity)
        line.SetLineWidth(width)
        line.LightingOff()
    light = vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(*(0.3 * scene["towards"] + [0., 0.9, 0.] + 0.25 * scene["right"]))
    light.SetFocalPoint(0., 0., 0.)
    renderer.AddLight(light)

    # The eye is before the middle of the picture, at the depth of the body.
    middle = (low + high) / 2.
    depth = places @ scene["towards"]
    focus = (middle[0] * scene["right"] + middle[1] * scene["up"]
             + depth.mean() * scene["towards"])
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition(focus + 2. * np.ptp(depth) * scene["towards"])
    camera.SetViewUp(scene["up"])
    camera.SetParallelScale(size[1] / 2.)
    renderer.ResetCameraClippingRange()
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(8)
    window.SetSize(*map(int, pixels))
    window.AddRenderer(renderer)
    images = []
    for i, kind in enumerate(kinds):
        painter.SetLookupTable(colors_of(i))
        if kind == "cell":
            painter.SetScalarModeToUseCellFieldData()
        else:
            painter.SetScalarModeToUsePointFieldData()
        painter.SelectColorArray(str(i))
        window.Render()
        grab = vtkWindowToImageFilter()
        grab.SetInput(window)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = numpy_support.vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
        columns, rows, _ = grab.GetOutput().GetDimensions()
        images.append(image.reshape(rows, columns, -1)[::-1, :, :3])
    return np.array(images)


if __name__ == "__main__":
    signal.setitimer(signal.ITIMER_REAL, float(sys.argv[1]))
    sys.path.pop(0)  # the folder of this file, whose names are those of the package
    with os.fdopen(os.dup(1), "wb") as stream:
        os.dup2(2, 1)  # what libraries print is none of the images
        drawn = BytesIO()
        np.save(drawn, render(sys.stdin.buffer))
        stream.write(drawn.getvalue())
