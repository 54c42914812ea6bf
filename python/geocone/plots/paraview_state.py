# Copyright (C) 2026 by the geocone authors
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Opens the fields of a run in ParaView 5.11 or later, and shows their last state:
  File > Load State, or     paraview --state=paraview_state.py
  pvbatch --force-offscreen-rendering paraview_state.py PICTURE.png
It is written by scripts/plot, and goes where the folder of the run goes."""

import os
import sys

from paraview import simple

# name; from  the folder of the run, as seen from here; folder  the same, where ParaView
# does not give the place of this file; towards  the eye, in three dimensions; wide;
# views, each with:
#   series   which is opened        array   that colours, of vectors the magnitude
#   title    of its colours         range   of its colours; log: by the logarithm
#   rates    colours of rates       edges   whether those of cells are shown
#   warp     array that deforms the body, times factor; or None
#   radius   of points, drawn as disks or balls (m); or None
RUN = None  # replaced by scripts/plot

FOLDER = (os.path.join(os.path.dirname(os.path.abspath(__file__)), RUN["from"])
          if "__file__" in globals() else RUN["folder"])


def source_of(series):
    """The reader of a series in the form that this ParaView reads; VTKHDF takes 5.12."""
    endings = [".pvd", ".vtkhdf", ".xdmf"]
    if simple.GetParaViewVersion() < (5, 12):
        endings.remove(".vtkhdf")
    for ending in endings:
        path = os.path.join(FOLDER, series + ending)
        if os.path.isfile(path):
            return simple.OpenDataFile(path)
    raise FileNotFoundError(f"there are no fields {series} in '{FOLDER}'")


def show(look, source, view):
    """Shows a source in a view."""
    shown = simple.Show(source, view)
    simple.ColorBy(shown, ("POINTS", look["array"]))
    colors = simple.GetColorTransferFunction(look["array"])
    colors.ApplyPreset("Magma (matplotlib)" if look["rates"] else "Viridis (matplotlib)",
                       True)
    if look["rates"]:
        colors.InvertTransferFunction()
    colors.RescaleTransferFunction(*look["range"])
    if look["log"]:
        colors.MapControlPointsToLogSpace()
        colors.UseLogScale = 1
        # Grey is what is below; zero, which has no logarithm, gets the first colour.
        colors.UseBelowRangeColor, colors.BelowRangeColor = 1, [0.93, 0.93, 0.93]
        colors.RGBPoints[1:4] = colors.BelowRangeColor
    colors.AutomaticRescaleRangeMode = "Never"
    bar = simple.GetScalarBar(colors, view)
    bar.Title, bar.ComponentTitle = look["title"], ""
    bar.TitleColor = bar.LabelColor = [0., 0., 0.]
    bar.TitleFontSize = bar.LabelFontSize = 14
    shown.SetScalarBarVisibility(view, True)
    if look["radius"]:
        shown.SetRepresentationType("Point Gaussian")
        shown.GaussianRadius = look["radius"]
        shown.ShaderPreset = "Sphere" if RUN["towards"] else "Plain circle"
    elif look["edges"]:
        shown.SetRepresentationType("Surface With Edges")
        shown.EdgeColor = [0.8, 0.8, 0.8]
    if not RUN["towards"]:  # colours as the bar has them
        shown.Ambient, shown.Diffuse, shown.Specular = 1., 0., 0.


def last_time(source):
    """The last time of a reader, which gives a single one as a number."""
    times = source.TimestepValues
    return times if isinstance(times, float) else times[-1]


def main(picture):
    """Makes a layout with a view of each look, their cameras linked; of a fixed size for
    a picture."""
    sources, views = {}, []
    for look in RUN["views"]:
        view = simple.CreateView("RenderView")
        view.UseColorPaletteForBackground, view.Background = 0, [1., 1., 1.]
        view.OrientationAxesVisibility = 1 if RUN["towards"] else 0
        views.append(view)
        series, warp = look["series"], look["warp"]
        if series not in sources:
            sources[series] = source_of(series)
            simple.RenameSource(f"{RUN['name']}: {series}", sources[series])
        if warp and (series, warp) not in sources:
            sources[series, warp] = simple.WarpByVector(
                Input=sources[series], Vectors=["POINTS", warp],
                ScaleFactor=look["factor"])
            simple.RenameSource(f"{RUN['name']}: {warp} times {look['factor']:.3g}",
                                sources[series, warp])
    layout = simple.CreateLayout(RUN["name"])
    if len(views) > 1:
        (layout.SplitVertical if RUN["wide"] else layout.SplitHorizontal)(0, 0.5)
    for place, view in enumerate(views, 1 if len(views) > 1 else 0):
        layout.AssignView(place, view)
    if picture:
        layout.SetSize(1200, 1000 if RUN["wide"] else 600)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = max(last_time(sources[look["series"]]) for look in RUN["views"])
    for look, view in zip(RUN["views"], views):
        series, warp = look["series"], look["warp"]
        source = sources[(series, warp) if warp else series]
        show(look, source, view)
        if series != "bounds":
            time = simple.AnnotateTimeFilter(Input=source, Format="t = {time:g} s")
            simple.Show(time, view).Color = [0., 0., 0.]
        if RUN["towards"]:
            view.CameraFocalPoint, view.CameraPosition = [0., 0., 0.], RUN["towards"]
            view.CameraViewUp = [0., 1., 0.]
        else:
            view.InteractionMode = "2D"
        simple.ResetCamera(view)
        if not RUN["towards"]:  # the box fills the view, but for the place of the bar
            low_x, high_x, low_y, high_y, *_ = source.GetDataInformation().GetBounds()
            width, height = view.ViewSize
            scale = (0.55 * max(high_y - low_y, 1.2 * (high_x - low_x) * height / width) +
                     (look["radius"] or 0.))
            view.CameraParallelScale = scale
            view.CameraFocalPoint[0] += 0.15 * scale * width / height
            view.CameraPosition[0] = view.CameraFocalPoint[0]
    for view in views[1:]:
        simple.AddCameraLink(views[0], view, f"{RUN['name']}: cameras")
    simple.SetActiveView(views[0])
    simple.RenderAllViews()
    return layout


wanted = (sys.argv[1] if __name__ == "__main__" and len(sys.argv) == 2 and
          sys.argv[1].endswith(".png") else None)
whole = main(wanted)
if wanted:
    simple.SaveScreenshot(wanted, whole)
