# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Segment Boundary as ParaView's user meets it, and a picture of its surfaces.

Arguments: folder of the baselines, and --update to write the picture anew (then look at it).
"""
import os
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from Pictures import THRESHOLD, difference

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."

# Two halves of a ball, and a shell around a part of it that the border of the image cuts.
image = Wavelet(WholeExtent=[-20, 20, -20, 20, -20, 14])
labels = Calculator(
    Input=image, ResultArrayName="Segment",
    Function="if(mag(coords) < 13.3, if(coordsX + 0.2 * coordsZ < 2.2, 1, 2),"
             " if(mag(coords) < 19.2 & coordsY > 0.5, 3, 0))")
boundary = SegmentBoundary(Input=labels)
assert list(boundary.Labels)[-1] == list(boundary.Density)[-1] == "Automatic"
assert list(boundary.Segments) == [] and boundary.UseDensity and boundary.SmoothingIterations == 60
boundary.UseDensity = 0
surface = servermanager.Fetch(boundary)
pairs = vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels"))
expected = {(1, 0), (2, 0), (3, 0), (1, 2), (1, 3), (2, 3), (3, -1)}
assert {tuple(pair) for pair in pairs} == expected, set(map(tuple, pairs))
points = vtk_to_numpy(surface.GetPoints().GetData())
triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
values = vtk_to_numpy(servermanager.Fetch(labels).GetPointData().GetArray("Segment"))
for segment in (1, 2, 3):
    sign = (pairs[:, 0] == segment).astype(int) - (pairs[:, 1] == segment)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    volume = numpy.sum(sign * numpy.einsum("ij,ij->i", a, numpy.cross(b, c))) / 6.0
    count = numpy.count_nonzero(values == segment)
    print("segment", segment, "volume", volume, "voxels", count)
    assert abs(volume / count - 1.0) < 0.005

view = CreateRenderView(ViewSize=[400, 400], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
colors = {1: [0.85, 0.45, 0.35], 2: [0.35, 0.55, 0.85], 3: [0.75, 0.72, 0.60]}
for segment, color in colors.items():
    part = SegmentBoundary(Input=labels, Segments=[segment], UseDensity=0,
                           Labels=["POINTS", "Segment"])
    shown = Show(part, view)
    shown.SetRepresentationType("Surface With Edges" if segment == 2 else "Surface")
    shown.EdgeColor = [0.1, 0.2, 0.4]
    shown.ColorArrayName = [None, ""]
    shown.DiffuseColor = color
view.CameraPosition = [-30, -60, 35]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
view.ResetCamera()
SaveScreenshot(os.path.join(folder, "SegmentBoundary.png"), view, ImageResolution=[400, 400])
error = difference("SegmentBoundary", folder, baselines)
print("picture", error)
assert error < THRESHOLD, error
