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
KEYS = ["voxels", "control_points", "numbers_stored", "tmesh_cells", "bezier_cells",
        "rms_density_percent", "max_error", "round_trip_rms_density_percent", "found_percent",
        "segments", "domains", "corners", "cubes", "boundary_hausdorff_voxels",
        "min_scaled_jacobian", "inverted_cells", "seconds", "peak_memory_bytes", "model_bytes",
        "raw_bytes", "zlib_bytes", "label_bytes", "threads", "version"]


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
    assert report["voxels"] == 64**3 and report["raw_bytes"] == 4 * 64**3
    assert report["model_bytes"] < report["zlib_bytes"] < report["raw_bytes"]
    assert report["found_percent"] == 100.0 and report["label_bytes"] == 0
    assert abs(report["min_scaled_jacobian"] - 1.0) < 1e-9 and report["inverted_cells"] == 0
    assert report["boundary_hausdorff_voxels"] is None  # a box has no boundary with a segment
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
    assert report["corners"] >= 8 and report["cubes"] >= 1
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

    # And hexahedra, none of them inverted.
    hexmesh = read(vtkXMLUnstructuredGridReader(), "hexmesh.vtu")
    assert hexmesh.GetCellType(0) == VTK_HEXAHEDRON
    assert set(vtk_to_numpy(hexmesh.GetCellData().GetArray("Segment"))) == {1}
    assert hexmesh.GetCellData().GetArray("ScaledJacobian").GetRange()[0] > 0.0

    picture = vtk_to_numpy(read(vtkPNGReader(), "picture.png").GetPointData().GetScalars())
    assert len(picture) == 1600 * 800
    dark = (picture.reshape(800, 1600, -1)[:, :, :3].min(axis=2) < 240)
    assert dark[:, :800].mean() > 0.05 and dark[:, 800:].mean() > dark[:, :800].mean()


def test_segments():
    """A spline for each segment; the image is written back from them."""
    done = run("--output", "parts", "--control-points", "1200", "--domain", "segments",
               "--segments", "2")
    assert done.returncode == 0, done.stdout + done.stderr
    with open("parts/report.json", encoding="utf-8") as file:
        report = json.load(file)
    assert list(report) == KEYS and report["segments"] == 2
    assert report["found_percent"] == 100.0 and 600 < report["control_points"] <= 1200
    assert report["label_bytes"] > 0
    assert report["round_trip_rms_density_percent"] < 1.0, report
    with open("parts/report.csv", encoding="utf-8") as file:
        assert len(file.readlines()) == 1 + 3
    grid = vtkTSplineReader()
    grid.SetFileName("parts/model.tspline")
    grid.Update()
    assert set(vtk_to_numpy(grid.GetOutput().GetPointData().GetArray("Segment"))) == {0, 1}
    for name in ("resampled.vti", "segments.vti", "boundary.vtp", "segments.png", "picture.png"):
        assert os.path.getsize(os.path.join("parts", name)) > 0


def test_faults():
    pathlib.Path("text.vti").write_text("not an image\n")
    pathlib.Path("file").write_text("")
    for words, *arguments in (
            ("unknown option", "--frobnicate"),
            ("needs a value", "--array"),
            ("--tolerance is a percentage", "--tolerance", "small"),
            ("--control-points is a whole number", "--control-points", "63"),
            ("--segments is a whole number", "--segments", "65"),
            ("--domain is box, segments or auto", "--domain", "ball"),
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
test_segments()
test_faults()
