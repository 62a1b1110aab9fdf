# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: a segment filled with hexahedra that follow its surface, and their quality."""
from paraview.simple import *

# An egg with one end thicker than the other, and a density that grows along it.
image = Wavelet(WholeExtent=[-20, 20, -14, 14, -14, 14])
radius = "sqrt(coordsX * coordsX * (0.6 + 0.01 * coordsX) + coordsY * coordsY + coordsZ * coordsZ)"
labels = Calculator(Input=image, ResultArrayName="Segment", Function=f"if({radius} < 10.2, 1, 0)")
density = Calculator(Input=labels, ResultArrayName="density", Function="coordsX + 20")
domain = PolycubeDomain(Input=SegmentBoundary(Input=density, UseDensity=0))

hexes = HexRemesh(Input=density, Patches=OutputPort(domain, 0), Polycube=OutputPort(domain, 1),
                  EdgeLength=1.5)
hexes.UpdatePipeline()
hexes.UpdatePipelineInformation()
print("inverted hexahedra before and after untangling:",
      hexes.GetProperty("InvertedBefore").GetElement(0),
      hexes.GetProperty("InvertedCells").GetElement(0))
print("scaled Jacobian, least and mean:",
      round(hexes.GetProperty("LeastScaledJacobian").GetElement(0), 3),
      round(hexes.GetProperty("MeanScaledJacobian").GetElement(0), 3))

# All hexahedra in one mesh, ready for a solver.
mesh = OutputPort(hexes, 1)
print("hexahedra:", mesh.GetDataInformation().GetNumberOfCells())
SaveData("hexmesh.vtu", proxy=mesh, DataMode="Binary")

assert hexes.GetProperty("InvertedCells").GetElement(0) == 0
assert mesh.CellData["ScaledJacobian"].GetRange()[0] > 0.2
assert mesh.PointData["density"].GetRange()[0] > 4.0
assert OutputPort(hexes, 0).GetDataInformation().GetNumberOfCells() == \
    mesh.GetDataInformation().GetNumberOfCells()
