# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Input and reconstruction side by side, with the control net over the reconstruction."""
import numpy
from paraview import simple
from vtkmodules.numpy_interface import dataset_adapter

SURFACE = [0.93, 0.80, 0.62]
NET = [0.10, 0.25, 0.45]


def otsu(values):
    """The value that parts `values` best into two classes (Otsu 1979)."""
    counts, edges = numpy.histogram(values, bins=256)
    centres = 0.5 * (edges[:-1] + edges[1:])
    below = numpy.cumsum(counts)
    sums = numpy.cumsum(counts * centres)
    above = below[-1] - below
    with numpy.errstate(divide="ignore", invalid="ignore"):
        between = below * above * (sums / below - (sums[-1] - sums) / above) ** 2
    return centres[numpy.argmax(numpy.nan_to_num(between))]  # one of them where all are equal


def view_of(title):
    view = simple.CreateRenderView()
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    label = simple.Text(Text=title)
    shown = simple.Show(label, view)
    shown.Color = [0, 0, 0]
    shown.FontSize = 20
    shown.WindowLocation = "Upper Center"
    return view


def show_surface(image, name, value, view):
    surface = simple.Contour(Input=image, ContourBy=["POINTS", name], Isosurfaces=[value],
                             ComputeNormals=1, ComputeScalars=0)
    shown = simple.Show(surface, view)
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = shown.AmbientColor = SURFACE
    shown.Specular = 0.3


def show_net(model, name, value, view):
    """The T-mesh's cells through which the surface goes, as lines."""
    mesh = simple.TSplineSource(Input=model, OutputType="T-Mesh")
    high = simple.Threshold(Input=mesh, Scalars=["POINTS", name], UpperThreshold=value,
                            ThresholdMethod="Above Upper Threshold", AllScalars=0)
    net = simple.Threshold(Input=high, Scalars=["POINTS", name], LowerThreshold=value,
                           ThresholdMethod="Below Lower Threshold", AllScalars=0)
    shown = simple.Show(net, view)
    shown.SetRepresentationType("Wireframe")
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = NET
    shown.LineWidth = 1.0
    shown.Opacity = 0.35


def save(path, image, reconstruction, model, name):
    data = image.GetClientSideObject().GetOutputDataObject(0)
    value = otsu(dataset_adapter.WrapDataObject(data).PointData[name])
    views = [view_of("input"), view_of("T-spline and its net")]
    for source, view in zip((image, reconstruction), views):
        show_surface(source, name, value, view)
        view.CameraPosition = [-2.0, -3.0, 1.5]
        view.CameraFocalPoint = [0.0, 0.0, 0.0]
        view.CameraViewUp = [0.0, 0.0, 1.0]
        view.ResetCamera()
    show_net(model, name, value, views[1])
    layout = simple.CreateLayout()
    for i, view in enumerate(views):
        simple.AssignViewToLayout(view, layout, i)
    simple.SaveScreenshot(path, layout, ImageResolution=[1600, 800])
