#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Finds domains of thresholded volumes and prints the tables of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/domains.py [--sweep] [--one-cube] [--save FOLDER]
                                 [VOLUME=THRESHOLD[,THRESHOLD ...][+] ...]

Segment i of a volume is where the density exceeds i of the thresholds; with + the cavities of what
exceeds the first one count to segment 1. What is made whole by
Segment Topology goes through Segment Boundary (without density, whose half-way level is another than
the threshold) and Polycube Domain, all else with their defaults. --sweep takes 20 thresholds a
volume, evenly from the density that half of the voxels exceed to that which 100 exceed. --one-cube
makes corners so dear that there is one cube wherever one will do. The volumes
are the .vti files of TRIVARIATE_DATA_DIR (default: ../shared/data). Each run is a process of its
own; seconds are those of the processor.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import time

import segments

RUNS = ["tooth=105", "fuel=15", "hydrogen_atom=20", "ankle_128=40", "nucleon=50", "nucleon=150",
        "walnut=80", "tooth=105+", "tooth=105,175+", "fuel=15,100", "aneurism=60"]
VOLUMES = ["tooth", "fuel", "hydrogen_atom", "ankle_128", "nucleon", "walnut"]
STEPS = 20
LEAST_VOXELS = 100


def write(output, file):
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter
    grid = output.IsA("vtkUnstructuredGrid")
    writer = vtkXMLUnstructuredGridWriter() if grid else vtkXMLPolyDataWriter()
    writer.SetInputData(output)
    writer.SetFileName(str(file))
    writer.SetDataModeToBinary()
    writer.Write()


def measure(run, folder, one_cube):
    """One row, as a dictionary."""
    import numpy
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersVerdict import vtkMeshQuality
    from trivariate import vtkPolycubeDomain, vtkSegmentBoundary, vtkSegmentTopology
    name, thresholds = run.split("=")
    row = {"messages": ""}
    topology, boundary, domain = vtkSegmentTopology(), vtkSegmentBoundary(), vtkPolycubeDomain()
    boundary.UseDensityOff()
    if one_cube:
        domain.SetCornerCost(1.0)
    topology.SetInputData(segments.labelled(run))
    boundary.SetInputConnection(topology.GetOutputPort())
    domain.SetInputConnection(boundary.GetOutputPort())

    def listen(caller, event, message=""):
        row["messages"] += message.split("): ", 1)[-1].strip() + "\n"
    listen.CallDataType = "string0"
    seconds = []
    for step in (topology, boundary, domain):
        for event in ("WarningEvent", "ErrorEvent"):
            step.AddObserver(event, listen)
        step.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        start = time.process_time()
        step.Update()
        seconds.append(round(time.process_time() - start, 1))
    patches, cubes, borders = (domain.GetOutputDataObject(port) for port in range(3))
    row.update(seconds=seconds, triangles=boundary.GetOutput().GetNumberOfCells(),
               blocks=cubes.GetNumberOfCells(),
               peak=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
    if row["blocks"] > 0:
        quality = vtkMeshQuality()
        quality.SetInputData(cubes)
        quality.SetHexQualityMeasureToScaledJacobian()
        quality.Update()

        def cells(array):
            return vtk_to_numpy(cubes.GetCellData().GetArray(array))
        row["inverted"] = int(numpy.count_nonzero(
            vtk_to_numpy(quality.GetOutput().GetCellData().GetArray("Quality")) <= 0))
        row["corners"] = int(numpy.count_nonzero(
            vtk_to_numpy(cubes.GetPointData().GetArray("CornerId")) >= 0))
        row["cubes"] = int(numpy.count_nonzero(cells("Patch") < 0))
        owner = cells("Segment")
        row["alignment"] = {int(s): float(cells("Alignment")[owner == s][0]) for s in set(owner)}
    if folder:
        for output, suffix in ((patches, "patches.vtp"), (borders, "borders.vtp"),
                               (cubes, "domain.vtu")):
            write(output, pathlib.Path(folder) / f"{name}_{thresholds.replace(',', '_')}_{suffix}")
    return row


def in_a_process(run, folder):
    command = [sys.executable, __file__, "--one", run] + (["--save", folder] if folder else [])
    command += ["--one-cube"] if arguments.one_cube else []
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        return {"messages": f"ended with {done.returncode}"}
    return json.loads(done.stdout.splitlines()[-1])


def table(runs, folder):
    print("| volume, thresholds | triangles | corners | cubes | blocks | inverted | mean n.a "
          "| seconds: topology, boundary, domain |\n|---|---|---|---|---|---|---|---|", flush=True)
    messages = []
    for run in runs:
        row = in_a_process(run, folder)
        alignment = ", ".join(f"{value:.3f}" for value in row.get("alignment", {}).values())
        seconds = ", ".join(f"{value:.1f}" for value in row.get("seconds", []))
        print(f"| {run.replace('=', ', ').replace(',', ', ').replace('  ', ' ')} "
              f"| {row.get('triangles', 0):,} "
              f"| {row.get('corners', '-')} | {row.get('cubes', '-')} | {row.get('blocks', '-')} "
              f"| {row.get('inverted', '-')} | {alignment} | {seconds} |", flush=True)
        messages += [f"{run}: {line}" for line in row["messages"].splitlines()]
    print("\n" + "\n".join(messages), flush=True)


def sweep(volumes, folder):
    import numpy
    print("| volume | thresholds | with a domain | mean n.a | least n.a | corners | inverted blocks "
          "| peak MiB |\n|---|---|---|---|---|---|---|---|", flush=True)
    messages = []
    for volume in volumes:
        _, density = segments.volume_of(volume)
        low, high = (float(d) for d in numpy.sort(density)[[density.size // 2, -1 - LEAST_VOXELS]])
        rows = []
        for step in range(1, STEPS + 1):
            run = f"{volume}={low + (high - low) * step / (STEPS + 1):g}"
            row = in_a_process(run, folder)
            print(run, json.dumps(row), file=sys.stderr, flush=True)
            if row.get("triangles") == 0:
                continue  # all is one segment
            rows.append(row)
            messages += [f"{run}: {line}" for line in row["messages"].splitlines()]
        valid = [row for row in rows if row.get("blocks", 0) > 0]
        values = [value for row in valid for value in row["alignment"].values()]
        corners = sorted(row["corners"] for row in valid)
        print(f"| {volume} | {len(rows)} | {len(valid)} | {sum(values) / len(values):.3f} "
              f"| {min(values):.3f} | {corners[0]} to {corners[-1]} "
              f"| {sum(row['inverted'] for row in valid)} of {sum(row['blocks'] for row in valid)} "
              f"| {max(row['peak'] for row in valid)} |", flush=True)
    print("\n" + "\n".join(messages), flush=True)


parser = argparse.ArgumentParser(description=__doc__,
                                 formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--one", help=argparse.SUPPRESS)
parser.add_argument("--sweep", action="store_true", help="20 thresholds for each VOLUME")
parser.add_argument("--one-cube", action="store_true", help="one cube where one will do")
parser.add_argument("--save", metavar="FOLDER", help="where patches, borders and domains go")
parser.add_argument("runs", nargs="*", metavar="VOLUME=THRESHOLD[,THRESHOLD ...]")
arguments = parser.parse_args()
if arguments.one:
    print(json.dumps(measure(arguments.one, arguments.save, arguments.one_cube)))
elif arguments.sweep:
    sweep(arguments.runs or VOLUMES, arguments.save)
else:
    table(arguments.runs or RUNS, arguments.save)
