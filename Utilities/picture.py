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


SEGMENT_COLORS = [[0.88, 0.90, 0.93], [0.80, 0.55, 0.35], [0.95, 0.85, 0.55], [0.35, 0.55, 0.75],
                  [0.45, 0.70, 0.45], [0.70, 0.40, 0.60], [0.55, 0.55, 0.55], [0.85, 0.35, 0.35]]


def middle_slice(image, axis):
    """The cells of the middle slice, each with the value at most of its points."""
    extent = list(image.GetDataInformation().GetExtent())
    middle = (extent[2 * axis] + extent[2 * axis + 1]) // 2
    extent[2 * axis] = extent[2 * axis + 1] = middle
    return simple.PointDatatoCellData(Input=simple.ExtractSubset(Input=image, VOI=extent),
                                      CategoricalData=1)


def save_segments(path, segmentation, boundary, name):
    """Density and segments on the middle slice, and the segments' surfaces cut open there."""
    bounds = segmentation.GetDataInformation().GetBounds()
    centre = [0.5 * (bounds[2 * a] + bounds[2 * a + 1]) for a in range(3)]
    count = 1 + int(segmentation.PointData["Segment"].GetRange()[1])
    views = [view_of(name), view_of(f"{count} segments"), view_of("their surfaces, cut open")]
    steps = [x for i in range(count) for edge in (i - 0.5, i + 0.499)
             for x in [edge, *SEGMENT_COLORS[i % len(SEGMENT_COLORS)]]]
    across = middle_slice(segmentation, 1)
    for view, array in zip(views, (name, "Segment")):
        shown = simple.Show(across, view)
        shown.Ambient, shown.Diffuse = 1.0, 0.0
        simple.ColorBy(shown, ("CELLS", array), separate=True)
        lut = simple.GetColorTransferFunction(array, shown, separate=True)
        if array == "Segment":
            lut.RGBPoints = steps
        else:
            lut.ApplyPreset("Grayscale", True)
        shown.SetScalarBarVisibility(view, False)
        view.CameraParallelProjection = 1
        view.CameraPosition = [centre[0], bounds[2] - 1.0, centre[2]]
        view.CameraFocalPoint = centre
        view.CameraViewUp = [0.0, 0.0, 1.0]
        view.ResetCamera()
    cut = simple.Clip(Input=boundary, ClipType="Plane", Invert=0)
    cut.ClipType.Origin, cut.ClipType.Normal = centre, [0.0, 1.0, 0.0]
    shown = simple.Show(cut, views[2])
    simple.ColorBy(shown, ("CELLS", "BoundaryLabels"))
    lut = simple.GetColorTransferFunction("BoundaryLabels")
    lut.VectorMode, lut.VectorComponent = "Component", 0  # the inner side
    lut.RGBPoints = steps
    shown.SetScalarBarVisibility(views[2], False)
    views[2].CameraPosition = [centre[0] - 1.2, centre[1] - 3.0, centre[2] + 1.0]
    views[2].CameraFocalPoint = centre
    views[2].CameraViewUp = [0.0, 0.0, 1.0]
    views[2].ResetCamera()
    layout = simple.CreateLayout()
    layout.SplitHorizontal(0, 1.0 / 3.0)
    layout.SplitHorizontal(2, 0.5)
    for view, place in zip(views, (1, 5, 6)):
        simple.AssignViewToLayout(view, layout, place)
    simple.SaveScreenshot(path, layout, ImageResolution=[1500, 600])


FRAME_COLORS = [0, 0.85, 0.20, 0.10, 1, 0.10, 0.55, 0.20, 2, 0.10, 0.30, 0.80]


def show_crosses(field, axis, view):
    """Frames on the middle slice across an axis, a color for each direction."""
    extent = list(field.GetDataInformation().GetExtent())
    sides = [extent[2 * a + 1] - extent[2 * a] for a in range(3)]
    extent[2 * axis] = extent[2 * axis + 1] = (extent[2 * axis] + extent[2 * axis + 1]) // 2
    crosses = simple.FrameGlyphs(Input=simple.ExtractSubset(Input=field, VOI=extent),
                                 Stride=max(1, round(max(sides) / 36)))
    shown = simple.Show(crosses, view)
    simple.ColorBy(shown, ("CELLS", "FrameAxis"))
    simple.GetColorTransferFunction("FrameAxis").RGBPoints = FRAME_COLORS
    shown.SetScalarBarVisibility(view, False)
    shown.LineWidth = 2


def show_lines(source, color, width, view):
    shown = simple.Show(source, view)
    shown.ColorArrayName = [None, ""]
    shown.AmbientColor = shown.DiffuseColor = color
    shown.LineWidth = width
    shown.RenderLinesAsTubes = 1


def save_frames(path, name, aligned, unaligned):
    """Frames with patches on a slice; lines along each of their directions; singular curves
    without patches."""
    views = [view_of(title) for title in (f"{name}: frames", "lines along u, v, w",
                                          "singular without patches")]
    bounds = aligned.GetDataInformation().GetBounds()
    centre = [0.5 * (bounds[2 * a] + bounds[2 * a + 1]) for a in range(3)]
    largest = max(bounds[2 * a + 1] - bounds[2 * a] for a in range(3))
    show_crosses(aligned, 1, views[0])
    for axis, vectors in enumerate(("FrameU", "FrameV", "FrameW")):
        lines = simple.StreamTracer(Input=aligned, Vectors=["POINTS", vectors],
                                    SeedType="Point Cloud", MaximumStreamlineLength=2.0 * largest)
        lines.SeedType.Center = centre
        lines.SeedType.Radius = 0.5 * largest
        lines.SeedType.NumberOfPoints = 300
        show_lines(lines, FRAME_COLORS[4 * axis + 1:4 * axis + 4], 1.5, views[1])
    show_lines(simple.OutputPort(unaligned, 1), [0.1, 0.1, 0.1], 3, views[2])
    for view in views[1:]:
        surface = simple.Contour(Input=aligned, ContourBy=["POINTS", "Segment"], Isosurfaces=[0.5])
        shown = simple.Show(surface, view)
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = shown.AmbientColor = SURFACE
        shown.Opacity = 0.2
    for view, position in zip(views, ((0, -1, 0), (-1.2, -3, 1), (-1.2, -3, 1))):
        view.CameraPosition = [c + p for c, p in zip(centre, position)]
        view.CameraFocalPoint = centre
        view.CameraViewUp = [0.0, 0.0, 1.0]
        view.ResetCamera()
    layout = simple.CreateLayout()
    layout.SplitHorizontal(0, 1.0 / 3.0)
    layout.SplitHorizontal(2, 0.5)
    for view, place in zip(views, (1, 5, 6)):
        simple.AssignViewToLayout(view, layout, place)
    simple.SaveScreenshot(path, layout, ImageResolution=[1500, 500])
