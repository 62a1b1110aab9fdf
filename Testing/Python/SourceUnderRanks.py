# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch --symmetric on any number of ranks: each saves its own part of every output of the
T-spline source."""
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

OUTPUTS = ["Image", "Labelled Image",  # the latter of a spline that stands for a segment
            "Linear Hexahedra", "Bezier Hexahedra", "Iso-Parametric Surfaces", "T-Mesh",
           "Points"]

rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
orbital = TrivariateOrbital(Dimensions=[24, 20, 22], N=2, L=1)
fit = TSplineFit(Input=orbital, MaximumNumberOfControlPoints=400)


def save(name, data):
    arrays = {}
    for kind, fields in ("point", data.GetPointData()), ("cell", data.GetCellData()):
        for i in range(fields.GetNumberOfArrays()):
            array = fields.GetArray(i)
            arrays[f"{kind} {array.GetName()}"] = vtk_to_numpy(array)
    arrays["count"] = numpy.array([data.GetNumberOfPoints(), data.GetNumberOfCells()])
    arrays["places"] = numpy.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])
    numpy.savez(f"{sys.argv[1]}-{name}-{rank}.npz", **arrays)


of_segment = Calculator(Input=fit, ResultArrayName="Segment", Function="2",
                        ResultArrayType="Int")
ball = Calculator(Input=orbital, ResultArrayName="Segment", Function="if(mag(coords) < 6, 2, 1)")

for name in OUTPUTS:
    source = TSplineSource(Input=of_segment if name == "Labelled Image" else fit,
                           OutputType=name.split()[-1] if "Image" in name else name,
                           ComputeGradients=1, ComputeJacobian=1)
    # A lattice, and points: a piece of them on each rank.
    if name in ("Image", "Points"):
        source.Points = orbital
    elif name == "Labelled Image":
        source.Points = ball
    source.UpdatePipeline()
    save(name, source.GetClientSideObject().GetOutputDataObject(0))
orbital.UpdatePipeline()
save("Orbital", orbital.GetClientSideObject().GetOutputDataObject(0))
