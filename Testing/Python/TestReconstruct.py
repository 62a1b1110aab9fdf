# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""reconstruct.sh on the built-in orbital: everything it promises is written, reads back and agrees;
and on bad arguments it says what is wrong."""
import csv
import json
import math
import os
import pathlib
import shutil
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
KEYS = ["voxels", "control_points", "distinct_control_points", "numbers_stored", "tmesh_cells",
        "bezier_cells", "rms_density_percent", "psnr_decibels", "max_error", "round_trip_rms_density_percent",
        "found_percent", "segments", "domains", "fitted_over", "blocks", "corners", "cubes",
        "boundary_hausdorff_voxels", "gradient_jump_percent", "min_scaled_jacobian", "inverted_cells",
        "mean_scaled_jacobian", "inverted_cells_before", "inverted_cells_after", "hexahedra",
        "seconds", "seconds_of_fit", "peak_memory_bytes", "model_bytes", "raw_bytes", "zlib_bytes",
        "label_bytes", "threads", "version"]


def run(*arguments):
    return subprocess.run([script, *arguments], capture_output=True, text=True)


def read(reader, name):
    reader.SetFileName(os.path.join("results", name))
    reader.Update()
    return reader.GetOutput()


def test_results():
    done = run("--output", "results", "--control-points", "1200", "--domain", "box",
               "--segments", "2")
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
    assert report["fitted_over"] == {"0": "ImageBox", "1": "ImageBox"} and report["blocks"] == 1
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
    assert abs(report["psnr_decibels"] + 20.0 * math.log10(rms / 100.0)) < 1e-6
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

    # Its largest lobe has a domain of cubes, which the spline is not over.
    assert report["domains"] == 1, done.stdout
    assert report["corners"] is None and report["cubes"] is None
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
    quality = vtk_to_numpy(hexmesh.GetCellData().GetArray("ScaledJacobian"))
    assert quality.min() > 0.0
    cells = report["hexahedra"]
    assert cells["cells"] == hexmesh.GetNumberOfCells()
    assert cells["inverted_cells"]["before"] >= cells["inverted_cells"]["after"] == 0
    assert abs(cells["min_scaled_jacobian"] - quality.min()) < 1e-9
    assert abs(cells["mean_scaled_jacobian"] - quality.mean()) < 1e-9
    assert report["mean_scaled_jacobian"] == cells["mean_scaled_jacobian"]
    assert 0.97 < cells["volume_ratio"] < 1.03, cells
    assert 0.0 < cells["distance_voxels"]["surface_to_cells"] < 2.0, cells
    assert 0.0 < cells["distance_voxels"]["cells_to_surface"] < 2.0, cells
    for when in ("before", "after"):
        assert report["inverted_cells_" + when] == cells["inverted_cells"][when]

    picture = vtk_to_numpy(read(vtkPNGReader(), "picture.png").GetPointData().GetScalars())
    assert len(picture) == 1600 * 800
    dark = (picture.reshape(800, 1600, -1)[:, :, :3].min(axis=2) < 240)
    assert dark[:, :800].mean() > 0.05 and dark[:, 800:].mean() > dark[:, :800].mean()


def test_automatic():
    """Without options: all that is on the way is there, and it is no worse than one spline."""
    done = run("--output", "automatic", "--control-points", "1200")
    assert done.returncode == 0, done.stdout + done.stderr
    reports = {}
    for folder in ("automatic", "results"):
        with open(f"{folder}/report.json", encoding="utf-8") as file:
            reports[folder] = json.load(file)
    report = reports["automatic"]
    assert list(report) == KEYS and report["segments"] >= 2 and report["domains"] >= 1
    assert {"PolycubeDomain", "FrameField", "VolumeParameterization", "HexRemesh",
            "FitOverBox"} <= set(report["seconds_of_fit"])
    assert report["found_percent"] == 100.0 and 600 < report["distinct_control_points"] <= 1200
    assert (report["round_trip_rms_density_percent"]
            <= 1.0001 * reports["results"]["round_trip_rms_density_percent"])
    for name in ("resampled.vti", "segments.vti", "boundary.vtp", "patches.vtp", "domain.vtu",
                 "fields.vti", "hexmesh.vtu", "segments.png", "picture.png"):
        assert os.path.getsize(os.path.join("automatic", name)) > 0


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
    assert report["fitted_over"] == {"0": "SegmentBox", "1": "SegmentBox"}
    spent = report["seconds_of_fit"]
    assert set(spent) == {"TextureSegmentation", "SegmentTopology", "SegmentBoundary", "FitOverBox"}
    assert 0.5 * report["seconds"]["fit"] < sum(spent.values()) <= report["seconds"]["fit"]
    assert report["round_trip_rms_density_percent"] < 1.0, report
    with open("parts/report.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 3
    assert float(rows[-1]["SplineBytes"]) == os.path.getsize("parts/model.tspline")
    grid = vtkTSplineReader()
    grid.SetFileName("parts/model.tspline")
    grid.Update()
    assert set(vtk_to_numpy(grid.GetOutput().GetPointData().GetArray("Segment"))) == {0, 1}
    for name in ("resampled.vti", "segments.vti", "boundary.vtp", "segments.png", "picture.png"):
        assert os.path.getsize(os.path.join("parts", name)) > 0


def corners_of(path):
    """Places of the corners on the surface of the only segment, by their coordinates."""
    grid = read(vtkXMLUnstructuredGridReader(), path)
    at = vtk_to_numpy(grid.GetPointData().GetArray("DomainCoordinates"))
    corners = vtk_to_numpy(grid.GetPointData().GetArray("CornerId")) >= 0
    places = vtk_to_numpy(grid.GetPoints().GetData())
    return {tuple(map(int, a)): p for a, p in zip(at[corners], places[corners])}


def test_given_domain():
    """Cubes and corners from a domain.vtu, and the same ones from a .json file."""
    corners = corners_of("domain.vtu")
    size = [max(at[a] for at in corners) for a in range(3)]
    pathlib.Path("corners.json").write_text(json.dumps({"segments": [
        {"segment": 1, "cubes": size,
         "corners": [[*at, *map(float, place)] for at, place in corners.items()]}]}))
    # A domain.vtu that an earlier call wrote may be in the folder of the results.
    os.makedirs("given", exist_ok=True)
    shutil.copy("results/domain.vtu", "given")
    points = {}
    for file in ("given/domain.vtu", "corners.json"):
        done = run("--output", "given", "--control-points", "2500", "--domain", file,
                   "--segments", "2")
        assert done.returncode == 0, done.stdout + done.stderr
        with open("given/report.json", encoding="utf-8") as text:
            report = json.load(text)
        assert report["corners"] == len(corners) and report["cubes"] == math.prod(size), report
        assert report["fitted_over"] == {
            "0": "SegmentBox", "1": "LayeredCubes" if file.endswith("vtu") else "Cubes"}
        assert report["round_trip_rms_density_percent"] <= 1.05 * report["rms_density_percent"]
        assert report["hexahedra"]["inverted_cells"]["after"] == 0
        assert report["found_percent"] == 100.0
        for at, place in corners_of("../given/domain.vtu").items():
            assert numpy.linalg.norm(place - corners[at]) < 1.0, (at, place, corners[at])
        grid = vtkTSplineReader()
        grid.SetFileName("given/model.tspline")
        grid.Update()
        data = grid.GetOutput().GetPointData()
        blocks = vtk_to_numpy(data.GetArray("Block"))[vtk_to_numpy(data.GetArray("Segment")) == 1]
        points[file] = len(blocks), len(set(blocks))
        # The limit counts points once that blocks share.
        assert 1200 < report["distinct_control_points"] <= 2500, report
        assert (report["control_points"] > 2500) == file.endswith("vtu"), report
    assert points["given/domain.vtu"][1] >= 7  # layers
    assert points["corners.json"][1] == 1, points  # cubes alone


def files_of(folder):
    """Name, time and size of every file."""
    return {file.name: (file.stat().st_mtime_ns, file.stat().st_size)
            for file in pathlib.Path(folder).iterdir()}


def test_given_faults():
    corners = [[u, v, w, 0, 0, 0] for u in (0, 1) for v in (0, 1) for w in (0, 1)]
    one = {"segment": 1, "cubes": [1, 1, 1], "corners": corners}
    for words, content in (
            ("is no domain", "not json"),
            ("needs a list 'segments'", "[]"),
            ("needs a 'segment' of its own", {"segments": [one, one]}),
            ("1 to 1000 cubes", {"segments": [{**one, "cubes": [1, 0, 1]}]}),
            ("no cube (4, 0, 0)", {"segments": [{**one, "off": [[4, 0, 0]]}]}),
            ("the corner at (0, 0, 1) of segment 1 is there twice",
             {"segments": [{**one, "corners": [*corners, corners[1]]}]}),
            ("the corner at (2, 0, 0) of segment 1 is at none",
             {"segments": [{**one, "corners": [*corners, [2, 0, 0, 1, 1, 1]]}]}),
            ("the place of the corner at (0, 1, 0) of segment 1",
             {"segments": [{**one, "corners": [[0, 1, 0, 1, 2, "x"]]}]}),
            ("Segment 1 of the given domain: The corner at (1, 1, 1) has no place",
             {"segments": [{**one, "corners": corners[:-1]}]}),
            ("Segment 7 of the given domain", {"segments": [{**one, "segment": 7}]})):
        pathlib.Path("bad.json").write_text(content if isinstance(content, str)
                                            else json.dumps(content))
        before = files_of("given")
        done = run("--output", "given", "--domain", "bad.json", "--segments", "2")
        said = done.stdout + done.stderr
        assert done.returncode != 0 and "Traceback" not in said, said
        assert "error:" in said and words in said, (words, said)
        assert files_of("given") == before, words


def test_faults():
    """Each is told in a sentence, and the results of an earlier call stay as they are."""
    shutil.rmtree("faults", ignore_errors=True)
    shutil.copytree("results", "faults")
    for name in ("text.vti", "text.vtu", "text.domain"):
        pathlib.Path(name).write_text("not what it is called\n")
    pathlib.Path("file").write_text("")
    for words, *arguments in (
            ("unknown option", "--frobnicate"),
            ("needs a value", "--array"),
            ("--tolerance is a percentage", "--tolerance", "small"),
            ("--control-points is a whole number", "--control-points", "63"),
            ("--segments is a whole number", "--segments", "65"),
            ("--domain is box, segments, auto or a file", "--domain", "ball"),
            ("one volume at a time", "a.vti", "b.vti"),
            ("there is no file", "absent.vti"),
            ("cannot be made", "--output", "file/below"),
            ("cannot read", "text.vti"),
            ("no point array 'absent'; it has: ", "results/resampled.vti", "--array", "absent"),
            ("no volume image", "results/hexes.vtu"),
            ("one of the results that this call replaces", "faults/segments.vti"),
            ("one of the results that this call replaces", "faults/../faults/resampled.vti"),
            ("an unstructured grid", "--domain", "results/resampled.vti"),
            ("cannot read 'text.vtu'", "--domain", "text.vtu"),
            ("cannot read 'text.domain'", "--domain", "text.domain")):
        before = files_of("faults")
        done = run("--output", "faults", *arguments)
        assert done.returncode != 0 and "Traceback" not in done.stderr, done.stderr
        assert "error:" in done.stderr and words in done.stderr, (words, done.stderr)
        assert files_of("faults") == before, words


test_results()
test_automatic()
test_segments()
test_given_domain()
test_given_faults()
test_faults()
