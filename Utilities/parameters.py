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
voxels of half the size, for its thin parts. The block mesh is coarse; nothing is taken from it.
"""
import pathlib
import sys

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
    solved.SetCellLength(8.0)
    solved.Update()
    fields = solved.GetOutput().GetFieldData()
    rows = zip(*(vtk_to_numpy(fields.GetArray(name)) for name in (
        "ParameterSegment", "ParameterRefined", "ParameterIterations", "ParameterDeviation",
        "ParameterLargestDeviation")))
    for segment, refined, iterations, deviations, largest in rows:
        print(f"| {run.replace('=', ' > ')}, {segment}{', refined' if refined else ''} | {', '.join(map(str, iterations))} "
              f"| {', '.join(f'{d:.4f}' for d in deviations)} "
              f"| {', '.join(f'{d:.3f}' for d in largest)} |", flush=True)


print("| volume, segment | iterations | deviation | at most |\n|---|---|---|---|")
for argument in sys.argv[2:]:
    print_row(pathlib.Path(sys.argv[1]), argument)
