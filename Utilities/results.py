#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs real volumes with reconstruct.sh and prints the table of Documentation/Results.md.

    Utilities/results.py OUTPUT [VOLUME=CONTROL_POINTS ...]

The volumes are the .vti files of TRIVARIATE_DATA_DIR (default: ../shared/data); every run leaves
its results in a folder of OUTPUT.
"""
import json
import os
import pathlib
import subprocess
import sys

RUNS = ["fuel=1000", "fuel=5000", "hydrogen_atom=2000", "hydrogen_atom=5000", "nucleon=2000",
        "nucleon=5000", "tooth=15000", "tooth=50000", "ankle_128=15000", "ankle_128=50000",
        "walnut=15000", "walnut=50000"]
root = pathlib.Path(__file__).resolve().parent.parent
data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR", root.parent / "shared" / "data"))


def row(run):
    volume, count = run.split("=")
    folder = pathlib.Path(sys.argv[1]) / f"{volume}-{count}"
    subprocess.run([root / "reconstruct.sh", data / f"{volume}.vti", "--domain", "box",
                    "--output", folder, "--control-points", count], check=True, stdout=sys.stderr)
    report = json.loads((folder / "report.json").read_text(encoding="utf-8"))
    return (f"| {volume} | {report['voxels']:,} | {report['control_points']:,} "
            f"| {report['bezier_cells']:,} | {report['rms_density_percent']:.3f} "
            f"| {report['max_error']:.3f} | {report['round_trip_rms_density_percent']:.3f} "
            f"| {report['seconds']['fit']:.1f} | {report['peak_memory_bytes'] / 2**20:.0f} "
            f"| {report['model_bytes'] / 1000:.0f} |")


print("| volume | voxels | control points | Bezier cells | RMS % | max | round trip RMS % "
      "| fit s | peak MiB | .tspline kB |")
print("|---|---|---|---|---|---|---|---|---|---|", flush=True)
for run in sys.argv[2:] or RUNS:
    print(row(run), flush=True)
