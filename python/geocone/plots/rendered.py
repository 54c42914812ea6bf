# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Images of the cells or points of a body in space by VTK, where it is installed.

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
    return images_by_vtk({"points": points, "cells": cells, "cut": [] if cut is None else cut},
                         fields, view, box)


def images_of_balls(centres, diameters, fields, view, box):
    """Balls as seen in parallel projection. The other parameters and the result are those of
    images_of()."""
    return images_by_vtk({"points": centres, "diameters": diameters}, fields, view, box)


def images_by_vtk(shapes, fields, view, box):
    """Images that a process of VTK draws.

    @param shapes arrays of the scene that render() reads, by name"""
    if not can_render():
        return []
    arrays = {**shapes, "box": np.array(box), "right": view.right, "up": view.up,
              "towards": view.towards, "signs": view.signs,
              "kinds": [kind for kind, _, _ in fields]}
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


def add_values(data, scene):
    """Adds the values of the fields of a scene to its cells or points."""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.util.numpy_support import numpy_to_vtk
    for i, kind in enumerate(scene["kinds"]):
        values = numpy_to_vtk(scene[f"values{i}"].astype(float), deep=True)
        values.SetName(str(i))
        (data.GetCellData() if kind == "cell" else data.GetPointData()).AddArray(values)


def points_of(scene):
    """The points of a scene, for VTK."""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkPoints
    points = vtkPoints()
    points.SetData(numpy_to_vtk(scene["points"], deep=True))
    return points


def cells_of(cells):
    """Cells by the numbers of their points (n, corners), for VTK."""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.util.numpy_support import numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonDataModel import vtkCellArray
    numbers = np.insert(cells, 0, cells.shape[1], axis=1).astype(np.int64).ravel()
    array = vtkCellArray()
    array.SetCells(len(cells), numpy_to_vtkIdTypeArray(numbers, deep=True))
    return array


def balls_of(scene):
    """@return a mapper of the balls of a scene, and its points"""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkPolyData
    from vtkmodules.vtkRenderingOpenGL2 import vtkOpenGLSphereMapper
    data = vtkPolyData()
    # The mapper reads the values as floats, whatever they are.
    radii = numpy_to_vtk((scene["diameters"] / 2.).astype(np.float32), deep=True)
    data.SetPoints(points_of(scene))
    data.SetVerts(cells_of(np.arange(len(scene["points"]))[:, None]))
    radii.SetName("radii")
    data.GetPointData().AddArray(radii)
    add_values(data, scene)
    mapper = vtkOpenGLSphereMapper()
    mapper.SetScaleArray("radii")
    return mapper, data


def body_of(scene):
    """@return the surface of the cells of a scene, cut open where it says so; the edges of the
        cells, and those between faces at an angle"""
    # pylint: disable=import-outside-toplevel
    from vtkmodules.vtkCommonDataModel import vtkPlane, vtkUnstructuredGrid
    from vtkmodules.vtkFiltersCore import (vtkAppendFilter, vtkAppendPolyData,
                                           vtkClipPolyData, vtkCutter, vtkFeatureEdges)
    from vtkmodules.vtkFiltersExtraction import vtkExtractEdges
    from vtkmodules.vtkFiltersGeneral import vtkTableBasedClipDataSet
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
    grid, cells = vtkUnstructuredGrid(), scene["cells"]
    grid.SetPoints(points_of(scene))
    grid.SetCells(TYPES[cells.shape[1]], cells_of(cells))
    add_values(grid, scene)

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
    return surface.GetOutput(), lines, sharp.GetOutput()


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
    from vtkmodules.vtkCommonCore import vtkLookupTable
    from vtkmodules.vtkRenderingCore import (vtkActor, vtkLight, vtkPolyDataMapper,
                                             vtkRenderer, vtkRenderWindow,
                                             vtkWindowToImageFilter)

    scene = np.load(BytesIO(source.read()))

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

    balls, edges = "diameters" in scene, []
    if balls:
        painter, data = balls_of(scene)
    else:
        painter = vtkPolyDataMapper()
        painter.InterpolateScalarsBeforeMappingOn()
        data, lines, sharp = body_of(scene)
        edges = [(lines, 0.35, 0.3, 1.), (sharp, 0.15, 0.9, 2.)]
    painter.UseLookupTableScalarRangeOn()
    faces = add(painter, data).GetProperty()
    faces.SetInterpolationToFlat()
    faces.SetAmbient(0.55 if balls else 0.68)
    faces.SetDiffuse(0.5 if balls else 0.36)
    for data, color, opacity, width in edges:
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
    light.SetPosition(*((0.6 if balls else 0.3) * scene["towards"] + [0., 0.9, 0.]
                        + 0.25 * scene["right"]))
    light.SetFocalPoint(0., 0., 0.)
    renderer.AddLight(light)

    # The eye is before the middle of the picture, at the depth of the body.
    middle, points = (low + high) / 2., scene["points"]
    beyond = scene["diameters"].max() / 2. if balls else 0.  # how far the body reaches
    depth = points @ scene["towards"]
    focus = (middle[0] * scene["right"] + middle[1] * scene["up"]
             + depth.mean() * scene["towards"])
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition(focus + 2. * (np.ptp(depth) + 2. * beyond) * scene["towards"])
    camera.SetViewUp(scene["up"])
    camera.SetParallelScale(size[1] / 2.)
    renderer.ResetCameraClippingRange(*np.transpose([points.min(axis=0) - beyond,
                                                     points.max(axis=0) + beyond]).ravel())
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0 if balls else 8)  # of edges of faces, which balls do not have
    window.SetSize(*map(int, pixels))
    window.AddRenderer(renderer)
    images = []
    for i, kind in enumerate(scene["kinds"]):
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
