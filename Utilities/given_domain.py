# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Cubes and corners of segments from a .json file, as Documentation/UserGuide.md describes it."""
import itertools
import json
import math

from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_HEXAHEDRON, vtkUnstructuredGrid

# The corners of a cube in VTK's order.
ENDS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def numbers(value, count, kind, what):
    """A list of so many numbers of a kind, as a tuple."""
    if not isinstance(value, list) or len(value) != count or not all(
            isinstance(x, kind) and not isinstance(x, bool) and math.isfinite(x) for x in value):
        name = "whole numbers" if kind is int else "numbers"
        raise ValueError(f"{what} is a list of {count} {name}, not {value}")
    return tuple(value)


def member(table, key, what):
    if not isinstance(table, dict) or not isinstance(table.get(key), list):
        raise ValueError(f"{what} needs a list '{key}'")
    return table[key]


def cubes_of(entry, name):
    """The low corners of the cubes of a segment."""
    size = numbers(entry.get("cubes"), 3, int, f"'cubes' of {name}")
    if min(size) < 1 or math.prod(size) > 1000:
        raise ValueError(f"{name} has 1 to 1000 cubes, not {size[0]} x {size[1]} x {size[2]}")
    off = [numbers(cube, 3, int, f"a cube in 'off' of {name}") for cube in entry.get("off", [])]
    cubes = list(itertools.product(*map(range, size)))
    for cube in off:
        if cube not in cubes:
            raise ValueError(f"there is no cube {cube} in {name} to be switched off")
    return [cube for cube in cubes if cube not in off]


def corners_of(entry, name):
    """The places of corners by their coordinates in the lattice."""
    places = {}
    for corner in member(entry, "corners", name):
        if not isinstance(corner, list) or len(corner) != 6:
            raise ValueError(f"a corner of {name} is [u, v, w, x, y, z], not {corner}")
        at = numbers(corner[:3], 3, int, f"the place in the lattice of a corner of {name}")
        if at in places:
            raise ValueError(f"the corner at {at} of {name} is there twice")
        places[at] = numbers(corner[3:], 3, (int, float), f"the place of the corner at {at} of {name}")
    return places


def grid_of(segments):
    """An unstructured grid as Polycube Domain gives it. Lattice points without a place have none of
    the numbers of corners; those inside of the shape need none."""
    grid, points = vtkUnstructuredGrid(), vtkPoints()
    coordinates, corner_id, segment = vtkIntArray(), vtkIntArray(), vtkIntArray()
    coordinates.SetName("DomainCoordinates")
    coordinates.SetNumberOfComponents(3)
    corner_id.SetName("CornerId")
    segment.SetName("Segment")
    points.SetDataTypeToDouble()
    grid.Allocate()
    for label, (cubes, places) in segments.items():
        ids = {}
        for cube in cubes:
            for end in ENDS:
                at = tuple(c + e for c, e in zip(cube, end))
                if at not in ids:
                    ids[at] = points.InsertNextPoint(places.get(at, (0.0, 0.0, 0.0)))
                    coordinates.InsertNextTuple3(*at)
                    corner_id.InsertNextValue(ids[at] if at in places else -1)
            grid.InsertNextCell(VTK_HEXAHEDRON, 8, [
                ids[tuple(c + e for c, e in zip(cube, end))] for end in ENDS])
            segment.InsertNextValue(label)
        for at in places:
            if at not in ids:
                raise ValueError(f"the corner at {at} of segment {label} is at none of its cubes")
    grid.SetPoints(points)
    grid.GetPointData().AddArray(coordinates)
    grid.GetPointData().AddArray(corner_id)
    grid.GetCellData().AddArray(segment)
    return grid


def read(path):
    """The grid that a file describes. Raises ValueError with a sentence for the user."""
    with open(path, encoding="utf-8") as file:
        content = json.load(file)
    segments = {}
    for entry in member(content, "segments", "the file"):
        label = entry.get("segment") if isinstance(entry, dict) else None
        if not isinstance(label, int) or label in segments:
            raise ValueError(f"every entry of 'segments' needs a 'segment' of its own, not {label}")
        name = f"segment {label}"
        segments[label] = cubes_of(entry, name), corners_of(entry, name)
    return grid_of(segments)
