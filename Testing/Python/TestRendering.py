# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws an orbital's spline in three forms and compares with the baselines.
TestAnnulus.py draws Bezier cells.

Arguments: folder of the baselines, and --update to write them anew (then look at them).
"""
import os
import sys

from paraview.simple import *

from Pictures import THRESHOLD, difference

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."


def picture(name, proxy, representation, array=None):
    view = CreateRenderView(ViewSize=[300, 300], UseColorPaletteForBackground=0,
                            Background=[1, 1, 1], OrientationAxesVisibility=0)
    shown = Show(proxy, view)
    shown.SetRepresentationType(representation)
    shown.LineWidth = 1.5
    if array:
        ColorBy(shown, ("POINTS", array))
        GetColorTransferFunction(array).RescaleTransferFunction(0.0, 6e-5)
    else:
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = [0.93, 0.80, 0.62]
    view.CameraPosition = [-2, -3, 1.5]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    view.ResetCamera()
    SaveScreenshot(os.path.join(folder, name + ".png"), view, ImageResolution=[300, 300])


orbital = TrivariateOrbital(Dimensions=[32, 32, 32], HalfWidth=32.0)
fit = TSplineFit(Input=orbital, RMSTolerance=0.5)
image = TSplineSource(Input=fit, OutputType="Image", Points=orbital)
surface = Contour(Input=image, ContourBy=["POINTS", "Density"], Isosurfaces=[2e-5])
picture("OrbitalIsoSurface", surface, "Surface")
hexes = TSplineSource(Input=fit, OutputType="Linear Hexahedra")
half = Clip(Input=hexes, ClipType="Plane", Invert=0)
picture("OrbitalLinearHexahedra", half, "Surface With Edges", "Density")
surfaces = TSplineSource(Input=fit, OutputType="Iso-Parametric Surfaces",
                         SurfacesU=[0.5], SurfacesV=[0.5], SurfacesW=[0.5])
picture("OrbitalIsoParametricSurfaces", surfaces, "Surface", "Density")

errors = {name: difference(name, folder, baselines) for name in (
    "OrbitalIsoSurface", "OrbitalLinearHexahedra", "OrbitalIsoParametricSurfaces")}
print(errors)
assert all(error < THRESHOLD for error in errors.values()), errors
