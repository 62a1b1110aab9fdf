# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""A T-spline made on a server arrives whole at the client: control points, knots, weights, and of
Bezier cells the plain twins of the weights and degrees that VTK drops on the way."""
import socket
import subprocess
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy


def pipeline():
    """The fit's grid and its Bezier cells as they reach the client."""
    orbital = TrivariateOrbital(Dimensions=[32, 32, 32])
    fit = TSplineFit(Input=orbital, MaximumNumberOfControlPoints=800)
    fit.UpdatePipeline()
    cells = TSplineSource(Input=fit, OutputType="Bezier Hexahedra")
    cells.UpdatePipeline()
    return servermanager.Fetch(fit), servermanager.Fetch(cells)


def point_arrays(grid):
    data = grid.GetPointData()
    arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)).copy()
              for i in range(data.GetNumberOfArrays())}
    arrays["Points"] = vtk_to_numpy(grid.GetPoints().GetData()).copy()
    return arrays


here = [point_arrays(grid) for grid in pipeline()]

with socket.socket() as free:
    free.bind(("localhost", 0))
    port = free.getsockname()[1]
server = subprocess.Popen([sys.argv[1], f"--server-port={port}"], stdout=subprocess.PIPE, text=True)
try:
    while "Accepting connection" not in server.stdout.readline():
        assert server.poll() is None, "the server ended"
    Connect("localhost", port)
    grid, cells = pipeline()
    there = [point_arrays(grid), point_arrays(cells)]
except BaseException:
    server.kill()
    raise
# The server ends when this process closes its connection.

for name in ("Density", "KnotsU", "KnotsV", "KnotsW", "Weight", "Segment", "Block", "Points"):
    assert numpy.array_equal(here[0][name], there[0][name]), name
weight = there[0]["Weight"]
assert 500 < len(weight) <= 800 and weight.min() > 0 and weight.min() < weight.max()
assert grid.GetNumberOfCells() == grid.GetNumberOfPoints()

for name in ("Density", "BezierWeights", "Points"):
    assert numpy.array_equal(here[1][name], there[1][name]), name
degrees = vtk_to_numpy(cells.GetCellData().GetArray("BezierDegrees"))
assert degrees.shape == (cells.GetNumberOfCells(), 3) and (degrees == 3).all()
# The spline rebuilt from what arrived evaluates to the same numbers.
import trivariate
source = trivariate.vtkTSplineSource()
source.SetInputData(grid)
source.SetOutputType(trivariate.vtkTSplineSource.BEZIER_HEXES)
source.Update()
again = point_arrays(source.GetOutputDataObject(0))
assert numpy.array_equal(again["Density"], here[1]["Density"])
print(len(weight), "control points, weights", weight.min(), "to", weight.max(), "arrived whole")
