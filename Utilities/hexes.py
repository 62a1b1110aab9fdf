#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fills domains with hexahedra and prints the table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/domains.py --save FOLDER tooth=105 ...
    python3 Utilities/hexes.py FOLDER tooth=105:4 ...

Each row is a volume, its threshold and the wanted edge of a cell in space, on the domain that
domains.py saved in FOLDER; the mesh goes there too. Where there are several segments each has a row
below. The volume of the cells is compared with that of
the segments' surface. Distances, in voxels, are the farthest from points of the surface to the faces
of cells, with the 99th percentile, and from points of those faces (4 x 4 of each) to the surface.
Seconds are those of the processor.
"""
import pathlib
import sys
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import (vtkAppendPolyData, vtkMassProperties, vtkThreshold,
                                       vtkTriangleFilter)
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersModeling import (vtkHausdorffDistancePointSetFilter,
                                           vtkLinearSubdivisionFilter)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import meshes


def part_of(data, segment):
    """The cells of one segment."""
    part = vtkThreshold()
    part.SetInputData(data)
    part.SetInputArrayToProcess(0, 0, 0, 1, "Segment")
    part.SetLowerThreshold(segment)
    part.SetUpperThreshold(segment)
    part.Update()
    return part.GetOutput()


def surface_of(grid):
    surface = vtkDataSetSurfaceFilter()
    surface.SetInputData(grid)
    surface.Update()
    return surface.GetOutput()


def faces_of(cells):
    """The faces of each segment's cells that are not between two of them, each cut into triangles."""
    segments = numpy.unique(vtk_to_numpy(cells.GetCellData().GetArray("Segment")))
    faces = vtkAppendPolyData()
    for segment in segments:
        triangles = vtkTriangleFilter()
        triangles.SetInputData(surface_of(part_of(cells, segment)))
        finer = vtkLinearSubdivisionFilter()
        finer.SetInputConnection(triangles.GetOutputPort())
        finer.SetNumberOfSubdivisions(2)
        finer.Update()
        faces.AddInputData(finer.GetOutput())
    faces.Update()
    return faces.GetOutput()


def distances(patches, cells):
    """From each point of the patches to the faces of cells, and back."""
    farthest = vtkHausdorffDistancePointSetFilter()
    farthest.SetInputData(0, patches)
    farthest.SetInputData(1, faces_of(cells))
    farthest.SetTargetDistanceMethodToPointToCell()
    farthest.Update()
    return [vtk_to_numpy(farthest.GetOutputDataObject(port).GetPointData().GetArray("Distance"))
            for port in (0, 1)]


def volume_inside(patches):
    """Of all segments: a surface that two of them share is there from both sides, which cancels."""
    surface = vtkMassProperties()
    surface.SetInputData(patches)
    return surface.GetVolume()


def print_row(name, edge, inverted, patches, mesh, seconds):
    quality = vtk_to_numpy(mesh.GetCellData().GetArray("ScaledJacobian"))
    volumes = meshes.volumes_of(mesh)
    out, back = distances(patches, mesh)
    low, high = numpy.percentile(volumes, [1, 99]) / volumes.mean()
    print(f"| {name} | {edge} | {mesh.GetNumberOfCells():,} | {inverted} "
          f"| {quality.min():.2f}, {quality.mean():.3f} | {low:.2f} to {high:.2f} "
          f"| {100 * (volumes.sum() / volume_inside(patches) - 1):+.2f} % "
          f"| {out.max():.2f} ({numpy.percentile(out, 99):.2f}), {back.max():.2f} | {seconds} |",
          flush=True)


def print_rows(folder, run):
    """One for all, and where there are several one for each segment."""
    name, edge = run.split(":")
    patches, _, polycube = meshes.read_domain(folder, name)
    start = time.process_time()
    remesh = meshes.remesh(patches, polycube, float(edge))
    seconds = time.process_time() - start
    mesh = remesh.GetOutputDataObject(1)
    print_row(name.replace("=", " > "), edge,
              f"{remesh.GetInvertedBefore():,}, then {remesh.GetInvertedCells():,}", patches, mesh,
              f"{seconds:.1f}")
    segments = numpy.unique(vtk_to_numpy(mesh.GetCellData().GetArray("Segment")))
    for segment in segments if len(segments) > 1 else []:
        print_row(f"its segment {segment}", "", "", surface_of(part_of(patches, segment)),
                  part_of(mesh, segment), "")
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(str(folder / f"{meshes.stem(name)}_hexes.vtu"))
    writer.SetDataModeToBinary()
    writer.Write()


print("| segment | edge | cells | inverted | scaled Jacobian: least, mean | cell volumes, 1 to 99 % of "
      "the mean | volume | distance: surface to cells (99 %), back | CPU s |\n"
      "|---|---|---|---|---|---|---|---|---|")
for argument in sys.argv[2:]:
    print_rows(pathlib.Path(sys.argv[1]), argument)
