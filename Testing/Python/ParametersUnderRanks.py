# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: parameterizes a ball and saves what reaches the client."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

image = Wavelet(WholeExtent=[-9, 9, -8, 8, -8, 8])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="if(mag(coords) < 6.7, 1, 0)")
surface = SegmentBoundary(Input=labels, Labels=["POINTS", "Segment"], UseDensity=0)
domain = PolycubeDomain(Input=surface)
frames = FrameField(Input=labels, Patches=OutputPort(domain, 0), Labels=["POINTS", "Segment"])
parameters = VolumeParameterization(Input=frames, Patches=OutputPort(domain, 0),
                                    Polycube=OutputPort(domain, 1), Labels=["POINTS", "Segment"])
parameters.UpdatePipeline()
inside = Threshold(Input=parameters, Scalars=["POINTS", "ParameterMask"], LowerThreshold=1,
                   UpperThreshold=1)
# Vertices bring the cells of all pieces together, with the means of their corners.
cells = servermanager.Fetch(CellCenters(Input=PointDatatoCellData(Input=inside), VertexCells=1))
places = numpy.hstack([vtk_to_numpy(cells.GetPoints().GetData()),
                       vtk_to_numpy(cells.GetPointData().GetArray("Parameter"))])
polycube = servermanager.Fetch(PassArrays(Input=OutputPort(parameters, 1),
                                          CellDataArrays=["BlockLengths"]))
numpy.savez(sys.argv[1], Places=numpy.unique(numpy.round(places, 9), axis=0),
            Lengths=vtk_to_numpy(polycube.GetCellData().GetArray("BlockLengths")))

parameters.Input = labels
parameters.UpdatePipeline()  # one error, and no rank waits for another
