# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: fits an image and saves what reaches the client."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

image = Wavelet(WholeExtent=[-12, 11, 3, 22, 0, 15])
fit = TSplineFit(Input=image, MaximumNumberOfControlPoints=600)
fit.UpdatePipeline()
grid = servermanager.Fetch(fit)
rounds = servermanager.Fetch(fit, idx=1)
data = grid.GetPointData()
arrays = {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i))
          for i in range(data.GetNumberOfArrays())}
numpy.savez(sys.argv[1], Points=vtk_to_numpy(grid.GetPoints().GetData()),
            RMS=vtk_to_numpy(rounds.GetRowData().GetArray("RMS")), **arrays)

fit.MaskArray = "absent"
fit.UpdatePipeline()  # one error, and no rank waits for another
