# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: from a volume to one T-spline with a part for each segment, and back to an image."""
from paraview.simple import *

# A ball of one material in another.
ball = Calculator(Input=Wavelet(WholeExtent=[-14, 14] * 3), ResultArrayName="Density",
                  Function="if(mag(coords) < 9.3, 200 + 10 * sin(coordsX / 2), coordsZ)")
reconstruction = TSplineReconstruction(Input=ball, Scalars=["POINTS", "Density"],
                                       NumberOfSegments=2, Domain="Segments",
                                       MaximumNumberOfControlPoints=1000, RMSTolerance=0.05)
SaveData("ball.tspline", proxy=reconstruction)

# The segmented image tells whose spline counts at a point.
segments = OutputPort(reconstruction, 2)
image = TSplineSource(Input=reconstruction, Points=segments, OutputType="Image")
SaveData("ball.vti", proxy=image)

report = ReconstructionReport(Input=segments, TSpline=reconstruction,
                              Rounds=OutputPort(reconstruction, 1), Scalars=["POINTS", "Density"])
report.UpdatePipeline()
table = report.GetClientSideObject().GetOutput()
for row in range(table.GetNumberOfRows()):
    segment, points, rms = (table.GetValueByName(row, name).ToDouble() for name in (
        "Segment", "ControlPoints", "RoundTripRMSPercent"))
    print(f"segment {segment:2.0f}: {points:4.0f} control points, RMS {rms:.3f} %")
    assert rms < 1.0 and table.GetValueByName(row, "FoundPercent").ToDouble() == 100.0
print("triangles between segments:", OutputPort(reconstruction, 3).GetDataInformation().GetNumberOfCells())
assert table.GetNumberOfRows() == 3
