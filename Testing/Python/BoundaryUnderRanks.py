# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: makes surfaces and saves what reaches the client."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

image = Wavelet(WholeExtent=[-12, 11, 3, 22, 0, 15])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="(RTData > 120) + (RTData > 170)")
boundary = SegmentBoundary(Input=labels, Labels=["POINTS", "Segment"],
                           Density=["POINTS", "RTData"])
boundary.UpdatePipeline()
surface = servermanager.Fetch(boundary)
numpy.savez(sys.argv[1], Points=vtk_to_numpy(surface.GetPoints().GetData()),
            Triangles=vtk_to_numpy(surface.GetPolys().GetConnectivityArray()),
            **{name: vtk_to_numpy(data.GetArray(name))
               for data, names in ((surface.GetCellData(), ["BoundaryLabels"]),
                                   (surface.GetPointData(), ["Normals", "Junction"]))
               for name in names})

boundary.Segments = [9]
boundary.UpdatePipeline()  # one error, and no rank waits for another
