# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws an orbital's spline in three forms and compares with the baselines.
TestAnnulus.py draws Bezier cells.

Arguments: folder of the baselines, and --update to write them anew (then look at them).
"""
import os
import sys

from paraview.simple import *

from Pictures import THRESHOLD, difference, mean_difference

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


def cut_picture(name, half, target, scale=1.0):
    """The density on the cut face of half of the hexahedra, filling the picture with flat colors."""
    view = CreateRenderView(ViewSize=[300, 300], UseColorPaletteForBackground=0,
                            Background=[1, 1, 1], OrientationAxesVisibility=0)
    shown = Show(half, view)
    shown.SetRepresentationType("Surface")
    shown.Ambient, shown.Diffuse, shown.Specular = 1.0, 0.0, 0.0
    ColorBy(shown, ("POINTS", "Density"))
    GetColorTransferFunction("Density").RescaleTransferFunction(0.0, 6e-5 / scale)
    shown.SetScalarBarVisibility(view, False)
    view.CameraPosition = [-100, -40, 30]
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraViewUp = [0, 0, 1]
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 26
    SaveScreenshot(os.path.join(target, name + ".png"), view, ImageResolution=[300, 300])


orbital = TrivariateOrbital(Dimensions=[32, 32, 32], HalfWidth=32.0)
fit = TSplineFit(Input=orbital, RMSTolerance=0.5)
image = TSplineSource(Input=fit, OutputType="Image", Points=orbital)
surface = Contour(Input=image, ContourBy=["POINTS", "Density"], Isosurfaces=[2e-5])
picture("OrbitalIsoSurface", surface, "Surface")
surfaces = TSplineSource(Input=fit, OutputType="Iso-Parametric Surfaces",
                         SurfacesU=[0.5], SurfacesV=[0.5], SurfacesW=[0.5])
picture("OrbitalIsoParametricSurfaces", surfaces, "Surface", "Density")

# Close enough to the orbital that the mesh does not show.
close = TSplineFit(Input=orbital, RMSTolerance=0.05)
hexes = TSplineSource(Input=close, OutputType="Linear Hexahedra", Subdivisions=4)
half = Clip(Input=hexes, ClipType="Plane", Invert=0)
cut_picture("OrbitalLinearHexahedra", half, folder)

errors = {name: difference(name, folder, baselines)
          for name in ("OrbitalIsoSurface", "OrbitalIsoParametricSurfaces")}
print(errors)
assert all(error < THRESHOLD for error in errors.values()), errors

# Values that are 5 % wrong, or a place that is a quarter of a voxel wrong, must show.
baseline = os.path.join(baselines, "OrbitalLinearHexahedra.png")
error = mean_difference(os.path.join(folder, "OrbitalLinearHexahedra.png"), baseline)
cut_picture("Brighter", half, ".", scale=1.05)
moved = Transform(Input=half)
moved.Transform.Translate = [0.0, 0.5, 0.0]
cut_picture("Moved", moved, ".")
wrong = [mean_difference(name, baseline) for name in ("Brighter.png", "Moved.png")]
print(error, wrong)
assert error < 1.5 < min(wrong), (error, wrong)
