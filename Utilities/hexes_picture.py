# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Hexahedra that hexes.py saved, from outside and cut open, by their scaled Jacobian:
Documentation/hexes_tooth.png.

    . BUILD/environment.sh
    Utilities/with-display.sh pvpython Utilities/hexes_picture.py FOLDER/tooth_105+_hexes.vtu FILE.png
"""
import sys

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

import meshes
from views import Views, draw, look, write

TOWARDS, UP = (-0.35, -1.0, 0.25), (0, 0, 1)


def cells_behind(mesh, middle):
    """Whole cells, so that their shapes are seen."""
    plane = vtkPlane()
    plane.SetOrigin(*middle)
    plane.SetNormal(0.0, -1.0, 0.0)
    behind = vtkExtractGeometry()
    behind.SetInputData(mesh)
    behind.SetImplicitFunction(plane)
    behind.Update()
    return behind.GetOutput()


def jacobian_colors():
    colors = vtkColorTransferFunction()
    colors.AddRGBPoint(0.0, 0.23, 0.30, 0.75)
    colors.AddRGBPoint(0.5, 0.87, 0.87, 0.87)
    colors.AddRGBPoint(1.0, 0.71, 0.02, 0.15)
    return colors


def draw_cells(renderer, mesh, colors):
    surface = vtkGeometryFilter()
    surface.SetInputData(mesh)
    surface.Update()
    actor = draw(renderer, surface.GetOutput(), (1, 1, 1))
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUseCellFieldData()
    mapper.SelectColorArray("ScaledJacobian")
    mapper.SetLookupTable(colors)
    mapper.UseLookupTableScalarRangeOn()
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.15, 0.15, 0.2)
    actor.GetProperty().SetLineWidth(2)
    actor.GetProperty().SetAmbient(0.3)


mesh = meshes.read(vtkXMLUnstructuredGridReader(), sys.argv[1])
points = vtk_to_numpy(mesh.GetPoints().GetData())
colors = jacobian_colors()
views = Views(1, 2, (480, 560))
for renderer, shown in zip(views.renderers[0], (mesh, cells_behind(mesh, points.mean(axis=0)))):
    draw_cells(renderer, shown, colors)
look(views.renderers[0], TOWARDS, UP, points, 0.95)
bar = vtkScalarBarActor()
bar.SetLookupTable(colors)
bar.SetNumberOfLabels(3)
bar.SetLabelFormat("%.1f")
bar.UnconstrainedFontSizeOn()
text = bar.GetLabelTextProperty()
text.SetColor(0, 0, 0)
text.SetFontSize(14)
text.ItalicOff()
text.BoldOff()
text.ShadowOff()
bar.GetPositionCoordinate().SetValue(0.02, 0.06)
bar.SetWidth(0.12)
bar.SetHeight(0.35)
views.renderers[0][1].AddActor2D(bar)
write(views.renderers[0][1], "scaled Jacobian", (0.14, 0.01), 14)
views.save(sys.argv[2])
