# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: the surfaces between the segments of a volume, and one segment's surface alone."""
from paraview.simple import *

# Two thresholds make three segments: 0 outside, 1 around, 2 inside.
orbital = TrivariateOrbital(Dimensions=[64, 64, 64], HalfWidth=32.0)
labels = Calculator(Input=orbital, ResultArrayName="Segment",
                    Function="(Density > 4e-6) + (Density > 2e-5)")

boundary = SegmentBoundary(Input=labels, Labels=["POINTS", "Segment"],
                           Density=["POINTS", "Density"])
SaveData("boundary.vtp", proxy=boundary)

inside = SegmentBoundary(Input=labels, Labels=["POINTS", "Segment"], Segments=[2],
                         Density=["POINTS", "Density"])
inside.UpdatePipeline()

print("triangles of all surfaces:", boundary.GetDataInformation().GetNumberOfCells())
print("triangles of segment 2:", inside.GetDataInformation().GetNumberOfCells())
labels = boundary.CellData["BoundaryLabels"]
print("inner sides:", labels.GetRange(0), "outer sides:", labels.GetRange(1))
