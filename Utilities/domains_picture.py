#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Draws domains side by side: patches by axis, u red, v green, w blue, light at the high end.

    . BUILD/environment.sh
    python3 Utilities/domains.py --save FOLDER tooth=105+ ...
    Utilities/with-display.sh python3 Utilities/domains_picture.py FOLDER FILE.png [RUN ...]

Without runs it draws those of Documentation/domains_volumes.png.
"""
import pathlib
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkTubeFilter

import meshes
from views import Views, draw

COLORS = numpy.array([[[190, 60, 55], [225, 130, 105]], [[50, 115, 55], [125, 175, 110]],
                      [[50, 85, 150], [120, 155, 215]]], dtype=numpy.uint8)
SIZE = 304
# From where, and what is up.
VIEWS = {"tooth=105+": ((0.6, -1, 0.3), (0.15, 0, 1)), "ankle_128=40": ((1, -1, -0.5), (0, 0, -1)),
         "fuel=15": ((0.8, -1, 0.5), (0, 0, 1)), "hydrogen_atom=20": ((1, -1, 0.6), (0, 0, 1)),
         "nucleon=150": ((1, -1, 0.6), (0, 0, 1)), "walnut=5000": ((1, -1, 0.6), (0, 0, 1))}


def draw_domain(renderer, folder, run):
    patches, borders, _ = meshes.read_domain(folder, run)
    axis, side = (vtk_to_numpy(patches.GetCellData().GetArray(name))
                  for name in ("PatchAxis", "PatchSide"))
    draw(renderer, patches, (1.0, 1.0, 1.0))
    mapper = renderer.GetActors().GetLastActor().GetMapper()
    patches.GetCellData().SetScalars(numpy_to_vtk(COLORS[axis, side], deep=1))
    mapper.SetScalarModeToUseCellData()
    mapper.ScalarVisibilityOn()
    tubes = vtkTubeFilter()
    tubes.SetInputData(borders)
    tubes.SetRadius(0.004 * patches.GetLength())
    tubes.Update()
    draw(renderer, tubes.GetOutput(), (0.0, 0.0, 0.0))
    direction, up = VIEWS.get(run, VIEWS["nucleon=150"])
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(patches.GetCenter())
    camera.SetPosition(*(numpy.array(patches.GetCenter()) + direction))
    camera.SetViewUp(*up)
    renderer.ResetCamera()
    camera.Zoom(1.1)


runs = sys.argv[3:] or list(VIEWS)
views = Views(1, len(runs), (SIZE, SIZE))
for place, name in zip(views.renderers[0], runs):
    draw_domain(place, pathlib.Path(sys.argv[1]), name)
views.save(sys.argv[2])
