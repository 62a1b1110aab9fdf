# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figure 6 of the paper for domains that domains.py found: Documentation/figure6.png.

    . BUILD/environment.sh
    python3 Utilities/domains.py --save FOLDER tooth=105+ ankle_128=40 fuel=15 hydrogen_atom=20
    Utilities/with-display.sh pvpython Utilities/figure6.py FOLDER FILE.png [VOLUME=THRESHOLD:EDGE ...]

A row for each: the surface with its patches, their borders and corners; a checkerboard of the two
parameters of the surface; lines of constant u, v, w on a cut. EDGE is the wanted length of the
mesh's cells in voxels, from which the parameters are taken. Patches that bound u, v, w are red,
green, blue, and so are the lines.
"""
import pathlib
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import (vtkAppendPolyData, vtkClipPolyData, vtkContourFilter,
                                       vtkCutter, vtkFeatureEdges, vtkPolyDataNormals, vtkThreshold)
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

import meshes
from views import Views, checkers, draw, draw_flat, draw_spheres, draw_tubes, look, write

RUNS = ["tooth=105+:4", "ankle_128=40:6", "fuel=15:2", "hydrogen_atom=20:2"]
TITLES = ("patches, borders, corners", "parameters of the surface", "u, v, w on a cut")
# Each is cut across the direction of its domain that is closest to the one here.
ACROSS = {"tooth": (0, -1, 0), "ankle_128": (-1, 0, 0), "fuel": (0, -1, 0),
          "hydrogen_atom": (0, -1, 0)}
UP = (0, 0, 1)
AXIS_COLORS = ((0.86, 0.42, 0.35), (0.42, 0.68, 0.42), (0.38, 0.54, 0.84))
LINE_COLORS = ((0.78, 0.16, 0.10), (0.10, 0.50, 0.18), (0.12, 0.28, 0.76))
PALE, BORDER, CORNER = (0.95, 0.91, 0.84), (0.15, 0.15, 0.18), (1.0, 0.80, 0.10)
SQUARES = 14  # along the longest side of the bounds


def split(data, array, value):
    """The cells with one value of an array, as polygons."""
    cells = vtkThreshold()
    cells.SetInputData(data)
    cells.SetInputArrayToProcess(0, 0, 0, 1, array)
    cells.SetLowerThreshold(value)
    cells.SetUpperThreshold(value)
    polygons = vtkGeometryFilter()
    polygons.SetInputConnection(cells.GetOutputPort())
    polygons.Update()
    return polygons.GetOutput()


def smooth(data):
    normals = vtkPolyDataNormals()
    normals.SetInputData(data)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def gather(parts):
    append = vtkAppendPolyData()
    for part in parts:
        append.AddInputData(part)
    append.Update()
    return append.GetOutput()


class Block:
    """A structured grid as arrays, indexed u, v, w; squares: how many along u, v, w."""

    def __init__(self, grid, edge, square):
        self.grid = grid
        self.size = [0, 0, 0]
        grid.GetDimensions(self.size)

        def array(data, *shape):
            return vtk_to_numpy(data).reshape(self.size[::-1] + list(shape)).swapaxes(0, 2)
        self.points = array(grid.GetPoints().GetData(), 3)
        self.nodes = array(grid.GetPointData().GetArray("Node"))
        self.parameter = vtk_to_numpy(grid.GetPointData().GetArray("Parameter"))
        # Equal on glued faces, as the cells are; the last square is whole.
        self.squares = [max(1, round((n - 1) * edge / square)) for n in self.size]

    def faces(self):
        for axis in range(3):
            for side in (0, -1):
                yield axis, side, tuple(side if a == axis else slice(None) for a in range(3))

    def face(self, axis, side, place):
        """The quadrilaterals of a face, the corners of squares at whole coordinates of texture."""
        across = [a for a in range(3) if a != axis]
        points = self.points[place]
        n, m = points.shape[:2]
        number = numpy.arange(n * m).reshape(n, m)
        quads = numpy.stack(
            (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]), axis=-1)
        # Seen from outside against the clock: u x v = w.
        if (side == 0) == (axis != 1):
            quads = quads[..., ::-1]
        face = vtkPolyData()
        face.SetPoints(vtkPoints())
        face.GetPoints().SetData(numpy_to_vtk(points.reshape(-1, 3), deep=1))
        cells = vtkCellArray()
        for quad in quads.reshape(-1, 4):
            cells.InsertNextCell(4, quad)
        face.SetPolys(cells)
        steps = numpy.stack(numpy.meshgrid(*(numpy.linspace(0, 0.5 * self.squares[a], self.size[a])
                                             for a in across), indexing="ij"), -1)
        face.GetPointData().SetTCoords(numpy_to_vtk(steps.reshape(-1, 2), deep=1))
        return face

    def cut(self, plane):
        """The cut, and on it the lines of constant u, v, w."""
        cutter = vtkCutter()
        cutter.SetInputData(self.grid)
        cutter.SetCutFunction(plane)
        cutter.GenerateCutScalarsOff()
        cutter.Update()
        section = cutter.GetOutput()
        lines = []
        for axis in range(3):
            scalars = vtk_to_numpy(section.GetPointData().GetArray("Parameter"))[:, axis] \
                if section.GetNumberOfPoints() else numpy.zeros(0)
            values = vtkPolyData()
            values.ShallowCopy(section)
            scaled = numpy_to_vtk(self.squares[axis] * scalars, deep=1)
            scaled.SetName("Scaled")
            values.GetPointData().SetScalars(scaled)
            contour = vtkContourFilter()
            contour.SetInputData(values)
            for i in range(1, self.squares[axis]):
                contour.SetValue(i - 1, i)
            contour.Update()
            lines.append(contour.GetOutput())
        return section, lines


def outer_faces(blocks):
    """For each axis the faces of blocks that bound it and are nobody else's."""
    owners = {}
    for block in blocks:
        for face in block.faces():
            corners = block.nodes[face[2]][[0, 0, -1, -1], [0, -1, 0, -1]]
            owners.setdefault(frozenset(corners), []).append((block, face))
    found = [[], [], []]
    for users in owners.values():
        if len(users) == 1:
            block, face = users[0]
            found[face[0]].append(block.face(*face))
    return [gather(faces) for faces in found]


def draw_patches(renderer, patches, borders, unit):
    for axis, color in enumerate(AXIS_COLORS):
        draw(renderer, smooth(split(patches, "PatchAxis", axis)), color)
    draw_tubes(renderer, borders, BORDER, 0.5 * unit)
    corners = vtkPolyData()
    corners.SetPoints(vtkPoints())
    ids = vtk_to_numpy(patches.GetPointData().GetArray("CornerId"))
    for point in numpy.flatnonzero(ids >= 0):
        corners.GetPoints().InsertNextPoint(patches.GetPoint(point))
    draw_spheres(renderer, corners, CORNER, 2.5 * unit)


def draw_checkerboard(renderer, faces):
    for color, face in zip(AXIS_COLORS, faces):
        draw(renderer, smooth(face), [0.4 + 0.6 * c for c in color], checkers(0.35))


def direction_near(patches, wanted):
    """From patches at low ends to those at high ends or back: what is closest to a direction."""
    points = vtk_to_numpy(patches.GetPoints().GetData())
    triangles = vtk_to_numpy(patches.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    middles = points[triangles].mean(axis=1)
    axes, sides = (vtk_to_numpy(patches.GetCellData().GetArray("Patch" + name))
                   for name in ("Axis", "Side"))
    directions = []
    for axis in range(3):
        low, high = (middles[(axes == axis) & (sides == side)].mean(axis=0) for side in (0, 1))
        along = (high - low) / numpy.linalg.norm(high - low)
        directions += [along, -along]
    return max(directions, key=lambda along: along @ wanted)


def draw_cut(renderer, blocks, faces, normal, middle):
    plane = vtkPlane()
    plane.SetOrigin(*middle)
    plane.SetNormal(*-normal)
    behind = vtkClipPolyData()
    behind.SetInputData(gather(faces))
    behind.SetClipFunction(plane)
    behind.Update()
    draw(renderer, behind.GetOutput(), PALE).GetProperty().SetAmbient(0.5)
    for block in blocks:
        section, lines = block.cut(plane)
        if section.GetNumberOfCells() == 0:
            continue
        draw_flat(renderer, section, (1, 1, 1))
        for color, line in zip(LINE_COLORS, lines):
            draw_in_front(renderer, line, color, 3)
        rim = vtkFeatureEdges()
        rim.SetInputData(section)
        rim.FeatureEdgesOff()
        rim.NonManifoldEdgesOff()
        rim.ColoringOff()
        rim.Update()
        draw_in_front(renderer, rim.GetOutput(), BORDER, 4)


def draw_in_front(renderer, lines, color, width):
    actor = draw_flat(renderer, lines, color)
    actor.GetProperty().SetLineWidth(width)
    actor.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
    actor.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(-1.0, -2.0)


def draw_row(renderers, folder, run):
    name, edge = run.split(":")
    edge = float(edge)
    patches, borders, polycube = meshes.read_domain(folder, name)
    bounds = patches.GetBounds()
    square = max(bounds[2 * a + 1] - bounds[2 * a] for a in range(3)) / SQUARES
    grids = meshes.remesh(patches, polycube, edge).GetOutputDataObject(0)
    blocks = [Block(grids.GetPartition(i, 0), edge, square)
              for i in range(grids.GetNumberOfPartitionedDataSets())]
    faces = outer_faces(blocks)
    volume = name.split("=")[0]
    normal = direction_near(patches, ACROSS[volume])
    aside = numpy.cross(UP, normal)
    points = vtk_to_numpy(patches.GetPoints().GetData())
    draw_patches(renderers[0], patches, borders, 0.1 * square)
    draw_checkerboard(renderers[1], faces)
    draw_cut(renderers[2], blocks, faces, normal, points.mean(axis=0))
    look(renderers, normal + 0.4 * aside + 0.3 * numpy.array(UP), UP, points, 0.84)
    write(renderers[0], volume, (0.5, 0.01))


if __name__ == "__main__":
    runs = sys.argv[3:] or RUNS
    views = Views(len(runs), 3, (480, 400))
    for row, argument in zip(views.renderers, runs):
        draw_row(row, pathlib.Path(sys.argv[1]), argument)
    for renderer, title in zip(views.renderers[0], TITLES):
        write(renderer, title, (0.5, 0.945))
    views.save(sys.argv[2])
