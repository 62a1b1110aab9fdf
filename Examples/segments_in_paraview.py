# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: two materials of the same density, one checkered, one layered, told apart by texture."""
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

# A ball of layers, one voxel each, in a checkered block; noise from a hash of the position.
block = Wavelet(WholeExtent=[-20, 19, -20, 19, -20, 19])
checkered, layered = "cos(3.14159265*(coordsX+coordsY+coordsZ))", "cos(3.14159265*coordsZ)"
noise = "0.2*sin(12.9898*coordsX*coordsY+78.233*coordsY*coordsZ+37.719*coordsZ*coordsX)"
volume = Calculator(Input=block, ResultArrayName="Density",
                    Function=f"{noise}+if(mag(coords)<13, {layered}, {checkered})")

segments = TextureSegmentation(Input=volume, Scalars=["POINTS", "Density"], NumberOfSegments=2)
segments.UpdatePipeline()

image = servermanager.Fetch(segments)
labels = vtk_to_numpy(image.GetPointData().GetArray("Segment"))
inside = [sum(x * x for x in image.GetPoint(i)) < 169 for i in range(image.GetNumberOfPoints())]
ball = labels[image.FindPoint(0, 0, 0)]
right = ((labels == ball) == inside).mean()
print("points a segment:", vtk_to_numpy(image.GetFieldData().GetArray("SegmentSize")))
print("voxels in the right segment, %:", 100 * right)
assert right > 0.99
