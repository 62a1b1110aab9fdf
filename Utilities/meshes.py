# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Domains that domains.py saved, and meshes of hexahedra in them."""
import math

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from trivariate import vtkHexRemesh


def read(reader, file):
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def stem(name):
    """What the files of a run are called: tooth=105,175+ -> tooth_105_175+."""
    return name.replace("=", "_").replace(",", "_")


def read_domain(folder, name):
    """Patches, borders and polycube."""
    return (read(vtkXMLPolyDataReader(), folder / f"{stem(name)}_patches.vtp"),
            read(vtkXMLPolyDataReader(), folder / f"{stem(name)}_borders.vtp"),
            read(vtkXMLUnstructuredGridReader(), folder / f"{stem(name)}_domain.vtu"))


def volumes_of(cells):
    """Of hexahedra."""
    quality = vtkMeshQuality()
    quality.SetInputData(cells)
    quality.SetHexQualityMeasureToVolume()
    quality.Update()
    return vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality"))


def describe(mesh, labelled):
    """Hexahedra of Hex Remesh in an image of segments: inverted cells, Jacobians, volume, distance."""
    field = mesh.GetFieldData()
    before, after = field.GetArray("InvertedCells").GetTuple(0)
    least, mean = field.GetArray("ScaledJacobian").GetTuple(0)
    voxel = math.prod(labelled.GetSpacing())
    voxels = numpy.isin(vtk_to_numpy(labelled.GetPointData().GetArray("Segment")),
                        vtk_to_numpy(mesh.GetCellData().GetArray("Segment"))).sum()
    farthest = {key: field.GetArray(name).GetComponent(0, 1) / voxel ** (1 / 3)
                for key, name in (("surface_to_cells", "PatchDistance"),
                                  ("cells_to_surface", "FaceDistance"))}
    return {"cells": mesh.GetNumberOfCells(),
            "inverted_cells": {"before": int(before), "after": int(after)},
            "min_scaled_jacobian": least, "mean_scaled_jacobian": mean,
            "volume_ratio": float(volumes_of(mesh).sum() / (voxels * voxel)),
            "distance_voxels": farthest}


def image_around(surface):
    """A grid of unit voxels: Hex Remesh takes its spacing and its points' arrays."""
    bounds = numpy.array(surface.GetBounds()).reshape(3, 2)
    image = vtkImageData()
    image.SetOrigin(*numpy.floor(bounds[:, 0]))
    image.SetDimensions(*(numpy.ceil(numpy.ptp(bounds, axis=1)).astype(int) + 2))
    return image


def remesh(patches, polycube, edge):
    """Hex Remesh, updated, with the wanted edge of a cell in space."""
    filter = vtkHexRemesh()
    filter.SetInputDataObject(0, image_around(patches))
    filter.SetInputDataObject(1, patches)
    filter.SetInputDataObject(2, polycube)
    filter.SetEdgeLength(edge)
    filter.Update()
    return filter
