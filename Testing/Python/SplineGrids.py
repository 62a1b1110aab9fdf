# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""T-spline grids made with NumPy alone, for tests of what takes them."""
import numpy as np
from vtkmodules.util.numpy_support import (numpy_to_vtk, numpy_to_vtkIdTypeArray,
                                           vtk_to_numpy)
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkCellArray, vtkUnstructuredGrid


def array(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def new_grid(points, arrays):
    """A grid of one vertex a point, with the point arrays of a dictionary."""
    grid = vtkUnstructuredGrid()
    control_points = vtkPoints()
    control_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    grid.SetPoints(control_points)
    vertices = vtkCellArray()
    vertices.SetData(1, numpy_to_vtkIdTypeArray(np.arange(len(points)), deep=True))
    grid.SetCells(VTK_VERTEX, vertices)
    for name, values in arrays.items():
        data = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        data.SetName(name)
        grid.GetPointData().AddArray(data)
    return grid


def tensor_product(cells, attributes, length=10.0, part=slice(None)):
    """The clamped tensor-product spline on `cells` equal intervals of [0, length] a direction, the
    identity as geometry; attributes: name -> function of the n x 3 Greville points. Only the control
    points of `part` are in the grid."""
    inner = np.linspace(0.0, length, cells + 1)
    line = np.concatenate([[0.0] * 3, inner, [length] * 3])
    local = np.array([line[i:i + 5] for i in range(cells + 3)])
    index = np.indices((cells + 3,) * 3).reshape(3, -1)[::-1]
    points = np.stack([local[i][:, 1:4].mean(axis=1) for i in index], axis=1)
    arrays = {name: function(points) for name, function in attributes.items()}
    arrays.update({"Knots" + axis: local[i] for axis, i in zip("UVW", index)})
    arrays["Weight"] = np.ones(len(points))
    arrays["Segment"] = arrays["Block"] = np.zeros(len(points), np.int32)
    return new_grid(points[part], {name: values[part] for name, values in arrays.items()})
