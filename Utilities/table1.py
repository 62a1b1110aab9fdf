#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Reconstructs the models of the paper's Table 1 and prints that table of Documentation/Results.md.

    . BUILD/environment.sh
    python3 Utilities/table1.py [--save FOLDER] [MODEL=CONTROL_POINTS[:DOMAIN] ...]

A model is a .vti file of TRIVARIATE_DATA_DIR (default: ../shared/data) or orbital_N, the built-in
hydrogen orbital on N^3 voxels; the domain is box, segments or auto, by default box and auto, one row
each. Errors are over all voxels of the image. Seconds are those of the processor, on all threads, the
report not counted; then come the shares of the steps by the clock.
"""
import argparse
import os
import pathlib
import time

from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

from trivariate import (vtkHydrogenOrbitalSource, vtkReconstructionReport, vtkTSplineReconstruction,
                        vtkTSplineSource)

RUNS = ["fuel=1000", "fuel=5000", "hydrogen_atom=1500", "hydrogen_atom=5000", "orbital_256=1500",
        "tooth=15000", "tooth=50000", "ankle_128=16000", "ankle_128=50000"]
DOMAINS = {"box": vtkTSplineReconstruction.BOX, "segments": vtkTSplineReconstruction.SEGMENTS,
           "auto": vtkTSplineReconstruction.AUTOMATIC}
STEPS = {"segments": ("TextureSegmentation", "SegmentTopology", "SegmentBoundary"),
         "domains": ("PolycubeDomain",),
         "fields": ("FrameField", "VolumeParameterization", "HexRemesh"),
         "boxes": ("FitOverBox",), "cubes": ("FitOverCubes",)}
root = pathlib.Path(__file__).resolve().parent.parent
data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR", root.parent / "shared" / "data"))


def source_of(model):
    if model.startswith("orbital_"):
        source = vtkHydrogenOrbitalSource()
        source.SetDimensions(*3 * [int(model.split("_")[1])])
    else:
        source = vtkXMLImageDataReader()
        source.SetFileName(str(data / f"{model}.vti"))
    source.Update()
    return source


def reconstruct(source, name, count, domain):
    """The reconstruction, its seconds, and the last row of its report: that of the whole image."""
    reconstruction = vtkTSplineReconstruction()
    reconstruction.SetInputConnection(source.GetOutputPort())
    reconstruction.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
    reconstruction.SetDomain(DOMAINS[domain])
    reconstruction.SetMaximumNumberOfControlPoints(count)
    reconstruction.SetRMSTolerance(0.0)
    start = time.process_time()
    reconstruction.Update()
    seconds = time.process_time() - start
    report = vtkReconstructionReport()
    labelled = source if domain == "box" else reconstruction
    report.SetInputConnection(0, labelled.GetOutputPort(0 if domain == "box" else 2))
    report.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS, name)
    report.SetTSplineConnection(reconstruction.GetOutputPort())
    report.SetRoundsConnection(reconstruction.GetOutputPort(1))
    if reconstruction.GetOutputDataObject(4).GetNumberOfPoints() > 0:
        report.SetSurfacesConnection(reconstruction.GetOutputPort(4))
    report.Update()
    table = report.GetOutput()
    last = table.GetNumberOfRows() - 1
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    return reconstruction, seconds, {column.GetName(): column.GetTuple1(last)
                                     for column in columns if column.IsNumeric()}


def shares_of_steps(reconstruction):
    """"segments 40 %, domains 12 %, ...", of the steps that took some time."""
    field = reconstruction.GetOutputDataObject(1).GetFieldData()
    names, seconds = field.GetAbstractArray("Step"), field.GetArray("StepSeconds")
    spent = {names.GetValue(i): seconds.GetValue(i) for i in range(names.GetNumberOfValues())}
    shares = {name: 100.0 * sum(spent.get(step, 0.0) for step in steps) / sum(spent.values())
              for name, steps in STEPS.items()}
    return ", ".join(f"{name} {share:.0f} %" for name, share in shares.items() if share >= 0.5)


def save(folder, model, count, domain, reconstruction, source):
    """The image that the spline gives back."""
    back = vtkTSplineSource()
    back.SetInputConnection(0, reconstruction.GetOutputPort())
    back.SetOutputType(vtkTSplineSource.IMAGE)
    back.SetInputConnection(1, source.GetOutputPort() if domain == "box"
                            else reconstruction.GetOutputPort(2))
    writer = vtkXMLImageDataWriter()
    writer.SetInputConnection(back.GetOutputPort())
    writer.SetFileName(str(pathlib.Path(folder) / f"{model}-{count}-{domain}.vti"))
    writer.SetDataModeToBinary()
    writer.Write()


def count_or_dash(number):
    return "-" if number != number else f"{int(number):,}"


def print_row(model, count, domain, folder):
    source = source_of(model)
    name = source.GetOutput().GetPointData().GetArrayName(0)
    reconstruction, seconds, row = reconstruct(source, name, count, domain)
    own = row["RMSPercent"]
    print(f"| {model} | {domain} | {int(row['Voxels']):,} | {'-' if own != own else f'{own:.3f}'} "
          f"| {count_or_dash(row['Corners'])} | {int(row['ControlPoints']):,} "
          f"| {int(row['NumbersStored']):,} | {row['RoundTripRMSPercent']:.3f} "
          f"| {row['FoundPercent']:.2f} | {row['MaximumErrorPercent']:.1f} "
          f"| {row['PSNRDecibels']:.1f} | {(row['SplineBytes'] + row['LabelBytes']) / 1e3:.0f} "
          f"| {row['RawBytes'] / 1e3:.0f} | {row['ZLibBytes'] / 1e3:.0f} "
          f"| {seconds:.0f}: {shares_of_steps(reconstruction)} |", flush=True)
    if folder:
        save(folder, model, count, domain, reconstruction, source)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--save")
    parser.add_argument("runs", nargs="*", default=RUNS)
    options = parser.parse_args()
    vtkSMPTools.SetBackend("STDThread")  # for VTK's own filters too
    if options.save:
        os.makedirs(options.save, exist_ok=True)
    print("| model | domain | voxels | RMS % | corners | control points | numbers stored "
          "| round trip RMS % | found % | max % | PSNR dB | spline and labels kB | raw kB | zlib kB "
          f"| seconds on {vtkSMPTools.GetEstimatedNumberOfThreads()} threads: by step |")
    print("|" + 15 * "---|", flush=True)
    for run in options.runs:
        model, count = run.split("=")
        count, _, domain = count.partition(":")
        for which in [domain] if domain else ["box", "auto"]:
            print_row(model, int(count), which, options.save)


if __name__ == "__main__":
    main()
