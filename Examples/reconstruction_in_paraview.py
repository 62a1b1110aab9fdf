# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""pvpython: from a volume to one T-spline with a part for each segment, and back to an image: over the
segments' boxes, over what is most accurate, and over cubes that are given."""
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



def report_on(name, reconstruction, **surfaces):
    """Prints the report, and returns over what each segment was fitted."""
    report = ReconstructionReport(Input=OutputPort(reconstruction, 2), TSpline=reconstruction,
                                  Rounds=OutputPort(reconstruction, 1), Scalars=["POINTS", "Density"],
                                  **surfaces)
    report.UpdatePipeline()
    table = report.GetClientSideObject().GetOutput()
    domains = []
    for row in range(table.GetNumberOfRows()):
        segment, points, corners, own, rms, found = (
            table.GetValueByName(row, column).ToDouble() for column in (
                "Segment", "ControlPoints", "Corners", "RMSPercent", "RoundTripRMSPercent",
                "FoundPercent"))
        domains.append(table.GetValueByName(row, "Domain").ToString())
        print(f"{name}, segment {segment:2.0f}: {domains[-1]}, {points:.0f} control points, "
              f"{corners:.0f} corners, RMS {own:.3f} %, of the round trip {rms:.3f} %")
        assert rms <= 1.05 * own and rms < 1.5 and found == 100.0
    return domains


assert report_on("segments", reconstruction) == 3 * ["SegmentBox"]
print("triangles between segments:", OutputPort(reconstruction, 3).GetDataInformation().GetNumberOfCells())

# Automatic, the default, also looks for domains of cubes, and takes what is most accurate. What it
# has found on its way are further outputs.
automatic = TSplineReconstruction(Input=ball, Scalars=["POINTS", "Density"], NumberOfSegments=2,
                                  MaximumNumberOfControlPoints=1500, RMSTolerance=0.05)
automatic.UpdatePipeline()
patches, polycubes, fields, hexahedra, blocks = (OutputPort(automatic, i) for i in range(4, 9))
for file, output in (("patches.vtp", patches), ("domain.vtu", polycubes), ("fields.vti", fields),
                     ("hexmesh.vtu", hexahedra)):
    SaveData(file, proxy=output, DataMode="Binary")
    assert output.GetDataInformation().GetNumberOfCells() > 0
report_on("automatic", automatic, Surfaces=patches)

# A fit over the domain with other settings.
fit = TSplineFit(Input=fields, Polycube=polycubes, BlockMeshes=blocks, Scalars=["POINTS", "Density"],
                 MaximumNumberOfControlPoints=1500)
fit.UpdatePipeline()
rounds = fit.GetClientSideObject().GetOutputDataObject(1)
points, rms = (rounds.GetValueByName(rounds.GetNumberOfRows() - 1, name).ToDouble()
               for name in ("ControlPoints", "RMS"))
print(f"another fit over the cubes: {points:.0f} control points, RMS {rms:.3f} % of the segment's range")
assert points <= 1500 and rms < 1.0

# Given: over these cubes, or ones with corners that were dragged, whatever is more accurate.
given = TSplineReconstruction(Input=ball, Scalars=["POINTS", "Density"], NumberOfSegments=2,
                              Domain="Given", GivenDomain=OpenDataFile("domain.vtu"),
                              MaximumNumberOfControlPoints=2500, RMSTolerance=0.05)
given.UpdatePipeline()
domains = report_on("given", given, Surfaces=OutputPort(given, 4))
assert domains == ["SegmentBox", "LayeredCubes", "Mixed"]
