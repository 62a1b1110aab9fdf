# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: parameterizes a ball, fills it with hexahedra, also on the
blocks that the parameters came with, and saves what reaches the client."""
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
results = {"Places": numpy.unique(numpy.round(places, 9), axis=0),
           "Lengths": vtk_to_numpy(polycube.GetCellData().GetArray("BlockLengths"))}
for name, blocks in (("Hexes", None), ("Resampled", OutputPort(parameters, 2))):
    hexes = HexRemesh(Input=parameters, Patches=OutputPort(domain, 0),
                      Polycube=OutputPort(parameters, 1), EdgeLength=1.5)
    if blocks:
        hexes.BlockMeshes = blocks
    mesh = servermanager.Fetch(PassArrays(Input=OutputPort(hexes, 1), PointDataArrays=["RTData"]))
    results[f"{name}Points"] = vtk_to_numpy(mesh.GetPoints().GetData())
    results[f"{name}Density"] = vtk_to_numpy(mesh.GetPointData().GetArray("RTData"))
    results[f"{name}Cells"] = vtk_to_numpy(mesh.GetCells().GetConnectivityArray())
numpy.savez(sys.argv[1], **results)

parameters.Input = labels
parameters.UpdatePipeline()  # one error, and no rank waits for another
