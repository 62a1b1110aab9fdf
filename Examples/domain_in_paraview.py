# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: cubes as the parameter domain of a segment, found automatically and laid out by hand."""
from paraview.simple import *

# An L-shaped block with a bump.
block = Wavelet(WholeExtent=[-16, 15, -16, 15, -10, 9])
labels = Calculator(
    Input=block, ResultArrayName="Segment",
    Function="if((abs(coordsX) < 12.2 & abs(coordsY) < 12.2 & abs(coordsZ) < 6.2"
             " & (coordsX < 0 | coordsY < 0)) | mag(coords - iHat * 6 + jHat * 6) < 7.8, 1, 0)")
surface = SegmentBoundary(Input=labels, UseDensity=0)

# Automatic: shape, corners and patches are found.
domain = PolycubeDomain(Input=surface)
domain.UpdatePipeline()
blocks = OutputPort(domain, 1).GetDataInformation().GetNumberOfCells()
print("blocks, with a layer along the surface:", blocks)
SaveData("patches.vtp", proxy=OutputPort(domain, 0), DataMode="Binary")
SaveData("domain.vtu", proxy=OutputPort(domain, 1), DataMode="Binary")

# By hand: 2 x 2 x 1 cubes without the last one. Its corners are the points (x, y, z) of the grid in
# order of z, then y, then x, without that of cube 3; each is moved to the surface.
corners = [[x, y, z] for z in (-6.5, 6.5) for y in (-12.5, 0.0, 12.5) for x in (-12.5, 0.0, 12.5)
           if x + y < 25.0]
by_hand = PolycubeDomain(Input=surface, Mode="Manual", NumberOfCubes=[2, 2, 1],
                         SwitchedOffCubes=[3], CornerPositions=sum(corners, []), Layered=0)
by_hand.UpdatePipeline()
polycube = OutputPort(by_hand, 1)
print("cubes by hand:", polycube.GetDataInformation().GetNumberOfCells())
print("moved to the surface by up to:", polycube.PointData["SnapDistance"].GetRange()[1])
assert polycube.GetDataInformation().GetNumberOfCells() == 3

# Automatic corners, corrected: they are the start positions of manual mode.
domain.UpdatePipelineInformation()
start = list(domain.GetProperty("StartCorners").GetData())
start[2] += 1.0
domain.Mode = "Manual"
domain.CornerPositions = start
domain.UpdatePipeline()
print("corners to start from:", len(start) // 3)
assert OutputPort(domain, 0).GetDataInformation().GetNumberOfCells() > 0

# Corners of one of two segments, in a second input whose array Segment says whose they are; the
# other segment gets the domain that is found.
pair = Calculator(
    Input=block, ResultArrayName="Segment",
    Function="if(abs(coordsX) > 2.2 & abs(coordsX) < 12.2 & abs(coordsY) < 6.2"
             " & abs(coordsZ) < 6.2, if(coordsX < 0, 1, 2), 0)")
picked = ProgrammableSource(OutputDataSetType="vtkPolyData", Script="""
import numpy
points = vtk.vtkPoints()
for z in (-6.5, 6.5):
    for y in (-6.5, 6.5):
        for x in (-12.5, -2.5):
            points.InsertNextPoint(x, y, z)
output.SetPoints(points)
output.PointData.append(numpy.ones(8, dtype=numpy.int32), "Segment")
""")
of_pair = PolycubeDomain(Input=SegmentBoundary(Input=pair, UseDensity=0), Corners=picked,
                         Mode="Manual", NumberOfCubes=[1, 1, 1])
of_pair.UpdatePipeline()
assert OutputPort(of_pair, 1).CellData["Segment"].GetRange() == (1, 2)
