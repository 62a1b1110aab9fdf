# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""A quarter of a thick tube, radii 1 and 2, height 1: one rational cell, exact. Its volume, a cut and
a picture must come out right in ParaView.

Arguments: folder of the baselines, and --update to write the picture anew (then look at it).
"""
import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import *

from Pictures import THRESHOLD, difference
from SplineGrids import new_grid

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."

# The arc of degree 2 with weights 1, s, 1, raised to degree 3; u outwards, v round, w up.
s = np.sqrt(0.5)
weight = np.array([1, (1 + 2 * s) / 3, (1 + 2 * s) / 3, 1])
arc = np.array([1, (1 + 2 * s) / 3, 2 * s / 3, 0]) / weight
u, v, w = np.indices((4, 4, 4)).reshape(3, -1)[::-1]
radius = 1 + u / 3
points = np.stack([radius * arc[v], radius * arc[3 - v], w / 3], axis=1)
knots = np.array([[0.0] * (4 - i) + [1.0] * (1 + i) for i in range(4)])
grid = new_grid(points, {"KnotsU": knots[u], "KnotsV": knots[v], "KnotsW": knots[w],
                         "Weight": weight[v], "Height": points[:, 2].copy()})
spline = TrivialProducer()
spline.GetClientSideObject().SetOutput(grid)


def integral(proxy, name):
    """The volume or area of a data set."""
    result = servermanager.Fetch(IntegrateVariables(Input=proxy))
    return result.GetCellData().GetArray(name).GetValue(0)


exact = 3 * np.pi / 4
errors = [exact - integral(TSplineSource(Input=spline, OutputType="Linear Hexahedra",
                                         Subdivisions=n), "Volume") for n in (4, 8, 16, 32)]
assert all(3.9 < a / b < 4.1 for a, b in zip(errors, errors[1:])), errors  # second order
assert 0 < errors[-1] < 1e-3, errors

bezier = TSplineSource(Input=spline, OutputType="Bezier Hexahedra")
pieces = Tessellate(Input=bezier, OutputDimension=3, ChordError=1e-3)
volume = integral(pieces, "Volume")
assert abs(volume - exact) < 5e-3, volume

hexes = TSplineSource(Input=spline, OutputType="Linear Hexahedra", Subdivisions=32)
cut = Slice(Input=hexes, SliceType="Plane")
cut.SliceType.Origin, cut.SliceType.Normal = [0.4, 0, 0], [1, 0, 0]
area = integral(cut, "Area")
assert abs(area - (np.sqrt(4 - 0.16) - np.sqrt(1 - 0.16))) < 1e-3, area

view = CreateRenderView(ViewSize=[300, 300], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
shown = Show(bezier, view)
shown.SetRepresentationType("Surface")
shown.NonlinearSubdivisionLevel = 4
ColorBy(shown, ("POINTS", "Height"))
outline = Show(TSplineSource(Input=spline, OutputType="Iso-Parametric Surfaces",
                             Subdivisions=8, SurfacesU=[1.0], SurfacesV=[0.0], SurfacesW=[1.0]), view)
outline.SetRepresentationType("Wireframe")
outline.AmbientColor = outline.DiffuseColor = [0, 0, 0]
outline.ColorArrayName = [None, ""]
view.CameraPosition, view.CameraViewUp = [4, 2.5, 4], [0, 0, 1]
view.ResetCamera()
SaveScreenshot(os.path.join(folder, "AnnulusBezierHexahedra.png"), view, ImageResolution=[300, 300])
error = difference("AnnulusBezierHexahedra", folder, baselines)
print("volume by hexahedra", exact - errors[-1], "by Bezier cells", volume, "exact", exact,
      "picture", error)
assert error < THRESHOLD, error
