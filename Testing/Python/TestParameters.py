# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Volume Parameterization as ParaView's user meets it, and a picture of parameters and blocks.

Arguments: folder of the baselines, and --update to write the picture anew (then look at it).
"""
import os
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from Pictures import THRESHOLD, difference

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."

# An egg with three different axes, larger at one end.
image = Wavelet(WholeExtent=[-13, 13, -11, 11, -10, 10])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="if(sqrt(coordsX * coordsX * (0.6 + 0.01 * coordsX)"
                             " + coordsY * coordsY + 1.4 * coordsZ * coordsZ) < 8.2, 1, 0)")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface, Layered=0)
frames = FrameField(Input=labels, Patches=OutputPort(domain, 0))
parameters = VolumeParameterization(Input=frames, Patches=OutputPort(domain, 0),
                                    Polycube=OutputPort(domain, 1), CellLength=1.5)
assert parameters.Epsilon == 1 and parameters.Gradient == "Trilinear" and parameters.Rounds == 0
parameters.UpdatePipeline()
output = parameters.GetClientSideObject().GetOutputDataObject(0)
arrays = {name: vtk_to_numpy(output.GetPointData().GetArray(name))
          for name in ("Segment", "Parameter", "ParameterMask", "Block")}
inside = arrays["Segment"] == 1
assert numpy.array_equal(arrays["ParameterMask"] == 1, inside)
assert numpy.array_equal(arrays["Block"], numpy.where(inside, 0, -1))
assert arrays["Parameter"].min() >= 0 and arrays["Parameter"].max() <= 1
assert output.GetFieldData().GetArray("InvertedCells").GetValue(1) == 0
assert parameters.GetClientSideObject().GetOutputDataObject(2).GetNumberOfPartitionedDataSets() == 1

view = CreateRenderView(ViewSize=[600, 300], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
blocks = Clip(Input=OutputPort(parameters, 2), ClipType="Plane", Crinkleclip=1)
blocks.ClipType.Origin = [0, 0, 0]
blocks.ClipType.Normal = [0, 0, 1]
drawn = Show(blocks, view)
drawn.SetRepresentationType("Surface With Edges")
drawn.ColorArrayName = [None, ""]
drawn.DiffuseColor = [0.8, 0.85, 0.9]
drawn.Position = [-13, 0, 0]
segment = Threshold(Input=parameters, Scalars=["POINTS", "ParameterMask"], LowerThreshold=1,
                    UpperThreshold=1)
middle = Slice(Input=segment, SliceType="Plane")
middle.SliceType.Origin = [0, 0, 0.1]
middle.SliceType.Normal = [0, 0, 1]
for axis, color in zip("XYZ", ([0.85, 0.2, 0.1], [0.1, 0.55, 0.2], [0.1, 0.3, 0.8])):
    values = Calculator(Input=middle, ResultArrayName="Value", Function=f"Parameter_{axis}")
    lines = Show(Contour(Input=values, ContourBy=["POINTS", "Value"],
                         Isosurfaces=[0.1 * step for step in range(1, 10)]), view)
    lines.ColorArrayName = [None, ""]
    lines.AmbientColor = lines.DiffuseColor = color
    lines.LineWidth = 2
    lines.Position = [13, 0, 0]
view.CameraParallelProjection = 1
view.CameraPosition = [0, -12, 60]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 1, 0]
view.CameraParallelScale = 13.5
SaveScreenshot(os.path.join(folder, "VolumeParameterization.png"), view, ImageResolution=[600, 300])
error = difference("VolumeParameterization", folder, baselines)
print("picture", error)
assert error < THRESHOLD, error
