# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: fits a volume and saves the report."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ball = Calculator(Input=Wavelet(WholeExtent=[-10, 9, -9, 9, -8, 9]), ResultArrayName="Density",
                  Function="if(mag(coords) < 6.2, 90 + RTData / 20, coordsZ * coordsX / 9)")
labels = Calculator(Input=ball, ResultArrayName="Segment", Function="if(mag(coords) < 6.2, 3, 0)")
fit = TSplineFit(Input=labels, Scalars=["POINTS", "Density"], MaximumNumberOfControlPoints=400)
surface = SegmentBoundary(Input=labels, UseDensity=0)
report = ReconstructionReport(Input=labels, TSpline=fit, Surfaces=surface,
                              Scalars=["POINTS", "Density"])
report.UpdatePipeline()
table = servermanager.Fetch(report)
grid = servermanager.Fetch(fit)
saved = {table.GetColumnName(i): vtk_to_numpy(table.GetColumn(i))
         for i in range(table.GetNumberOfColumns()) if table.GetColumn(i).IsNumeric()}
numpy.savez(sys.argv[1], Points=vtk_to_numpy(grid.GetPoints().GetData()),
            Density=vtk_to_numpy(grid.GetPointData().GetArray("Density")), **saved)

report.Scalars = ["POINTS", "RTData"]
report.UpdatePipeline()  # one error, and no rank waits for another
