# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: makes frames and saves what reaches the client."""
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

image = Wavelet(WholeExtent=[-12, 12, -10, 10, -10, 10])
labels = Calculator(Input=image, ResultArrayName="Segment",
                    Function="if(mag(coords) < 5.2, 2, if(mag(coords) < 9.2, 1, 0))")
surface = SegmentBoundary(Input=labels, Labels=["POINTS", "Segment"], UseDensity=0)
domain = PolycubeDomain(Input=surface)
arrays = {}
for name, field in (
        ("Aligned", FrameField(Input=labels, Patches=OutputPort(domain, 0),
                               Labels=["POINTS", "Segment"])),
        ("Unaligned", FrameField(Input=labels, Labels=["POINTS", "Segment"]))):
    field.UpdatePipeline()
    graph = servermanager.Fetch(PassArrays(Input=OutputPort(field, 1), CellDataArrays=["Segment"]))
    arrays[name + "Graph"] = (vtk_to_numpy(graph.GetPoints().GetData())
                              if graph.GetNumberOfPoints() else numpy.zeros((0, 3)))
    # Lines bring the frames of all pieces together; what pieces share is there more than once.
    glyphs = servermanager.Fetch(FrameGlyphs(Input=field, Stride=1))
    ends = vtk_to_numpy(glyphs.GetPoints().GetData()).reshape(-1, 6)
    arrays[name + "Frames"] = numpy.unique(numpy.round(ends, 5), axis=0)
numpy.savez(sys.argv[1], **arrays)

field.Segments = [9]
field.UpdatePipeline()  # one error, and no rank waits for another
