# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: parameters u, v, w in a bent bar, and its block of hexahedra."""
from paraview.simple import *

# A quarter of a ring.
block = Wavelet(WholeExtent=[0, 27, 0, 27, -9, 9])
labels = Calculator(
    Input=block, ResultArrayName="Segment",
    Function="if(sqrt(coordsX^2 + coordsY^2) > 12.2 & sqrt(coordsX^2 + coordsY^2) < 24.7"
             " & abs(coordsZ) < 6.4 & coordsX > 0.5 & coordsY > 0.5, 1, 0)")
surface = SegmentBoundary(Input=labels, UseDensity=0)
domain = PolycubeDomain(Input=surface, Layered=0)
frames = FrameField(Input=labels, Patches=OutputPort(domain, 0))

# Each voxel gets its place in the domain, the domain a grid of hexahedra.
parameters = VolumeParameterization(Input=frames, Patches=OutputPort(domain, 0),
                                    Polycube=OutputPort(domain, 1))
parameters.UpdatePipeline()


def known(name):
    data = parameters.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetArray(name)
    return data.GetTuple(0)


print("lengths of the domain:", known("ParameterLengths"))
print("inverted cells before and after:", known("InvertedCells"))
print("scaled Jacobian, least and mean:", known("ScaledJacobian"))
assert known("InvertedCells")[1] == 0
SaveData("parameters.vti", proxy=parameters, DataMode="Binary")
SaveData("blocks.vtpc", proxy=OutputPort(parameters, 2), DataMode="Binary")
