#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Fits thresholded volumes over their domains and prints the table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/fits.py [--baselines] [--share .5] FOLDER tooth=105+:4:2000,5000 \\
      fuel=15/cube:2:280,800 ...

Each argument is a volume, its thresholds as in domains.py (i of them are exceeded in segment i; with
+ cavities of what exceeds the first are filled), /cube for a domain without layers, the wanted edge
of a hexahedron in space and the numbers of control points. The volumes "ball" and "bar" are phantoms;
the bar is bent by 150 degrees. What has parameters is kept in FOLDER, made from domain, frames and
parameterization if it is not there; the splines go there too.

All voxels of the segments that exceed the first threshold and have parameters count, cavities do not.
RMS is that of the round trip, the spline at the places of the voxels or at the points of it nearest to
them, in parts of the range of the whole volume, times 100; "inside" counts only voxels that it passes
through, whose share and that of further ones up to half a voxel away stand beside it; "ramp, core" of
these are up to 1.5 voxels from the surface and beyond.
With --baselines beside it, by T-Spline Fit in the image's own directions, which stores one number a
control point: the same voxels at as many control points, at as many numbers, and at as many control
points less ten after a linear spline of their depth, with ten coefficients, has been taken off; and
the whole box, its error at the same voxels. Seconds are those of the processor.
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
                        vtkTSplineFit, vtkTSplineSource, vtkTSplineWriter, vtkVolumeParameterization)

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


def write_spline(grid, file):
    writer = vtkTSplineWriter()
    writer.SetInputDataObject(grid)
    writer.SetFileName(str(file))
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
    elif name == "bar":
        image = vtkImageData()
        image.SetDimensions(96, 60, 28)
        z, y, x = numpy.meshgrid(numpy.arange(28) - 13.5, numpy.arange(60) - 3.5,
                                 numpy.arange(96) - 47.5, indexing="ij")
        angle = numpy.arctan2(x, y + 6)
        outside = numpy.maximum.reduce([34 * (abs(angle) - numpy.radians(75)), abs(z) - 10,
                                        abs(numpy.hypot(x, y + 6) - 34) - 10])
        density = (numpy.clip(0.5 - outside, 0, 1)
                   * (0.8 + 0.1 * numpy.cos(34 * angle / 9) * numpy.cos(z / 6))).ravel()
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
    if thresholds.endswith("+"):
        set_array(image, "Segment", inside.astype(numpy.int32))
        filled = vtkSegmentTopology()
        filled.SetInputData(image)
        filled.SetLargestCavity(2**31 - 1)
        filled.Update()
        inside = array_of(filled.GetOutput(), "Segment") > 0
    labels = inside * (1 + sum((density > value).astype(int) for value in values[1:]))
    set_array(image, "Segment", labels.astype(numpy.int32))
    topology, boundary, domain = vtkSegmentTopology(), vtkSegmentBoundary(), vtkPolycubeDomain()
    topology.SetInputData(image)
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


def stem_of(volume, edge):
    return f"{volume.replace('=', '_').replace(',', '_').replace('/', '_')}_{edge}"


def load(folder, volume, edge):
    stem = stem_of(volume, edge)
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


def fit(image, count, domain=None, share=0.25, mask="Counts", array="Density"):
    """The T-spline grid, the field data of its table and seconds."""
    spline = vtkTSplineFit()
    spline.SetInputData(0, image)
    spline.SetInputArrayToProcess(0, 0, 0, 0, array)
    spline.SetMaskArray(mask)
    spline.SetMaximumNumberOfControlPoints(count)
    spline.SetShapeShare(share)
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


def without_depth(density, depth, counted):
    """What the best linear spline of the depth leaves of the density; ten knots at its quantiles."""
    knots = numpy.unique(numpy.quantile(depth[counted], numpy.linspace(0, 1, 10)))
    basis = numpy.stack([numpy.interp(depth, knots, hat) for hat in numpy.eye(len(knots))], axis=1)
    solution = numpy.linalg.lstsq(basis[counted], density[counted], rcond=None)[0]
    return density - basis @ solution


def baselines(image, counted, depth, count, numbers):
    """RMS of the same voxels in the image's own directions, as the columns have them."""
    density = array_of(image, "Density")
    whole = density.max() - density.min()

    def masked(array, n):
        values = array_of(image, array)[counted]
        return (values.max() - values.min()) / whole * last_of(fit(image, n, array=array)[1], "RMS")
    set_array(image, "Rest", without_depth(density, depth, counted))
    box, _, _ = fit(image, count, mask="None")
    squares, _ = errors_of(box, image)
    return [masked("Density", count), masked("Density", numbers), masked("Rest", count - 10),
            100 * numpy.sqrt(squares[counted].mean())]


def print_rows(folder, argument, share, with_baselines):
    volume, edge, counts = argument.split(":")
    image, *domain = load(folder, volume, edge)
    image.GetPointData().SetActiveScalars("Density")
    density = array_of(image, "Density")
    least = float(volume.removesuffix("/cube").split("=")[1].rstrip("+").split(",")[0])
    counted = (density > least) & (array_of(image, "ParameterMask") > 0)
    set_array(image, "Counts", counted.astype(numpy.uint8))
    depth = depth_of(image)
    ramp = depth <= RAMP
    scale = (density[counted].max() - density[counted].min()) / (density.max() - density.min())

    def rms(squares, where):
        return 100 * numpy.sqrt(squares[where].mean()) if where.any() else numpy.nan
    for count in map(int, counts.split(",")):
        grid, table, seconds = fit(image, count, domain, share)
        if grid.GetNumberOfPoints() == 0:
            continue
        write_spline(grid, folder / f"{stem_of(volume, edge)}_{count}.tspline")
        squares, found = errors_of(grid, image)
        numbers = int(field_of(table, "NumbersFitted"))
        distance, cells = field_of(table, "ShapeDistance"), field_of(table, "ShapeCells")
        inside, of = field_of(table, "VoxelsInside")
        near = int(field_of(table, "VoxelsNear"))
        others = ["-"] * 4
        if with_baselines:
            others = [f"{value:.2f}" for value in baselines(image, counted, depth, count, numbers)]
        print(f"| {volume.replace('=', ' > ')} | {last_of(table, 'ControlPoints'):,} "
              f"| {int(field_of(table, 'ShapeControlPoints')):,} | {numbers:,} "
              f"| {scale * last_of(table, 'RMS'):.2f} | {rms(squares, counted & found):.2f} "
              f"| {100 * inside / of:.2f} + {100 * near / of:.2f} % "
              f"| {rms(squares, counted & found & ramp):.2f}, "
              f"{rms(squares, counted & found & ~ramp):.2f} "
              f"| {distance[0]:.2f}, {distance[1]:.1f} "
              f"| {cells[1]} / {cells[0] - cells[1] - cells[2]} / {cells[0]} "
              f"| {' | '.join(others)} | {seconds:.0f} |", flush=True)


parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
parser.add_argument("--baselines", action="store_true", help="fits in the image's own directions, too")
parser.add_argument("--share", type=float, default=0.25, help="Shape Share; default 0.25")
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("runs", nargs="+", metavar="VOLUME=THRESHOLDS:EDGE:COUNTS")
arguments = parser.parse_args()
print("| segment | control points | shape | numbers fitted | RMS | RMS, inside | inside, near | ramp, "
      "core | distance of the shape: RMS, largest | its cells: folded / not proven / all | identity, "
      "as many points | as many numbers | with depth | whole box | CPU s |")
print("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
for run in arguments.runs:
    print_rows(arguments.folder, run, arguments.share, arguments.baselines)
