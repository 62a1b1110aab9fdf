#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fills domains with hexahedra and prints the table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/domains.py --save FOLDER tooth=105 ...
    python3 Utilities/hexes.py FOLDER tooth=105:4 ...

Each row is a volume, its threshold and the wanted edge of a cell in space, on the domain that
domains.py saved in FOLDER; the mesh goes there too. The volume of the cells is compared with that of
the segment's surface. Seconds are those of the processor.
"""
import pathlib
import sys
import time

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import meshes


def volumes_of(cells):
    quality = vtkMeshQuality()
    quality.SetInputData(cells)
    quality.SetHexQualityMeasureToVolume()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def print_row(folder, run):
    name, edge = run.split(":")
    patches, _, polycube = meshes.read_domain(folder, name)
    start = time.process_time()
    remesh = meshes.remesh(patches, polycube, float(edge))
    seconds = time.process_time() - start
    mesh = remesh.GetOutputDataObject(1)
    quality = vtk_to_numpy(mesh.GetCellData().GetArray("ScaledJacobian"))
    volumes = volumes_of(mesh)
    surface = vtkMassProperties()
    surface.SetInputData(patches)
    low, high = numpy.percentile(volumes, [1, 99]) / volumes.mean()
    print(f"| {name.replace('=', ' > ')} | {edge} | {mesh.GetNumberOfCells():,} "
          f"| {remesh.GetInvertedBefore():,}, then {remesh.GetInvertedCells():,} "
          f"| {quality.min():.2f}, {quality.mean():.3f} | {low:.2f} to {high:.2f} "
          f"| {100 * (volumes.sum() / surface.GetVolume() - 1):+.1f} % | {seconds:.1f} |", flush=True)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(str(folder / f"{meshes.stem(name)}_hexes.vtu"))
    writer.SetDataModeToBinary()
    writer.Write()


print("| segment | edge | cells | inverted | scaled Jacobian: least, mean | cell volumes, 1 to 99 % of "
      "the mean | volume | CPU s |\n|---|---|---|---|---|---|---|---|")
for argument in sys.argv[2:]:
    print_row(pathlib.Path(sys.argv[1]), argument)
