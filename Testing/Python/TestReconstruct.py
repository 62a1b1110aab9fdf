# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct.sh on the built-in orbital: everything it promises is written, reads back and agrees;
and on bad arguments it says what is wrong."""
import json
import os
import pathlib
import subprocess
import sys

import numpy
from vtkmodules.vtkCommonDataModel import VTK_BEZIER_HEXAHEDRON, VTK_HEXAHEDRON
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOXML import (vtkXMLImageDataReader, vtkXMLPolyDataReader,
                                 vtkXMLUnstructuredGridReader)
from vtkmodules.util.numpy_support import vtk_to_numpy

from trivariate import vtkHydrogenOrbitalSource, vtkTSplineReader

script = pathlib.Path(sys.argv[1]) / "reconstruct.sh"
KEYS = ["voxels", "control_points", "tmesh_cells", "bezier_cells", "rms_density_percent",
        "max_error", "round_trip_rms_density_percent", "segments", "domains", "seconds",
        "peak_memory_bytes", "model_bytes", "threads", "version"]


def run(*arguments):
    return subprocess.run([script, *arguments], capture_output=True, text=True)


def read(reader, name):
    reader.SetFileName(os.path.join("results", name))
    reader.Update()
    return reader.GetOutput()


def test_results():
    done = run("--output", "results", "--control-points", "1200", "--segments", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "100 %" in done.stdout and "control points" in done.stdout, done.stdout
    with open("results/report.json", encoding="utf-8") as file:
        report = json.load(file)
    print(json.dumps(report, indent=2))
    assert list(report) == KEYS
    assert report["voxels"] == 64**3
    assert 600 < report["control_points"] <= 1200
    assert report["model_bytes"] == os.path.getsize("results/model.tspline")
    assert all(seconds >= 0.0 for seconds in report["seconds"].values())

    model = read(vtkTSplineReader(), "model.tspline")
    assert model.GetNumberOfPoints() == report["control_points"]
    hexes = read(vtkXMLUnstructuredGridReader(), "hexes.vtu")
    assert hexes.GetCellType(0) == VTK_HEXAHEDRON
    bezier = read(vtkXMLUnstructuredGridReader(), "bezier.vtu")
    assert bezier.GetCellType(0) == VTK_BEZIER_HEXAHEDRON
    assert bezier.GetNumberOfCells() == report["bezier_cells"] >= report["tmesh_cells"] > 0

    orbital = vtkHydrogenOrbitalSource()
    orbital.Update()
    before = vtk_to_numpy(orbital.GetOutput().GetPointData().GetArray("Density")).astype(float)
    resampled = read(vtkXMLImageDataReader(), "resampled.vti")
    assert resampled.GetDimensions() == (64, 64, 64)
    assert resampled.GetBounds() == orbital.GetOutput().GetBounds()
    after = vtk_to_numpy(resampled.GetPointData().GetArray("Density"))
    error = (after - before) / numpy.ptp(before)
    rms = 100.0 * numpy.sqrt(numpy.mean(error**2))
    assert rms < 1.0, rms
    assert abs(rms - report["round_trip_rms_density_percent"]) < 1e-9 * rms
    assert abs(rms - report["rms_density_percent"]) < 1e-6 * rms
    assert abs(numpy.abs(error).max() - report["max_error"]) < 1e-6

    # The orbital is brighter inside its surface than outside.
    assert report["segments"] == 2
    segments = read(vtkXMLImageDataReader(), "segments.vti").GetPointData()
    inside = vtk_to_numpy(segments.GetArray("Segment")) == 1
    density = vtk_to_numpy(segments.GetArray("Density"))
    assert density[inside].mean() > 2.0 * density[~inside].mean()
    boundary = read(vtkXMLPolyDataReader(), "boundary.vtp")
    assert boundary.GetNumberOfCells() > 1000
    assert boundary.GetCellData().GetArray("BoundaryLabels").GetNumberOfComponents() == 2

    assert read(vtkPNGReader(), "segments.png").GetDimensions() == (1500, 600, 1)

    # Its largest lobe has a domain of cubes.
    assert report["domains"] == 1, done.stdout
    patches = read(vtkXMLPolyDataReader(), "patches.vtp").GetCellData()
    assert set(vtk_to_numpy(patches.GetArray("Segment"))) == {1}
    assert set(vtk_to_numpy(patches.GetArray("PatchAxis"))) == {0, 1, 2}
    domain = read(vtkXMLUnstructuredGridReader(), "domain.vtu")
    assert domain.GetCellType(0) == VTK_HEXAHEDRON
    assert set(vtk_to_numpy(domain.GetCellData().GetArray("Patch"))) == (
        {-1} | set(vtk_to_numpy(patches.GetArray("Patch"))))

    # And frames of unit length inside.
    fields = read(vtkXMLImageDataReader(), "fields.vti").GetPointData()
    inside = vtk_to_numpy(fields.GetArray("Segment")) == 1
    for axis in "UVW":
        lengths = numpy.linalg.norm(vtk_to_numpy(fields.GetArray("Frame" + axis)), axis=1)
        assert numpy.allclose(lengths, inside, atol=1e-6)

    picture = vtk_to_numpy(read(vtkPNGReader(), "picture.png").GetPointData().GetScalars())
    assert len(picture) == 1600 * 800
    dark = (picture.reshape(800, 1600, -1)[:, :, :3].min(axis=2) < 240)
    assert dark[:, :800].mean() > 0.05 and dark[:, 800:].mean() > dark[:, :800].mean()


def test_faults():
    pathlib.Path("text.vti").write_text("not an image\n")
    pathlib.Path("file").write_text("")
    for words, *arguments in (
            ("unknown option", "--frobnicate"),
            ("needs a value", "--array"),
            ("--tolerance is a percentage", "--tolerance", "small"),
            ("--control-points is a whole number", "--control-points", "63"),
            ("--segments is a whole number", "--segments", "65"),
            ("one volume at a time", "a.vti", "b.vti"),
            ("there is no file", "absent.vti"),
            ("cannot be made", "--output", "file/below"),
            ("cannot read", "text.vti"),
            ("no point array 'absent'; it has: ", "results/resampled.vti", "--array", "absent"),
            ("no volume image", "results/hexes.vtu")):
        done = run("--output", "faults", *arguments)
        assert done.returncode != 0 and "Traceback" not in done.stderr, done.stderr
        assert "error:" in done.stderr and words in done.stderr, (words, done.stderr)
        assert not os.path.exists("faults/report.json")


test_results()
test_faults()
