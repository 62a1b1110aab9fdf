# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Polycube Domain as ParaView's user meets it, and a picture of patches, borders and blocks.

Arguments: folder of the baselines, and --update to write the picture anew (then look at it).
"""
import os
import sys

from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

from Pictures import THRESHOLD, difference

baselines = sys.argv[1]
folder = baselines if "--update" in sys.argv else "."


def cells(port, name):
    return vtk_to_numpy(domain.GetClientSideObject().GetOutputDataObject(port).GetCellData()
                        .GetArray(name))


# An egg in an egg, with three different axes.
image = Wavelet(WholeExtent=[-20, 20, -16, 16, -16, 16])
radius = ("sqrt(coordsX * coordsX * (0.6 + 0.01 * coordsX) + coordsY * coordsY"
          " + 1.5 * coordsZ * coordsZ)")
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function=f"if({radius} < 6.5, 2, if({radius} < 12.2, 1, 0))")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface)
assert domain.Mode == "Automatic" and domain.Layered and list(domain.Segments) == []
assert list(domain.NumberOfCubes) == [0, 0, 0] and list(domain.SwitchedOffCubes) == []
domain.UpdatePipeline()
assert set(cells(0, "Segment")) == {1, 2} and set(cells(0, "PatchAxis")) == {0, 1, 2}
assert sorted(set(cells(0, "Patch"))) == list(range(12))
assert list(cells(1, "Block")) == list(range(13)) and sum(cells(1, "Patch") == -1) == 1
assert domain.GetClientSideObject().GetOutputDataObject(1).GetNumberOfPoints() == 24
assert len(cells(2, "BorderPatches")) == 24

view = CreateRenderView(ViewSize=[400, 400], UseColorPaletteForBackground=0,
                        Background=[1, 1, 1], OrientationAxesVisibility=0)
half = Clip(Input=OutputPort(domain, 0), ClipType="Plane", Invert=0)
half.ClipType.Origin = [0, 0, 0]
half.ClipType.Normal = [0, 1, 0]
shown = Show(half, view)
ColorBy(shown, ("CELLS", "Patch"))
shown.SetScalarBarVisibility(view, False)
lines = Show(OutputPort(domain, 2), view)
lines.ColorArrayName = [None, ""]
lines.AmbientColor = lines.DiffuseColor = [0, 0, 0]
lines.LineWidth = 3
blocks = Show(OutputPort(domain, 1), view)
blocks.SetRepresentationType("Wireframe")
blocks.ColorArrayName = [None, ""]
blocks.AmbientColor = blocks.DiffuseColor = [0.1, 0.3, 0.8]
blocks.LineWidth = 2
view.CameraPosition = [-25, -60, 35]
view.CameraFocalPoint = [0, 0, 0]
view.CameraViewUp = [0, 0, 1]
view.ResetCamera()
SaveScreenshot(os.path.join(folder, "PolycubeDomain.png"), view, ImageResolution=[400, 400])
error = difference("PolycubeDomain", folder, baselines)
print("picture", error)
assert error < THRESHOLD, error

# The corners found are where manual mode starts; a state file brings back what was picked.
inner = SegmentBoundary(Input=labels, UseDensity=0, Segments=[2])
RenameSource("picked", PolycubeDomain(Input=inner, Segments=[2]))
picked = FindSource("picked")
picked.UpdatePipeline()
picked.UpdatePipelineInformation()
start = list(picked.GetProperty("StartCorners").GetData())
assert len(start) == 24
start[0] += 0.5
picked.Mode = "Manual"
picked.CornerPositions = start
picked.SnapLimit = 0.25
picked.UpdatePipeline()


def state():
    source = FindSource("picked")
    source.UpdatePipeline()
    information = OutputPort(source, 0).GetDataInformation()
    return (source.Mode, list(source.CornerPositions), list(source.Segments), source.SnapLimit,
            list(source.NumberOfCubes), information.GetNumberOfCells())


before = state()
assert before[1] == start and before[5] > 1000
SaveState("domain.pvsm")
ResetSession()
LoadState("domain.pvsm")
assert state() == before, (state(), before)
