# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frame Field as ParaView's user meets it, and a picture of crosses, streamlines and singular curves.

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


def output(source, port=0):
    return source.GetClientSideObject().GetOutputDataObject(port)


# An egg with three different axes, larger at one end.
image = Wavelet(WholeExtent=[-16, 16, -14, 14, -12, 12])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="if(sqrt(coordsX * coordsX * (0.6 + 0.01 * coordsX)"
                             " + coordsY * coordsY + 1.4 * coordsZ * coordsZ) < 10.2, 1, 0)")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface)
aligned = FrameField(Input=labels, Patches=OutputPort(domain, 0))
assert aligned.Step == "Automatic" and aligned.Start == "Linear" and aligned.Sweeps == 15
unaligned = FrameField(Input=labels)
for field in (aligned, unaligned):
    field.UpdatePipeline()
    frames = [vtk_to_numpy(output(field).GetPointData().GetArray("Frame" + axis)) for axis in "UVW"]
    inside = vtk_to_numpy(output(field).GetPointData().GetArray("Segment")) == 1
    assert numpy.allclose(numpy.cross(frames[0], frames[1]), frames[2], atol=1e-6)
    assert numpy.allclose(numpy.linalg.norm(frames[0], axis=1), inside, atol=1e-6)
    assert output(field, 2).GetNumberOfRows() > 10
assert output(aligned, 1).GetNumberOfCells() == 0
assert output(unaligned, 1).GetNumberOfCells() > 3

# Crosses at every third voxel of the segment, of three lines each as long as wanted.
crosses = FrameGlyphs(Input=aligned, Stride=3, Length=0.5)
crosses.UpdatePipeline()
axes = vtk_to_numpy(output(crosses).GetCellData().GetArray("FrameAxis"))
assert numpy.array_equal(axes, numpy.tile([0, 1, 2], len(axes) // 3))
assert 0.8 < len(axes) / 3 / (inside.sum() / 27) < 1.2
ends = vtk_to_numpy(output(crosses).GetPoints().GetData()).reshape(-1, 2, 3)
assert numpy.allclose(numpy.linalg.norm(ends[:, 1] - ends[:, 0], axis=1), 1.5, atol=1e-5)
slices = [ExtractSubset(Input=field, VOI=[-16, 16, -14, 14, 0, 0]) for field in (aligned, unaligned)]

# Lines along u, from one side of the segment to the other.
line = StreamTracer(Input=aligned, Vectors=["POINTS", "FrameU"], SeedType="Line",
                    MaximumStreamlineLength=100.0)
line.SeedType.Point1, line.SeedType.Point2 = [-9.0, 0.0, 0.0], [9.0, 0.0, 0.0]
line.SeedType.Resolution = 12
line.UpdatePipeline()
assert output(line).GetNumberOfCells() > 10

view = CreateRenderView(ViewSize=[600, 300], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
for shift, field, source in zip((-15, 15), (aligned, unaligned), slices):
    drawn = Show(FrameGlyphs(Input=source, Stride=2), view)
    ColorBy(drawn, ("CELLS", "FrameAxis"))
    drawn.SetScalarBarVisibility(view, False)
    drawn.LineWidth = 2
    drawn.Position = [shift, 0, 0]
GetColorTransferFunction("FrameAxis").RGBPoints = [0, 0.85, 0.2, 0.1, 1, 0.1, 0.55, 0.2,
                                                   2, 0.1, 0.3, 0.8]
graph = Show(OutputPort(unaligned, 1), view)
graph.ColorArrayName = [None, ""]
graph.AmbientColor = graph.DiffuseColor = [0, 0, 0]
graph.LineWidth = 3
graph.Position = [15, 0, 0]
followed = Show(line, view)
followed.ColorArrayName = [None, ""]
followed.AmbientColor = followed.DiffuseColor = [0.9, 0.6, 0.1]
followed.LineWidth = 2
followed.Position = [-15, 0, 0]
view.CameraParallelProjection = 1
view.CameraPosition = [0, -20, 60]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 1, 0]
view.CameraParallelScale = 15.5
SaveScreenshot(os.path.join(folder, "FrameField.png"), view, ImageResolution=[600, 300])
error = difference("FrameField", folder, baselines)
print("picture", error)
assert error < THRESHOLD, error
