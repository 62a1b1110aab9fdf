# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Hex Remesh as ParaView's user meets it: two segments, an Exodus file of them, and a picture.

Arguments: folder of the baselines, and --update to write the picture anew (then look at it).
"""
import os
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOExodus import vtkExodusIIReader

from Pictures import THRESHOLD, difference

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."

# A ball in an egg.
image = Wavelet(WholeExtent=[-14, 14, -12, 12, -12, 12])
egg = "sqrt(coordsX * coordsX * 0.7 + coordsY * coordsY + coordsZ * coordsZ) < 9.2"
ball = "sqrt(coordsX * coordsX + coordsY * coordsY + coordsZ * coordsZ) < 4.7"
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function=f"if({ball}, 2, if({egg}, 1, 0))")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface)
hexes = HexRemesh(Input=labels, Patches=OutputPort(domain, 0), Polycube=OutputPort(domain, 1),
                  EdgeLength=1.2)
mesh = OutputPort(hexes, 1)
hexes.UpdatePipeline()
output = hexes.GetClientSideObject().GetOutputDataObject(1)
segment = vtk_to_numpy(output.GetCellData().GetArray("Segment"))
assert output.GetFieldData().GetArray("InvertedCells").GetValue(1) == 0
assert set(segment) == {1, 2}

# An element block for each segment.
SaveData("hexes.ex2", proxy=mesh)
saved = vtkExodusIIReader()
saved.SetFileName("hexes.ex2")
saved.UpdateInformation()
counts = [saved.GetNumberOfEntriesInObject(saved.ELEM_BLOCK, block)
          for block in range(saved.GetNumberOfObjects(saved.ELEM_BLOCK))]
assert sorted(counts) == sorted(numpy.bincount(segment)[1:]), counts

view = CreateRenderView(ViewSize=[400, 300], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
for label, color in ((1, [0.8, 0.85, 0.9]), (2, [0.95, 0.75, 0.5])):
    own = Threshold(Input=mesh, Scalars=["CELLS", "Segment"], LowerThreshold=label,
                    UpperThreshold=label)
    half = Clip(Input=own, ClipType="Plane", Crinkleclip=1)
    half.ClipType.Origin = [0, 0, 0.1]
    half.ClipType.Normal = [0, 0, 1]
    drawn = Show(half, view)
    drawn.SetRepresentationType("Surface With Edges")
    drawn.ColorArrayName = [None, ""]
    drawn.DiffuseColor = color
view.CameraParallelProjection = 1
view.CameraPosition = [0, -20, 60]
view.CameraFocalPoint = [0, 0, -1]
view.CameraViewUp = [0, 1, 0]
view.CameraParallelScale = 10.5
SaveScreenshot(os.path.join(folder, "HexRemesh.png"), view, ImageResolution=[400, 300])
error = difference("HexRemesh", folder, baselines)
print("picture", error)
assert error < THRESHOLD, error
