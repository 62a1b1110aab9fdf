# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Plain Python, VTK only: a NumPy array becomes a T-spline and is evaluated off its grid."""
import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData

from trivariate import vtkTSplineFit, vtkTSplineSource


def wave(x, y, z):
    return numpy.sin(x) * numpy.cos(0.5 * y) + 0.1 * z


# 40 x 30 x 20 points, 0.2 apart; VTK wants x to run fastest.
z, y, x = numpy.meshgrid(*(0.2 * numpy.arange(n) for n in (20, 30, 40)), indexing="ij")
image = vtkImageData()
image.SetDimensions(40, 30, 20)
image.SetSpacing(0.2, 0.2, 0.2)
values = numpy_to_vtk(wave(x, y, z).ravel(), deep=True)
values.SetName("wave")
image.GetPointData().SetScalars(values)

fit = vtkTSplineFit()
fit.SetInputData(image)
fit.SetRMSTolerance(0.01)  # percent of the range

where = numpy.random.default_rng(1).uniform((0, 0, 0), (7.8, 5.8, 3.8), (1000, 3))
points = vtkPoints()
points.SetData(numpy_to_vtk(where, deep=True))
targets = vtkPolyData()
targets.SetPoints(points)

source = vtkTSplineSource()
source.SetInputConnection(fit.GetOutputPort())
source.SetInputData(1, targets)
source.SetOutputType(vtkTSplineSource.POINTS)
source.Update()

spline = vtk_to_numpy(source.GetOutputDataObject(0).GetPointData().GetArray("wave"))
error = numpy.abs(spline - wave(*where.T)).max()
print(fit.GetOutput().GetNumberOfPoints(), "control points, largest error", error)
assert error < 0.01
