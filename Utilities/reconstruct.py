# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""From a volume image to a T-spline and back: the job of reconstruct.sh, run by pvbatch."""
import argparse
import json
import os
import resource
import sys
import time

import numpy
from paraview import simple
from vtkmodules.numpy_interface import dataset_adapter
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkImageData

import picture
import trivariate


def fail(message):
    """Ends the job with one sentence for the user."""
    print("reconstruct: error:", message, file=sys.stderr, flush=True)
    os._exit(1)  # pvbatch would not pass on the code of sys.exit


def say(message):
    print("reconstruct:", message, flush=True)


class Stopwatch:
    """Runs the steps of the job, tells of them and keeps their times."""

    def __init__(self):
        self.seconds = {}

    def __call__(self, name, step, *arguments):
        say(name.replace("_", " "))
        start = time.perf_counter()
        result = step(*arguments)
        self.seconds[name] = round(time.perf_counter() - start, 3)
        return result


def output_of(proxy, port=0):
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def report_progress(proxy, every=10):
    """Prints each `every` percent of what the filter behind the proxy does."""
    algorithm = proxy.GetClientSideObject()
    told = [0]

    def tell(*_):
        percent = int(100 * algorithm.GetProgress()) // every * every
        if percent > told[0]:
            told[0] = percent
            say(f"  {percent} %")

    algorithm.AddObserver("ProgressEvent", tell)


def read(volume):
    """The source of the image: a reader, or the built-in orbital."""
    if volume is None:
        source = simple.TrivariateOrbital()
    else:
        try:
            source = simple.OpenDataFile(volume)
        except RuntimeError as error:
            fail(f"ParaView cannot read '{volume}': {error}")
        if source is None:
            fail(f"ParaView has no reader for '{volume}'")
    source.UpdatePipeline()
    image = output_of(source)
    if not isinstance(image, vtkImageData) or image.GetNumberOfPoints() == 0:
        fail(f"'{volume}' holds no volume image")
    return source


def choose_array(image, wanted):
    """The name of the point array to fit."""
    data = image.GetPointData()
    names = [data.GetArrayName(i) for i in range(data.GetNumberOfArrays()) if data.GetArray(i)]
    if not names:
        fail("the volume has no point array; its cell arrays become such by Cell Data to Point Data")
    if wanted and wanted not in names:
        fail(f"the volume has no point array '{wanted}'; it has: " + ", ".join(names))
    name = wanted or (data.GetScalars().GetName() if data.GetScalars() else names[0])
    components = data.GetArray(name).GetNumberOfComponents()
    if components != 1:
        fail(f"the point array '{name}' has {components} components; one is needed")
    return name


def fit_spline(source, name, tolerance, control_points):
    fit = simple.TSplineFit(Input=source, Scalars=["POINTS", name], RMSTolerance=tolerance,
                            MaximumNumberOfControlPoints=control_points)
    report_progress(fit)
    fit.UpdatePipeline()
    if output_of(fit).GetNumberOfPoints() == 0:
        fail("the fit failed, as told above")
    return fit


def save(path, proxy, **options):
    """Writes a file in full or fails; XML files inline, since appended data do not read back."""
    try:
        simple.SaveData(path, proxy=proxy, **options)
    except RuntimeError as error:
        fail(f"cannot write '{path}': {error}")
    if not os.path.isfile(path) or os.path.getsize(path) == 0:
        fail(f"cannot write '{path}'")


def read_back(path):
    model = simple.OpenDataFile(path)
    model.UpdatePipeline()
    if output_of(model).GetNumberOfPoints() == 0:
        fail(f"'{path}' does not read back")
    return model


def evaluate(path, model, output_type, **settings):
    """Evaluates the spline in one of its forms and saves that."""
    source = simple.TSplineSource(Input=model, OutputType=output_type, **settings)
    source.UpdatePipeline()
    save(path, source, DataMode="Binary", CompressorType="ZLib")
    return source


def segment(path, source, name, count):
    """Splits the volume into materials and saves their labels; 0 chooses their number."""
    segmentation = simple.TextureSegmentation(Input=source, Scalars=["POINTS", name],
                                              NumberOfSegments=count)
    report_progress(segmentation)
    segmentation.UpdatePipeline()
    if output_of(segmentation).GetPointData().GetArray("Segment") is None:
        fail("the segmentation failed, as told above")
    save(path, segmentation, DataMode="Binary", CompressorType="ZLib")
    return segmentation


def count_domains(layout):
    return len(set(dataset_adapter.WrapDataObject(output_of(layout, 1)).CellData["Segment"]))


def count_segments(segmentation):
    return 1 + int(output_of(segmentation).GetPointData().GetArray("Segment").GetRange()[1])


def bound(path, segmentation):
    """Saves the surfaces between the segments."""
    boundary = simple.SegmentBoundary(Input=segmentation)
    report_progress(boundary)
    boundary.UpdatePipeline()
    if output_of(boundary).GetNumberOfCells() == 0:
        fail("there is no surface between segments")
    save(path, boundary, DataMode="Binary", CompressorType="ZLib")
    return boundary


def lay_out(patches, domain, segmentation):
    """Saves the segments' surfaces cut into patches, and the cubes that are their domains. Tells of
    segments without a domain, and why. Returns the filter, or None where there is no domain."""
    whole = simple.SegmentTopology(Input=segmentation)
    layout = simple.PolycubeDomain(Input=simple.SegmentBoundary(Input=whole))
    report_progress(layout)
    algorithm = layout.GetClientSideObject()

    def tell(_, __, text):
        for line in text.split("): ", 1)[-1].strip().splitlines():  # after VTK's place in the source
            say("  " + line)

    tell.CallDataType = VTK_STRING
    for event in ("ErrorEvent", "WarningEvent"):
        algorithm.AddObserver(event, tell)
    # The executive only repeats that the filter has failed.
    algorithm.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    layout.UpdatePipeline()
    cubes = output_of(layout, 1)
    if cubes.GetNumberOfCells() == 0:
        return None
    for path, port in ((patches, 0), (domain, 1)):
        save(path, simple.OutputPort(layout, port), DataMode="Binary", CompressorType="ZLib")
    return layout


def align(path, layout):
    """Saves the image of which the domains are made, with frames aligned with their patches."""
    whole = layout.Input.Input
    field = simple.FrameField(Input=whole, Patches=simple.OutputPort(layout, 0))
    report_progress(field)
    field.UpdatePipeline()
    if output_of(field).GetPointData().GetArray("FrameU") is None:
        fail("there are no frames, as told above")
    save(path, field, DataMode="Binary", CompressorType="ZLib")


def count_cells(model):
    mesh = simple.TSplineSource(Input=model, OutputType="T-Mesh")
    mesh.UpdatePipeline()
    return output_of(mesh).GetNumberOfCells()


def round_trip_error(image, resampled, name):
    """100 x RMS over all voxels of the range-scaled difference of two images."""
    before = dataset_adapter.WrapDataObject(image).PointData[name].astype(float)
    after = dataset_adapter.WrapDataObject(resampled).PointData[name]
    scale = numpy.ptp(before) or 1.0
    return 100.0 * float(numpy.sqrt(numpy.mean(((after - before) / scale) ** 2)))


def last_round(fit):
    table = output_of(fit, 1)
    row = table.GetNumberOfRows() - 1
    return (table.GetValueByName(row, "RMS").ToDouble(),
            table.GetValueByName(row, "MaximumError").ToDouble())


def print_table(report):
    print()
    for key, value in report.items():
        if key == "seconds":
            value = f"{sum(value.values()):.1f}"
        elif isinstance(value, float):
            value = f"{value:.5g}"
        elif isinstance(value, int):
            value = f"{value:,}"
        print(f"  {key.replace('_', ' '):32} {value:>16}")
    print(flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--volume")
    parser.add_argument("--output", required=True)
    parser.add_argument("--array")
    parser.add_argument("--tolerance", type=float)
    parser.add_argument("--control-points", type=int)
    parser.add_argument("--segments", type=int)
    options = parser.parse_args()
    if options.tolerance is None:
        options.tolerance = 0.0 if options.control_points else 0.1

    vtkSMPTools.SetBackend("STDThread")  # for VTK's own filters and writers too
    step = Stopwatch()

    def path(name):
        return os.path.join(options.output, name)

    for old in ("report.json", "patches.vtp", "domain.vtu", "fields.vti"):
        if os.path.exists(path(old)):
            os.remove(path(old))  # the first stands for all results; the others may not come anew
    source = step("read", read, options.volume)
    image = output_of(source)
    name = choose_array(image, options.array)
    fit = step("fit", fit_spline, source, name, options.tolerance, options.control_points or 50000)
    step("write", save, path("model.tspline"), fit)
    model = step("read_back", read_back, path("model.tspline"))
    resampled = step("resample", lambda: evaluate(path("resampled.vti"), model, "Image", Points=source))
    hexes = step("hexahedra", lambda: evaluate(path("hexes.vtu"), model, "Linear Hexahedra"))
    bezier = step("bezier", lambda: evaluate(path("bezier.vtu"), model, "Bezier Hexahedra"))
    if options.segments is not None:
        segments = step("segment", segment, path("segments.vti"), source, name, options.segments)
        boundary = step("boundary", bound, path("boundary.vtp"), segments)
        layout = step("domain", lay_out, path("patches.vtp"), path("domain.vtu"), segments)
        if layout:
            step("frames", align, path("fields.vti"), layout)
        step("segments_picture", picture.save_segments, path("segments.png"), segments, boundary,
             name)
    step("picture", picture.save, path("picture.png"), source, resampled, model, name)

    rms, maximum = last_round(fit)
    report = {
        "voxels": image.GetNumberOfPoints(),
        "control_points": output_of(model).GetNumberOfPoints(),
        "tmesh_cells": count_cells(model),
        "bezier_cells": output_of(bezier).GetNumberOfCells(),
        "rms_density_percent": rms,
        "max_error": maximum,
        "round_trip_rms_density_percent": round_trip_error(image, output_of(resampled), name),
        **({} if options.segments is None else {"segments": count_segments(segments),
                                                   "domains": count_domains(layout) if layout else 0}),
        "seconds": step.seconds,
        "peak_memory_bytes": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "model_bytes": os.path.getsize(path("model.tspline")),
        "threads": vtkSMPTools.GetEstimatedNumberOfThreads(),
        "version": trivariate.__version__,
    }
    with open(path("report.json"), "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    print_table(report)
    say(f"results in {options.output}")


main()
