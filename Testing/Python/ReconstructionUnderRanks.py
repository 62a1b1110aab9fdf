# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: reconstructs a volume and saves the T-spline."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

ball = Calculator(Input=Wavelet(WholeExtent=[-10, 9, -9, 9, -8, 9]), ResultArrayName="Density",
                  Function="if(mag(coords) < 6.2, 90 + RTData / 20, coordsZ * coordsX / 9)")
labels = Calculator(Input=ball, ResultArrayName="Material", Function="if(mag(coords) < 6.2, 1, 0)")
saved = {}
for domain in ("Box", "Automatic"):
    reconstruction = TSplineReconstruction(
        Input=labels, Scalars=["POINTS", "Density"], Labels=["POINTS", "Material"], Domain=domain,
        MaximumNumberOfControlPoints=1500)
    reconstruction.UpdatePipeline()
    grid = servermanager.Fetch(reconstruction)
    saved[domain + "Points"] = vtk_to_numpy(grid.GetPoints().GetData())
    for name in ("Density", "KnotsU", "Weight", "Segment", "Block"):
        saved[domain + name] = vtk_to_numpy(grid.GetPointData().GetArray(name))
for port, name in ((4, "Patches"), (5, "Cubes"), (7, "Hexahedra")):
    grid = servermanager.Fetch(OutputPort(reconstruction, port))
    saved[name] = vtk_to_numpy(grid.GetPoints().GetData())
numpy.savez(sys.argv[1], **saved)

reconstruction.FurtherAttributes = ["absent"]
reconstruction.UpdatePipeline()  # one error, and no rank waits for another
