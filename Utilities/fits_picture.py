# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""A spline that fits.py saved, from outside and cut open, with the cells of its T-mesh and its density,
and what the volume has in the plane of the cut: Documentation/fits_tooth.png.

    . BUILD/environment.sh
    python3 Utilities/fits.py FOLDER tooth=105+:4:2000
    Utilities/with-display.sh pvpython Utilities/fits_picture.py FOLDER/tooth_105+_4_2000.tspline \\
      tooth.vti FILE.png
"""
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPlane
from vtkmodules.vtkFiltersCore import vtkCutter
from vtkmodules.vtkFiltersExtraction import vtkExtractGeometry
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

from trivariate import vtkTSplineReader, vtkTSplineSource
from views import Views, draw, look, write

TOWARDS, UP = (-0.35, -1.0, 0.25), (0, 0, 1)
TOOTH = (0.93, 0.89, 0.80)


def hexahedra_of(reader, subdivisions):
    """Straight ones, so many along each axis of a Bezier cell."""
    source = vtkTSplineSource()
    source.SetInputConnection(0, reader.GetOutputPort())
    source.SetOutputType(vtkTSplineSource.LINEAR_HEXES)
    source.SetSubdivisions(subdivisions)
    source.Update()
    return source.GetOutputDataObject(0)


def surface_of(mesh):
    surface = vtkGeometryFilter()
    surface.SetInputData(mesh)
    surface.Update()
    return surface.GetOutput()


def cut_by(plane, mesh):
    cut = vtkCutter()
    cut.SetInputData(mesh)
    cut.SetCutFunction(plane)
    cut.Update()
    return cut.GetOutput()


def cells_behind(plane, mesh):
    """Whole ones, so that their shapes are seen."""
    behind = vtkExtractGeometry()
    behind.SetInputData(mesh)
    behind.SetImplicitFunction(plane)
    behind.Update()
    return behind.GetOutput()


def show_edges(actor):
    actor.GetProperty().EdgeVisibilityOn()
    actor.GetProperty().SetEdgeColor(0.1, 0.25, 0.6)


def draw_density(renderer, data, name, values):
    actor = draw(renderer, data, (1, 1, 1))
    mapper = actor.GetMapper()
    mapper.ScalarVisibilityOn()
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(name)
    mapper.SetScalarRange(*values)
    mapper.CreateDefaultLookupTable()
    table = mapper.GetLookupTable()
    table.SetSaturationRange(0.0, 0.0)
    table.SetHueRange(0.0, 0.0)
    table.SetValueRange(0.15, 1.0)
    actor.GetProperty().SetAmbient(0.6)
    actor.GetProperty().SetDiffuse(0.4)
    return actor


spline, volume = vtkTSplineReader(), vtkXMLImageDataReader()
spline.SetFileName(sys.argv[1])
volume.SetFileName(sys.argv[2])
volume.Update()
coarse, fine = hexahedra_of(spline, 2), hexahedra_of(spline, 6)
points = vtk_to_numpy(coarse.GetPoints().GetData())
plane = vtkPlane()
plane.SetOrigin(*points.mean(axis=0))
plane.SetNormal(0.0, -1.0, 0.0)
density = volume.GetOutput().GetPointData().GetArray(0)
values = numpy.percentile(vtk_to_numpy(density), (50, 99.9))
views = Views(1, 4, (320, 500))
row = views.renderers[0]
show_edges(draw(row[0], surface_of(coarse), TOOTH))
show_edges(draw_density(row[1], surface_of(cells_behind(plane, coarse)), "Density", values))
draw_density(row[2], cut_by(plane, fine), "Density", values)
draw_density(row[3], cut_by(plane, volume.GetOutput()), density.GetName(), values)
look(row, TOWARDS, UP, points, 0.9)
for view, text in zip(row, ("T-spline", "its cells", "its density", "the volume")):
    write(view, text, (0.5, 0.955), 16)
views.save(sys.argv[3])
