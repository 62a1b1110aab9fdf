#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits thresholded volumes over their domains and prints the table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/fits.py [--identity] FOLDER tooth=105+:4:2000,5000 fuel=15/cube:2:280,800 ...

Each argument is a volume, its thresholds as in domains.py (i of them are exceeded in segment i; with
+ cavities of what exceeds the first are filled), /cube for a domain without layers, the wanted edge
of a hexahedron in space and the numbers of control points. The volume "ball" is a phantom. What has
parameters is kept in FOLDER, made from domain, frames and parameterization if it is not there.

All voxels of the segments that exceed the first threshold and have parameters count, cavities do not.
RMS is that of the round trip: the spline at the places of the voxels, in parts of the range of the
whole volume, times 100; "ramp" and "inside" are up to 1.5 voxels from the surface and beyond.
With --identity beside it: T-Spline Fit of the same voxels in the image's own directions, which stores
one number a control point, at as many control points, and at as many numbers. Seconds are those of the
processor.
"""
import argparse
import os
import pathlib
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPartitionedDataSetCollection
from vtkmodules.vtkImagingGeneral import vtkImageEuclideanDistance
from vtkmodules.vtkIOXML import (vtkXMLImageDataReader, vtkXMLImageDataWriter,
                                 vtkXMLStructuredGridReader, vtkXMLStructuredGridWriter,
                                 vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter)

from trivariate import (vtkFrameField, vtkPolycubeDomain, vtkSegmentBoundary, vtkSegmentTopology,
                        vtkTSplineFit, vtkTSplineSource, vtkVolumeParameterization)

RAMP = 1.5
data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR",
                                   pathlib.Path(__file__).resolve().parents[2] / "shared" / "data"))


def read(reader, file):
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutputDataObject(0)


def write(writer, output, file):
    writer.SetInputDataObject(output)
    writer.SetFileName(str(file))
    writer.SetDataModeToBinary()
    writer.Write()


def set_array(image, name, values):
    array = numpy_to_vtk(values, deep=1)
    array.SetName(name)
    image.GetPointData().AddArray(array)


def array_of(image, name):
    return vtk_to_numpy(image.GetPointData().GetArray(name))


def volume_of(name):
    """The image with its density as the active scalars, named Density."""
    if name == "ball":
        image = vtkImageData()
        image.SetDimensions(36, 36, 36)
        z, y, x = numpy.meshgrid(*[numpy.arange(36) - 17.5] * 3, indexing="ij")
        density = (numpy.clip(15.5 - numpy.sqrt(x * x + y * y + z * z), 0, 1)
                   * (0.8 + 0.1 * numpy.cos(x / 6) * numpy.cos(y / 7))).ravel()
    else:
        image = read(vtkXMLImageDataReader(), data / f"{name}.vti")
        density = vtk_to_numpy(image.GetPointData().GetArray(0)).astype(float)
    set_array(image, "Density", density)
    image.GetPointData().SetActiveScalars("Density")
    return image


def parameterize(volume, edge):
    """Image, polycube and block meshes."""
    name, thresholds = volume.removesuffix("/cube").split("=")
    image = volume_of(name)
    density = array_of(image, "Density")
    values = [float(t) for t in thresholds.rstrip("+").split(",")]
    inside = density > values[0]
    topology = vtkSegmentTopology()
    if thresholds.endswith("+"):
        set_array(image, "Segment", inside.astype(numpy.int32))
        topology.SetInputData(image)
        topology.SetLargestCavity(2**31 - 1)
        topology.Update()
        inside = array_of(topology.GetOutput(), "Segment") > 0
    labels = inside * (1 + sum((density > value).astype(int) for value in values[1:]))
    set_array(image, "Segment", labels.astype(numpy.int32))
    topology.SetInputData(image)
    topology.Modified()
    boundary, domain = vtkSegmentBoundary(), vtkPolycubeDomain()
    boundary.UseDensityOff()
    boundary.SetInputConnection(topology.GetOutputPort())
    domain.SetInputConnection(boundary.GetOutputPort())
    domain.SetLayered(not volume.endswith("/cube"))
    frames, parameters = vtkFrameField(), vtkVolumeParameterization()
    frames.SetInputConnection(0, topology.GetOutputPort())
    frames.SetInputConnection(1, domain.GetOutputPort(0))
    parameters.SetInputConnection(0, frames.GetOutputPort(0))
    parameters.SetInputConnection(1, domain.GetOutputPort(0))
    parameters.SetInputConnection(2, domain.GetOutputPort(1))
    parameters.SetCellLength(float(edge))
    parameters.Update()
    return [parameters.GetOutputDataObject(port) for port in range(3)]


def load(folder, volume, edge):
    stem = f"{volume.replace('=', '_').replace(',', '_').replace('/', '_')}_{edge}"
    files = [folder / (stem + suffix) for suffix in (".vti", ".vtu")]

    def block(i):
        return folder / f"{stem}_block{i}.vts"
    if not files[1].exists():
        image, polycube, meshes = parameterize(volume, edge)
        for i in range(meshes.GetNumberOfPartitionedDataSets()):
            write(vtkXMLStructuredGridWriter(), meshes.GetPartition(i, 0), block(i))
        write(vtkXMLImageDataWriter(), image, files[0])
        write(vtkXMLUnstructuredGridWriter(), polycube, files[1])
    image, polycube = (read(reader, file) for reader, file in zip(
        (vtkXMLImageDataReader(), vtkXMLUnstructuredGridReader()), files))
    meshes = vtkPartitionedDataSetCollection()
    for i in range(polycube.GetNumberOfCells()):
        meshes.SetPartition(i, 0, read(vtkXMLStructuredGridReader(), block(i)))
    return image, polycube, meshes


def depth_of(image):
    """Distance of each voxel from the nearest one outside of the segments, in voxels."""
    distance = vtkImageEuclideanDistance()
    mask = vtkImageData()
    mask.CopyStructure(image)
    inside = array_of(image, "Segment") > 0
    set_array(mask, "Inside", inside.astype(numpy.uint8))
    mask.GetPointData().SetActiveScalars("Inside")
    distance.SetInputData(mask)
    distance.ConsiderAnisotropyOff()
    distance.SetMaximumDistance(1e6)
    distance.Update()
    return numpy.sqrt(vtk_to_numpy(distance.GetOutput().GetPointData().GetScalars()))


def fit(image, count, domain=None):
    """The T-spline grid, the field data of its table and seconds."""
    spline = vtkTSplineFit()
    spline.SetInputData(0, image)
    spline.SetMaskArray("Counts")
    spline.SetMaximumNumberOfControlPoints(count)
    for port, output in enumerate(domain or []):
        spline.SetInputDataObject(1 + port, output)
    start = time.process_time()
    spline.Update()
    return spline.GetOutput(), spline.GetOutputDataObject(1), time.process_time() - start


def last_of(table, column):
    return vtk_to_numpy(table.GetRowData().GetArray(column))[-1]


def field_of(table, name):
    return vtk_to_numpy(table.GetFieldData().GetArray(name))[0]


def errors_of(grid, image):
    """Squared errors of the round trip at all voxels, and whether they were found."""
    source = vtkTSplineSource()
    source.SetInputData(0, grid)
    source.SetOutputType(vtkTSplineSource.IMAGE)
    source.SetInputData(1, image)
    source.Update()
    result = source.GetOutputDataObject(0)
    density = array_of(image, "Density")
    error = (array_of(result, "Density") - density) / (density.max() - density.min())
    return error**2, array_of(result, "vtkValidPointMask") > 0


def print_rows(folder, argument, with_identity):
    volume, edge, counts = argument.split(":")
    image, *domain = load(folder, volume, edge)
    image.GetPointData().SetActiveScalars("Density")
    density = array_of(image, "Density")
    least = float(volume.removesuffix("/cube").split("=")[1].rstrip("+").split(",")[0])
    counted = (density > least) & (array_of(image, "ParameterMask") > 0)
    set_array(image, "Counts", counted.astype(numpy.uint8))
    ramp = depth_of(image) <= RAMP
    scale = (density[counted].max() - density[counted].min()) / (density.max() - density.min())

    def rms(squares, where):
        return 100 * numpy.sqrt(squares[where].mean()) if where.any() else numpy.nan
    for count in map(int, counts.split(",")):
        grid, table, seconds = fit(image, count, domain)
        if grid.GetNumberOfPoints() == 0:
            continue
        squares, found = errors_of(grid, image)
        numbers = int(field_of(table, "NumbersStored"))
        distance, cells = field_of(table, "ShapeDistance"), field_of(table, "ShapeCells")
        identity = ["-", "-"]
        if with_identity:
            identity = [f"{scale * last_of(fit(image, n)[1], 'RMS'):.2f}" for n in (count, numbers)]
        print(f"| {volume.replace('=', ' > ')} | {last_of(table, 'ControlPoints'):,} "
              f"| {int(field_of(table, 'ShapeControlPoints')):,} | {numbers:,} "
              f"| {scale * last_of(table, 'RMS'):.2f} | {rms(squares, counted & found):.2f} "
              f"| {100 * found[counted].mean():.2f} % "
              f"| {rms(squares, counted & found & ramp):.2f}, "
              f"{rms(squares, counted & found & ~ramp):.2f} "
              f"| {distance[0]:.2f}, {distance[1]:.1f} "
              f"| {cells[1]} / {cells[0] - cells[1] - cells[2]} / {cells[0]} "
              f"| {identity[0]} | {identity[1]} | {seconds:.0f} |", flush=True)


parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
parser.add_argument("--identity", action="store_true", help="the baselines, too")
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("runs", nargs="+", metavar="VOLUME=THRESHOLDS:EDGE:COUNTS")
arguments = parser.parse_args()
print("| segment | control points | shape | numbers stored | RMS | RMS, found | found | ramp, inside "
      "| distance of the shape: RMS, largest | its cells: folded / not proven / all "
      "| identity, as many points | identity, as many numbers | CPU s |")
print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
for run in arguments.runs:
    print_rows(arguments.folder, run, arguments.identity)
