#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Solves for the parameters of real segments on their voxels: a table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/domains.py --save FOLDER tooth=105+ ...
    python3 Utilities/parameters.py FOLDER tooth=105+ ...

Each row is a volume and its threshold, on the domain that domains.py saved in FOLDER: the iterations
of u, v and w to a relative residual of 1e-8, and how far each is from constant on its patches,
measured on the surface, in parts of its length: the root mean square and the most; refined: on
voxels of half the size, for its thin parts; folded: cells of eight voxels. Patches: how far they are
from the faces of the block mesh, with cells of two voxels, in parts of the cube root of the volume:
the root mean square and the most.
"""
import pathlib
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy

from trivariate import vtkFrameField, vtkSegmentTopology, vtkVolumeParameterization

import meshes
import segments


def print_row(folder, run):
    patches, _, polycube = meshes.read_domain(folder, run)
    whole = vtkSegmentTopology()
    whole.SetInputData(segments.labelled(run))
    frames = vtkFrameField()
    frames.SetInputConnection(whole.GetOutputPort())
    frames.SetInputDataObject(1, patches)
    solved = vtkVolumeParameterization()
    solved.SetInputConnection(frames.GetOutputPort())
    solved.SetInputDataObject(1, patches)
    solved.SetInputDataObject(2, polycube)
    solved.SetTolerance(1e-8)
    solved.Update()
    fields = solved.GetOutput().GetFieldData()
    rows = zip(*(vtk_to_numpy(fields.GetArray(name)) for name in (
        "ParameterSegment", "ParameterRefined", "ParameterIterations", "ParameterDeviation",
        "ParameterLargestDeviation", "ParameterFolds")))
    masked = numpy.count_nonzero(vtk_to_numpy(
        solved.GetOutput().GetPointData().GetArray("ParameterMask")))
    size = numpy.cbrt(masked * numpy.prod(solved.GetOutput().GetSpacing()))
    mean, most = fields.GetArray("PatchDistance").GetTuple2(0)
    for segment, refined, iterations, deviations, largest, (folded, cells) in rows:
        print(f"| {run.replace('=', ' > ')}, {segment}{', refined' if refined else ''} "
              f"| {', '.join(map(str, iterations))} | {', '.join(f'{d:.4f}' for d in deviations)} "
              f"| {', '.join(f'{d:.3f}' for d in largest)} | {folded:,} of {cells:,} "
              f"| {mean / size:.4f}, {most / size:.3f} |", flush=True)


print("| volume, segment | iterations | deviation | at most | folded | patches |\n|---|---|---|---|---|---|")
for argument in sys.argv[2:]:
    print_row(pathlib.Path(sys.argv[1]), argument)
