# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch on any number of ranks: makes domains and saves what reaches the client."""
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
domain.UpdatePipeline()


def save(source, sphere):
    arrays = {}
    for port in range(3):
        data = servermanager.Fetch(PassArrays(Input=OutputPort(source, port), CellDataArrays=[
            "Patch", "PatchAxis", "PatchSide", "Segment", "Block", "BorderPatches"],
            PointDataArrays=["CornerId", "DomainCoordinates"]))
        arrays[f"{sphere}Points{port}"] = vtk_to_numpy(data.GetPoints().GetData())
        for attributes in (data.GetCellData(), data.GetPointData()):
            for i in range(attributes.GetNumberOfArrays()):
                name = f"{sphere}{attributes.GetArrayName(i)}{port}"
                arrays[name] = vtk_to_numpy(attributes.GetArray(i))
    return arrays


# A surface of which every rank has a piece, joined where the pieces meet.
sphere = Sphere(ThetaResolution=24, PhiResolution=24)
spherical = PolycubeDomain(Input=sphere)
spherical.UpdatePipeline()
arrays = save(domain, "")
arrays["SphereCorners"] = save(spherical, "")["Points1"]

# Corners that every rank has.
shared = ProgrammableSource(OutputDataSetType="vtkPolyData", Script="""
import vtk
points = vtk.vtkPoints()
for i in range(8):
    points.InsertNextPoint(*(3.6 if i >> a & 1 else -3.2 for a in range(3)))
self.GetPolyDataOutput().SetPoints(points)
""")

# Corners of which every rank has some, in order.
spread = ProgrammableSource(OutputDataSetType="vtkPolyData", Script="""
import vtk
control = vtk.vtkMultiProcessController.GetGlobalController()
ranks, rank = control.GetNumberOfProcesses(), control.GetLocalProcessId()
points = vtk.vtkPoints()
for i in range(8):
    if i * ranks // 8 == rank:
        points.InsertNextPoint(*(3.6 if i >> a & 1 else -3.2 for a in range(3)))
self.GetPolyDataOutput().SetPoints(points)
""")
for name, corners in (("Shared", shared), ("Spread", spread)):
    picked = PolycubeDomain(Input=surface, Corners=corners, Mode="Manual", Segments=[2],
                            NumberOfCubes=[1, 1, 1])
    picked.UpdatePipeline()
    data = servermanager.Fetch(
        PassArrays(Input=OutputPort(picked, 1), PointDataArrays=["SnapDistance"]))
    arrays[f"{name}Corners"] = vtk_to_numpy(data.GetPoints().GetData())
    arrays[f"{name}Snaps"] = vtk_to_numpy(data.GetPointData().GetArray("SnapDistance"))
numpy.savez(sys.argv[1], **arrays)

# Without an update of all ranks, each makes all from the corners that it has: those are too few.
picked = PolycubeDomain(Input=surface, Corners=spread, Mode="Manual", Segments=[2],
                        NumberOfCubes=[1, 1, 1])
servermanager.Fetch(PassArrays(Input=OutputPort(picked, 1), PointDataArrays=["SnapDistance"]))

domain.Segments = [9]
domain.UpdatePipeline()  # one error, and no rank waits for another
