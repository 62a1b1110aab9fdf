# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: how well and in how many bytes a T-spline stands for a volume, segment by segment."""
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

orbital = TrivariateOrbital(Dimensions=[48, 48, 48], HalfWidth=32.0)
labels = Calculator(Input=orbital, ResultArrayName="Segment", Function="Density > 4e-6")
fit = TSplineFit(Input=labels, Scalars=["POINTS", "Density"], MaximumNumberOfControlPoints=1000)
report = ReconstructionReport(Input=labels, TSpline=fit, Rounds=OutputPort(fit, 1),
                              Scalars=["POINTS", "Density"])
report.UpdatePipeline()
SaveData("report.csv", proxy=report)

table = report.GetClientSideObject().GetOutput()
column = {table.GetColumnName(i): vtk_to_numpy(table.GetColumn(i))
          for i in range(table.GetNumberOfColumns()) if table.GetColumn(i).IsNumeric()}
for segment, voxels, rms in zip(column["Segment"], column["Voxels"], column["RoundTripRMSPercent"]):
    print("all" if segment == -1 else f"segment {segment}", voxels, f"voxels, RMS {rms:.3f} %")
print(f"{column['ControlPoints'][-1]:.0f} control points, {column['SplineBytes'][-1]:.0f} bytes "
      f"instead of {column['RawBytes'][-1]:.0f}, or {column['ZLibBytes'][-1]:.0f} deflated")
assert list(column["Segment"]) == [0, 1, -1]
assert column["FoundPercent"].min() == 100.0 and column["SplineBytes"][-1] < column["ZLibBytes"][-1]
assert column["RoundTripRMSPercent"][-1] < 1.0
