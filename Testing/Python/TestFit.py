# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""T-Spline Fit through its proxy: arrays, mask, stopping, the table of rounds."""
import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

wavelet = Wavelet(WholeExtent=[-10, 10, -8, 8, 0, 12])
height = Calculator(Input=wavelet, Function="2*coordsX - coordsZ", ResultArrayName="Height")
volume = Calculator(Input=height, Function="coordsX < 4", ResultArrayName="Mask")
volume.UpdatePipeline()


def array(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


fit = TSplineFit(Input=volume, Scalars=["POINTS", "RTData"], MaximumNumberOfControlPoints=500)
assert list(fit.FurtherAttributes) == [] and fit.MaskArray == "None"
fit.UpdatePipeline()
assert "Height" not in fit.PointData.keys() and "RTData" in fit.PointData.keys()

fit.FurtherAttributes = ["Height"]
fit.UpdatePipeline()
grid = servermanager.Fetch(fit)
assert grid.GetNumberOfCells() == grid.GetNumberOfPoints() <= 500
points = vtk_to_numpy(grid.GetPoints().GetData())
linear = 2.0 * points[:, 0] - points[:, 2]
assert numpy.abs(array(grid, "Height") - linear).max() < 1e-2
assert array(grid, "KnotsU").shape == (len(points), 5) and array(grid, "Weight").min() > 0.0

# Masked: cheaper to the same tolerance, because a third of the volume need not be met.
fit.FurtherAttributes = []
fit.MaximumNumberOfControlPoints = 50000
fit.RMSTolerance = 1.0
counts = {}
for mask in ("None", "Mask"):
    fit.MaskArray = mask
    fit.UpdatePipeline()
    counts[mask] = fit.GetDataInformation().GetNumberOfPoints()
    rounds = servermanager.Fetch(fit, idx=1).GetRowData()
    assert vtk_to_numpy(rounds.GetArray("RMS"))[-1] <= 1.0
    assert vtk_to_numpy(rounds.GetArray("ControlPoints"))[-1] == counts[mask]
assert counts["Mask"] < counts["None"], counts

sizes = {}
fit.MaskArray = "None"
for rule in ("Compact", "Analysis Suitable", "Uniform"):
    fit.RefinementRule = rule
    fit.MaximumNumberOfControlPoints = 1500
    fit.UpdatePipeline()
    sizes[rule] = fit.GetDataInformation().GetNumberOfPoints()
    weights = array(servermanager.Fetch(fit), "Weight")
    assert rule == "Compact" or numpy.all(weights == 1.0)
print(counts, sizes)
assert len(set(sizes.values())) > 1 and max(sizes.values()) <= 1500
