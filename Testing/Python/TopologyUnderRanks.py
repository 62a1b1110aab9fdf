# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: makes segments whole and saves their surface."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

image = Wavelet(WholeExtent=[-12, 11, 3, 22, 0, 15])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="(RTData > 120) + (RTData > 170)")
topology = SegmentTopology(Input=labels, Labels=["POINTS", "Segment"])
boundary = SegmentBoundary(Input=topology, Labels=["POINTS", "Segment"], UseDensity=0)
boundary.UpdatePipeline()
surface = servermanager.Fetch(boundary)
numpy.savez(sys.argv[1], Points=vtk_to_numpy(surface.GetPoints().GetData()),
            Labels=vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels")),
            Range=numpy.array(topology.PointData["Segment"].GetRange()))

topology.Segments = [9]
topology.UpdatePipeline()  # one error, and no rank waits for another
