# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Texture Segmentation through its proxy, drawn and compared with the baseline.

Arguments: folder of the baselines, and --update to write them anew (then look at them).
"""
import os
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from Pictures import THRESHOLD, difference
from trivariate import vtkTextureSegmentation

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."

# Three materials of one mean density: a ball of layers and a slab of columns in a checkered block.
block = Wavelet(WholeExtent=[-20, 19, -20, 19, -20, 19])
pattern = "cos(3.14159265*({}))"
checkered, columns, layered = (pattern.format(sum) for sum in (
    "coordsX+coordsY+coordsZ", "coordsX+coordsY", "coordsZ"))
noise = "0.2*sin(12.9898*coordsX*coordsY+78.233*coordsY*coordsZ+37.719*coordsZ*coordsX)"
volume = Calculator(Input=block, ResultArrayName="Density", Function=(
    f"{noise}+if(mag(coords)<12, {layered}, if(coordsX+0.5*coordsZ>14, {columns}, {checkered}))"))
segmentation = TextureSegmentation(Input=volume, Scalars=["POINTS", "Density"])

# The proxy's attributes are those of the class, and unknown to no one.
default = vtkTextureSegmentation()
names = [default.GetTextureAttribute(i) for i in range(default.GetNumberOfTextureAttributes())]
assert list(segmentation.TextureAttributes) == names and len(names) == 22
segmentation.UpdatePipeline()
assert "Contrast" not in segmentation.PointData.keys()
criterion = vtk_to_numpy(servermanager.Fetch(segmentation).GetFieldData().GetArray(
    "SegmentCriterion"))
assert list(criterion[:, 0]) == [2, 3, 4, 5, 6, 7, 8] and 0 <= criterion[:, 1].min() <= 1

segmentation.NumberOfSegments = 3
segmentation.TextureAttributes = ["Contrast", "Correlation", "InverseDifference"]
segmentation.OutputAttributes = 1
segmentation.UpdatePipeline()
image = servermanager.Fetch(segmentation)
labels = vtk_to_numpy(image.GetPointData().GetArray("Segment"))
attributes = [name for name in names if image.GetPointData().HasArray(name)]
assert attributes == ["Contrast", "InverseDifference", "Correlation"], attributes

points = numpy.array([image.GetPoint(i) for i in range(image.GetNumberOfPoints())])
truth = numpy.where((points**2).sum(1) < 144, 2,
                    numpy.where(points[:, 0] + 0.5 * points[:, 2] > 14, 1, 0))
counts = numpy.array([[((labels == s) & (truth == t)).sum() for t in range(3)] for s in range(3)])
print(counts)
assert sorted(counts.argmax(1)) == [0, 1, 2]
assert counts.max(1).sum() > 0.98 * counts.sum()

# The numbers of the segments are those of their mean densities, which here are equal but for noise.
means = vtk_to_numpy(image.GetFieldData().GetArray("SegmentMeanDensity"))
assert numpy.all(numpy.diff(means) > 0.0) and numpy.abs(means).max() < 0.1

view = CreateRenderView(ViewSize=[300, 300], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
half = ExtractSubset(Input=segmentation, VOI=[-20, 19, -20, 0, -20, 19])
shown = Show(half, view)
shown.SetRepresentationType("Surface")
ColorBy(shown, ("POINTS", "Segment"))
shown.InterpolateScalarsBeforeMapping = 0
shown.SetScalarBarVisibility(view, False)
shown.Ambient, shown.Diffuse = 1.0, 0.0
table = GetColorTransferFunction("Segment")
# By material, whatever number the densities' noise gives it.
colours = {0: [0.25, 0.3, 0.45], 1: [0.95, 0.75, 0.3], 2: [0.8, 0.3, 0.25]}
table.RGBPoints = sum(([float(s), *colours[counts[s].argmax()]] for s in range(3)), [])
view.CameraPosition = [-30, 90, 40]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
view.ResetCamera()
SaveScreenshot(os.path.join(folder, "TextureSegments.png"), view, ImageResolution=[300, 300])
error = difference("TextureSegments", folder, baselines)
print(error)
assert error < THRESHOLD, error
