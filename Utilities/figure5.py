# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's Figure 5: models, above, and what their T-splines give back, below, volume rendered.

    python3 Utilities/table1.py --save FOLDER MODEL=CONTROL_POINTS:DOMAIN ...
    pvpython Utilities/figure5.py FOLDER PICTURE.png MODEL=CONTROL_POINTS:DOMAIN ...

The models are the .vti files of TRIVARIATE_DATA_DIR (default: ../shared/data). Both rows have the
same camera, colors and opacity.
"""
import math
import os
import pathlib
import sys

from paraview import simple

root = pathlib.Path(__file__).resolve().parent.parent
data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR", root.parent / "shared" / "data"))
SIZE = 280  # of a picture, in pixels
# By model: opacity at shares of the range of the density, the direction of the view, and up.
LOOKS = {
    "fuel": ([(0.0, 0.0), (0.06, 0.0), (0.2, 0.15), (1.0, 0.9)], (1.0, -2.0, 0.8), (0, 0, 1)),
    "hydrogen_atom": ([(0.0, 0.0), (0.06, 0.0), (0.15, 0.08), (0.5, 0.5), (1.0, 0.9)],
                      (0.4, -2.0, 0.5), (0, 0, 1)),
    "tooth": ([(0.0, 0.0), (0.36, 0.0), (0.5, 0.1), (0.72, 0.3), (0.85, 0.8), (1.0, 0.9)],
              (1.0, -2.0, 0.4), (0, 0, 1)),
    "ankle_128": ([(0.0, 0.0), (0.12, 0.0), (0.25, 0.02), (0.45, 0.05), (0.55, 0.5), (1.0, 0.9)],
                  (-2.0, -1.0, 0.4), (0, 0, 1))}
COLORS = [(0.0, 0.20, 0.25, 0.45), (0.3, 0.75, 0.55, 0.40), (0.6, 0.93, 0.80, 0.62),
          (1.0, 1.0, 1.0, 0.95)]


def transfer_functions(name, low, high, opacities):
    """Colors and opacities of one model, for both of its pictures."""
    at = lambda share: low + share * (high - low)
    color = simple.CreateLookupTable(
        RGBPoints=[x for share, *rgb in COLORS for x in (at(share), *rgb)], ColorSpace="RGB")
    opacity = simple.CreatePiecewiseFunction(
        Points=[x for share, value in opacities for x in (at(share), value, 0.5, 0.0)])
    return color, opacity


def show(image, title, name, functions, look):
    view = simple.CreateRenderView()
    view.ViewSize = [SIZE, SIZE]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    shown = simple.Show(image, view, "UniformGridRepresentation")
    shown.SetRepresentationType("Volume")
    simple.ColorBy(shown, ("POINTS", name))
    shown.LookupTable, shown.ScalarOpacityFunction = functions
    shown.Shade = 1
    shown.SetScalarBarVisibility(view, False)
    label = simple.Show(simple.Text(Text=title), view)
    label.Color = [0, 0, 0]
    label.FontSize = 14
    label.WindowLocation = "Upper Center"
    bounds = image.GetDataInformation().GetBounds()
    centre = [0.5 * (bounds[2 * a] + bounds[2 * a + 1]) for a in range(3)]
    diagonal = math.dist(bounds[::2], bounds[1::2])
    view.CameraFocalPoint = centre
    view.CameraPosition = [c + diagonal * d for c, d in zip(centre, look[1])]
    view.CameraViewUp = look[2]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.43 * diagonal
    return view


def main():
    folder, picture, *runs = sys.argv[1:]
    above, below = [], []
    for run in runs:
        model, count = run.split("=")
        count, domain = count.split(":")
        images = [simple.OpenDataFile(str(data / f"{model}.vti")),
                  simple.OpenDataFile(str(pathlib.Path(folder) / f"{model}-{count}-{domain}.vti"))]
        for image in images:
            image.UpdatePipeline()
        array = images[0].PointData[0]
        functions = transfer_functions(array.GetName(), *array.GetRange(), LOOKS[model][0])
        for image, title, row in zip(images, (model, f"{int(count):,} control points"),
                                     (above, below)):
            row.append(show(image, title, array.GetName(), functions, LOOKS[model]))
    layout = simple.CreateLayout()
    layout.SplitVertical(0, 0.5)
    for row, cell in ((above, 1), (below, 2)):
        for i, view in enumerate(row[:-1]):
            left = layout.SplitHorizontal(cell, 1.0 / (len(row) - i))
            simple.AssignViewToLayout(view, layout, left)
            cell = left + 1
        simple.AssignViewToLayout(row[-1], layout, cell)
    simple.SaveScreenshot(picture, layout, ImageResolution=[SIZE * len(above), 2 * SIZE],
                          CompressionLevel="9")


main()
