# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: three directions at every voxel of a segment, aligned with the patches of its domain."""
from paraview.simple import *

# A bent bar.
block = Wavelet(WholeExtent=[0, 39, 0, 39, -9, 9])
labels = Calculator(
    Input=block, ResultArrayName="Segment",
    Function="if(sqrt(coordsX^2 + coordsY^2) > 18.2 & sqrt(coordsX^2 + coordsY^2) < 34.7"
             " & abs(coordsZ) < 6.4 & coordsX > 1.5 & coordsY > 1.5, 1, 0)")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface)

# Frames that follow the patches: u, v, w grow from the low to the high side of the domain.
field = FrameField(Input=labels, Patches=OutputPort(domain, 0))
field.UpdatePipeline()


def known(source, name):
    data = source.GetClientSideObject().GetOutputDataObject(0).GetFieldData()
    return data.GetArray(name).GetComponent(0, 0)


print("voxels:", int(known(field, "FrameVoxels")))
print("normals are met to", known(field, "FrameAlignmentError"), "degrees")
print("singular plaquettes:", int(known(field, "FrameSingularPlaquettes")))
assert known(field, "FrameSingularPlaquettes") == 0
SaveData("fields.vti", proxy=field, DataMode="Binary")

# Without patches the normal may be any of the three, and there may be singular curves inside.
unaligned = FrameField(Input=labels)
unaligned.UpdatePipeline()
print("singular plaquettes without patches:", int(known(unaligned, "FrameSingularPlaquettes")))

# To look at: crosses of three colored lines at some voxels, and lines along one direction.
crosses = FrameGlyphs(Input=field)
lines = StreamTracer(Input=field, Vectors=["POINTS", "FrameV"], SeedType="Point Cloud")
lines.SeedType.Center = [19.0, 19.0, 0.0]
lines.SeedType.Radius = 8.0
lines.SeedType.NumberOfPoints = 50
lines.MaximumStreamlineLength = 100.0
for source in (crosses, lines):
    source.UpdatePipeline()
    print(source.GetDataInformation().GetNumberOfCells(), "lines")
    assert source.GetDataInformation().GetNumberOfCells() > 20
