# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The examples of Documentation/FileFormat.md do what the page says, in plain Python with h5py."""
import pathlib
import re
import sys

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from SplineGrids import array, tensor_product
from trivariate import vtkTSplineReader, vtkTSplineWriter

page = (pathlib.Path(sys.argv[1]) / "Documentation" / "FileFormat.md").read_text()
examples = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
assert len(examples) == 3, len(examples)
assert len(examples[0].strip().splitlines()) <= 12, "the reading example has about ten lines"

# A linear density is reproduced exactly, so that the example's evaluation can be checked.
grid = tensor_product(4, {"density/raw": lambda p: 2 * p[:, :1] - p[:, 2:], "velocity": lambda p: p})
writer = vtkTSplineWriter()
writer.SetInputDataObject(grid)
writer.SetFileName("model.tspline")
assert writer.Write() == 1

names = {}
for example in examples:
    exec(example, names)

for axis, knots in zip("UVW", names["knots"]):
    assert np.array_equal(knots, array(grid, "Knots" + axis)), axis
assert np.array_equal(names["points"], vtk_to_numpy(grid.GetPoints().GetData()))
assert np.array_equal(names["weights"], array(grid, "Weight"))
assert list(names["attributes"]) == ["density/raw", "velocity"]
assert np.array_equal(names["attributes"]["velocity"], array(grid, "velocity"))
for parameter in np.random.default_rng(1).uniform(0, 10, (20, 3)):
    assert np.allclose(names["evaluate"](names["points"], *parameter), parameter, atol=1e-12)
    density = names["evaluate"](names["attributes"]["density/raw"], *parameter)
    assert abs(density - (2 * parameter[0] - parameter[2])) < 1e-12

# What the writing example wrote is the same spline.
reader = vtkTSplineReader()
reader.SetFileName("copy.tspline")
reader.Update()
copy = reader.GetOutput()
assert reader.GetErrorCode() == 0 and copy.GetNumberOfPoints() == grid.GetNumberOfPoints()
data = grid.GetPointData()
for name in [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]:
    assert np.array_equal(array(copy, name), array(grid, name)), name
