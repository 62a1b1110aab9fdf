# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: a volume becomes a T-spline, a file, and an image again."""
from paraview import servermanager
from paraview.simple import *

orbital = TrivariateOrbital(Dimensions=[48, 48, 48])
fit = TSplineFit(Input=orbital, MaximumNumberOfControlPoints=2000)
SaveData("orbital.tspline", proxy=fit)

model = OpenDataFile("orbital.tspline")
image = TSplineSource(Input=model, Points=orbital, OutputType="Image")
spline = RenameArrays(Input=image, PointArrays=["Density", "Spline"])
both = AppendAttributes(Input=[orbital, spline])
error = Calculator(Input=both, Function="Spline - Density", ResultArrayName="Error")
error.UpdatePipeline()

rounds = servermanager.Fetch(fit, idx=1)
last = rounds.GetNumberOfRows() - 1
print("control points:", model.GetDataInformation().GetNumberOfPoints())
print("RMS error, % of the range:", rounds.GetValueByName(last, "RMS"))
print("error in space:", error.PointData["Error"].GetRange())
