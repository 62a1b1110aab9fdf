# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: a ball as one T-spline of seven blocks, whose faces lie on its surface."""
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

# A ball of smooth texture, its edge blurred by a voxel.
box = Wavelet(WholeExtent=[-14, 14, -14, 14, -14, 14])
density = Calculator(
    Input=box, ResultArrayName="Density",
    Function="min(1, max(0, 11.5 - mag(coords))) * (0.8 + 0.1*cos(coordsX/6)*cos(coordsY/7))")
volume = Calculator(Input=density, ResultArrayName="Segment", Function="if(Density > 0.01, 1, 0)")

# Its surface, its domain, directions along that, and parameters.
surface = SegmentBoundary(Input=volume, UseDensity=0)
domain = PolycubeDomain(Input=surface)
frames = FrameField(Input=volume, Patches=OutputPort(domain, 0))
parameters = VolumeParameterization(
    Input=frames, Patches=OutputPort(domain, 0), Polycube=OutputPort(domain, 1))

# One spline over all blocks, for shape and density.
fit = TSplineFit(Input=parameters, Polycube=OutputPort(parameters, 1),
                 BlockMeshes=OutputPort(parameters, 2), Scalars=["POINTS", "Density"],
                 MaximumNumberOfControlPoints=1000)
fit.UpdatePipeline()


def reached(name, of=fit):
    """The last number of a column of a fit's table of rounds, or its field data."""
    rounds = servermanager.Fetch(of, idx=1)
    column = rounds.GetRowData().GetArray(name)
    return vtk_to_numpy(column if column else rounds.GetFieldData().GetArray(name))[-1]


print("distinct control points:", reached("ControlPoints"))
print("RMS error: %.2f %%" % reached("RMS"))
print("distance from the surface in voxels, root mean square and largest:", reached("ShapeDistance"))
print("cells of the shape, with a fold, proven without:", reached("ShapeCells"))
SaveData("ball.tspline", proxy=fit)

# The same with functions that are linearly independent by construction; they take more points.
suitable = TSplineFit(Input=parameters, Polycube=OutputPort(parameters, 1),
                      BlockMeshes=OutputPort(parameters, 2), Scalars=["POINTS", "Density"],
                      RefinementRule="Analysis Suitable", MaximumNumberOfControlPoints=1000)
suitable.UpdatePipeline()
print("RMS error with the analysis-suitable rule: %.2f %%" % reached("RMS", suitable))
assert reached("ShapeCells", suitable)[1] == 0

# The same voxels without the domain, for comparison.
plain = TSplineFit(Input=parameters, Scalars=["POINTS", "Density"], MaskArray="ParameterMask",
                   MaximumNumberOfControlPoints=1000)
plain.UpdatePipeline()
error = reached("RMS", plain)
print("RMS error without the domain: %.2f %%" % error)
assert max(reached("RMS"), reached("RMS", suitable)) < 0.5 * error
assert reached("RMS") < 0.25 * error
assert reached("ShapeCells")[1] == 0

hexes = TSplineSource(Input=fit, OutputType="Linear Hexahedra")
hexes.UpdatePipeline()
print("hexahedra:", hexes.GetDataInformation().GetNumberOfCells())
