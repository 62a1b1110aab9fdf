# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch --symmetric on any number of ranks: each saves its own part of every output of the
T-spline source."""
import sys

import numpy
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkMultiProcessController

OUTPUTS = ["Image", "Linear Hexahedra", "Bezier Hexahedra", "Iso-Parametric Surfaces", "T-Mesh",
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


for name in OUTPUTS:
    source = TSplineSource(Input=fit, OutputType=name, ComputeGradients=1, ComputeJacobian=1)
    if name in ("Image", "Points"):
        source.Points = orbital  # its lattice, and its points: a piece on each rank
    source.UpdatePipeline()
    save(name, source.GetClientSideObject().GetOutputDataObject(0))
orbital.UpdatePipeline()
save("Orbital", orbital.GetClientSideObject().GetOutputDataObject(0))
