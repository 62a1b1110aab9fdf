# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""From a volume image to a T-spline and back: the job of reconstruct.sh, run by pvbatch."""
import argparse
import json
import math
import os
import resource
import sys
import time

import numpy
from paraview import simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkUnstructuredGrid

import given_domain
import meshes
import picture
import trivariate


DOMAINS = {"box": "Box", "segments": "Segments", "auto": "Automatic"}
RESULTS = ("report.json", "report.csv", "model.tspline", "resampled.vti", "hexes.vtu", "bezier.vtu",
           "segments.vti", "boundary.vtp", "patches.vtp", "domain.vtu", "fields.vti", "hexmesh.vtu",
           "segments.png", "picture.png")


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


def output_of(output):
    """The data behind a filter's proxy, or behind one of its output ports."""
    return output.SMProxy.GetClientSideObject().GetOutputDataObject(output.Port)


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


def copy_of(grid):
    """A source of the grid as it is now, whatever becomes of its file."""
    copy = grid.NewInstance()
    copy.ShallowCopy(grid)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(copy)
    return source


def read_domain(path):
    """The source of cubes and corners: a .json file as given_domain.py describes it, or a grid."""
    if path.endswith(".json"):
        try:
            grid = given_domain.read(path)
        except (OSError, ValueError) as error:
            fail(f"'{path}' is no domain: {error}")
        return copy_of(grid)
    try:
        source = simple.OpenDataFile(path)
    except RuntimeError as error:
        fail(f"ParaView cannot read '{path}': {error}")
    if source is not None:
        source.UpdatePipeline()
    if source is None or not isinstance(output_of(source), vtkUnstructuredGrid):
        fail(f"'{path}' is no domain: it has to be a .json file or an unstructured grid")
    return copy_of(output_of(source))


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


def run(step, what):
    """Updates a filter with progress and with its messages as sentences; ends the job on an error."""
    report_progress(step)
    listen(step)
    step.UpdatePipeline()
    if output_of(step).GetNumberOfPoints() == 0:
        fail(f"{what} failed, as told above")
    return step


def listen(proxy):
    """Tells the warnings and errors of the filter behind the proxy, without their place in VTK."""
    algorithm = proxy.GetClientSideObject()
    told = set()  # a filter that failed runs again when it is asked for its output

    def tell(_, __, text):
        if text not in told:
            told.add(text)
            for line in text.split("): ", 1)[-1].strip().splitlines():
                say("  " + line)

    tell.CallDataType = VTK_STRING
    for event in ("ErrorEvent", "WarningEvent"):
        algorithm.AddObserver(event, tell)
    # The executive only repeats that the filter has failed.
    algorithm.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)


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


def not_empty(proxy, port):
    """An output of a filter, or None if it has no points."""
    output = simple.OutputPort(proxy, port)
    return output if output_of(output).GetNumberOfPoints() > 0 else None


class Segments:
    """What the steps beside the fit make of the volume: each an output of a filter, or None."""
    labelled = surfaces = whole = patches = polycubes = fields = hexahedra = None

    def split(self, source, name, count):
        """Splits the volume into materials, as many as wanted; 0 chooses their number."""
        self.labelled = run(simple.TextureSegmentation(
            Input=source, Scalars=["POINTS", name], NumberOfSegments=count), "the segmentation")

    def bound(self):
        """Makes the surfaces between the segments."""
        self.surfaces = run(simple.SegmentBoundary(Input=self.labelled), "the surface")

    def lay_out(self):
        """Cuts surfaces into patches and finds the cubes that are the segments' domains."""
        self.whole = simple.SegmentTopology(Input=self.labelled)
        layout = simple.PolycubeDomain(Input=simple.SegmentBoundary(Input=self.whole))
        report_progress(layout)
        listen(layout)
        layout.UpdatePipeline()
        self.take_domains(layout, 0, 1)

    def align(self):
        """Finds frames that follow the patches."""
        self.fields = run(simple.FrameField(Input=self.whole, Patches=self.patches), "the frames")

    def fill(self):
        """Fills the segments with hexahedra, in the domains' blocks."""
        hexahedra = simple.HexRemesh(
            Input=self.whole, Patches=self.patches, Polycube=self.polycubes)
        report_progress(hexahedra)
        listen(hexahedra)
        hexahedra.UpdatePipeline()
        self.hexahedra = not_empty(hexahedra, 1)

    def take_domains(self, layout, patches, polycubes):
        self.patches = not_empty(layout, patches)
        self.polycubes = not_empty(layout, polycubes)

    def take(self, reconstruction):
        """Takes what the one step has made on its way."""
        self.labelled = simple.OutputPort(reconstruction, 2)
        self.surfaces = not_empty(reconstruction, 3)
        self.take_domains(reconstruction, 4, 5)
        fields = simple.OutputPort(reconstruction, 6)
        if output_of(fields).GetPointData().HasArray("Parameter"):
            self.fields = fields
        self.hexahedra = not_empty(reconstruction, 7)

    def cubes_among(self, segments):
        """How many cubes the domains of some segments have, those of layers not counted; or None."""
        if not segments:
            return None
        cells = output_of(self.polycubes).GetCellData()
        owners, patches = (vtk_to_numpy(cells.GetArray(name)) for name in ("Segment", "Patch"))
        return int((numpy.isin(owners, segments) & (patches == -1)).sum())

    def quality(self):
        """Of the hexahedra: inverted ones, Jacobians, volume and distance."""
        if self.hexahedra is None:
            return {"mean_scaled_jacobian": None, "inverted_cells_before": None,
                    "inverted_cells_after": None, "hexahedra": None}
        labelled = output_of(self.labelled if self.whole is None else self.whole)
        told = meshes.describe(output_of(self.hexahedra), labelled)
        return {"mean_scaled_jacobian": told["mean_scaled_jacobian"],
                "inverted_cells_before": told["inverted_cells"]["before"],
                "inverted_cells_after": told["inverted_cells"]["after"], "hexahedra": told}

    def save(self, path):
        for name, output in (("segments.vti", self.labelled), ("boundary.vtp", self.surfaces),
                             ("patches.vtp", self.patches), ("domain.vtu", self.polycubes),
                             ("fields.vti", self.fields), ("hexmesh.vtu", self.hexahedra)):
            if output is not None:
                save(path(name), output, DataMode="Binary", CompressorType="ZLib")


def count_cells(model):
    mesh = simple.TSplineSource(Input=model, OutputType="T-Mesh")
    mesh.UpdatePipeline()
    return output_of(mesh).GetNumberOfCells()


def measure(path, source, name, model, rounds, segments):
    """Compares volume and spline, saves the table, and returns its row of all segments and over
    what each segment was fitted."""
    extra = {}
    if segments.patches or segments.surfaces:
        extra["Surfaces"] = segments.patches or segments.surfaces
    report = simple.ReconstructionReport(Input=segments.labelled or source, TSpline=model,
                                         Rounds=rounds, Scalars=["POINTS", name], **extra)
    report.UpdatePipeline()
    table = output_of(report)
    if table.GetNumberOfRows() == 0:
        fail("the report failed, as told above")
    save(path, report, Precision=12, UseScientificNotation=0)
    last = table.GetNumberOfRows() - 1
    columns = [table.GetColumn(i) for i in range(table.GetNumberOfColumns())]
    numbers = {column.GetName(): column.GetTuple1(last)
               for column in columns if column.IsNumeric()}
    domains = {table.GetValueByName(row, "Segment").ToInt():
               table.GetValueByName(row, "Domain").ToString() for row in range(last)}
    return numbers, domains


def whole_or_none(number):
    return None if math.isnan(number) else int(number)


def number_or_none(number):
    return number if math.isfinite(number) else None


def print_table(report, name=""):
    for key, value in report.items():
        label = f"{name} {key}".replace("_", " ").strip()
        if key == "seconds":
            value = f"{sum(value.values()):.1f}"
        elif isinstance(value, dict):
            print_table(value, label)
            continue
        elif isinstance(value, float):
            value = f"{value:.5g}"
        elif isinstance(value, int):
            value = f"{value:,}"
        elif value is None:
            value = "-"
        print(f"  {label:40} {value:>16}", flush=True)


def seconds_by_step(rounds):
    """Where the time of the reconstruction went."""
    field = output_of(rounds).GetFieldData()
    names, seconds = field.GetAbstractArray("Step"), field.GetArray("StepSeconds")
    return {names.GetValue(i): round(seconds.GetValue(i), 3)
            for i in range(names.GetNumberOfValues())}


def tell_remark(rounds):
    """On a choice that is no fault, which therefore no warning tells."""
    remark = output_of(rounds).GetFieldData().GetAbstractArray("Remark")
    if remark:
        say("  " + remark.GetValue(0))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--volume")
    parser.add_argument("--output", required=True)
    parser.add_argument("--array")
    parser.add_argument("--tolerance", type=float)
    parser.add_argument("--control-points", type=int)
    parser.add_argument("--segments", type=int)
    parser.add_argument("--domain", default="auto")
    options = parser.parse_args()
    if options.tolerance is None:
        options.tolerance = 0.0 if options.control_points else 0.1

    vtkSMPTools.SetBackend("STDThread")  # for VTK's own filters and writers too
    step = Stopwatch()

    def path(name):
        return os.path.join(options.output, name)

    results = [path(name) for name in RESULTS if os.path.exists(path(name))]
    if options.volume and any(os.path.samefile(options.volume, old) for old in results):
        fail(f"the volume '{options.volume}' is one of the results that this call replaces; "
             "choose another folder with --output, or move the file")
    source = step("read", read, options.volume)
    name = choose_array(output_of(source), options.array)
    segments = Segments()
    domain = {"Domain": DOMAINS.get(options.domain, "Given")}
    if domain["Domain"] == "Given":
        domain["GivenDomain"] = step("read_domain", read_domain, options.domain)
    fit = simple.TSplineReconstruction(
        Input=source, Scalars=["POINTS", name], NumberOfSegments=options.segments or 0, **domain,
        RMSTolerance=options.tolerance,
        MaximumNumberOfControlPoints=options.control_points or 50000)
    step("fit", run, fit, "the fit")
    tell_remark(simple.OutputPort(fit, 1))
    for old in results:
        os.remove(old)  # not before: with bad input they stay; some may not come anew
    step("write", save, path("model.tspline"), fit)
    model = step("read_back", read_back, path("model.tspline"))
    if options.domain != "box":
        segments.take(fit)
    elif options.segments is not None:
        step("segment", segments.split, source, name, options.segments)
        step("boundary", segments.bound)
    if options.domain == "segments" or options.domain == "box" and segments.labelled:
        step("domain", segments.lay_out)
        if segments.patches:
            step("frames", segments.align)
            step("hexahedra_of_segments", segments.fill)
    resampled = step("resample", lambda: evaluate(path("resampled.vti"), model, "Image",
                                                  Points=segments.labelled or source))
    step("hexahedra", lambda: evaluate(path("hexes.vtu"), model, "Linear Hexahedra"))
    bezier = step("bezier", lambda: evaluate(path("bezier.vtu"), model, "Bezier Hexahedra"))
    measured, fitted_over = step("report", measure, path("report.csv"), source, name, model,
                                 simple.OutputPort(fit, 1), segments)
    if segments.surfaces:
        step("save_segments", segments.save, path)
        step("segments_picture", picture.save_segments, path("segments.png"), segments.labelled,
             segments.surfaces, name)
    step("picture", picture.save, path("picture.png"), source, resampled, model, name)

    polycubes = segments.polycubes and output_of(segments.polycubes).GetCellData()
    report = {
        "voxels": int(measured["Voxels"]),
        "control_points": int(measured["ControlPoints"]),
        "distinct_control_points": int(measured["DistinctControlPoints"]),
        "numbers_stored": int(measured["NumbersStored"]),
        "tmesh_cells": count_cells(model),
        "bezier_cells": output_of(bezier).GetNumberOfCells(),
        "rms_density_percent": number_or_none(measured["RMSPercent"]),
        "psnr_decibels": number_or_none(measured["PSNRDecibels"]),
        "max_error": measured["MaximumErrorPercent"] / 100.0,
        "round_trip_rms_density_percent": measured["RoundTripRMSPercent"],
        "found_percent": measured["FoundPercent"],
        "segments": segments.labelled and 1 + int(
            output_of(segments.labelled).GetPointData().GetArray("Segment").GetRange()[1]),
        "domains": polycubes and len(set(vtk_to_numpy(polycubes.GetArray("Segment")))),
        "fitted_over": fitted_over,
        "blocks": int(measured["Blocks"]),
        "corners": whole_or_none(measured["Corners"]),
        "cubes": segments.cubes_among([segment for segment, domain in fitted_over.items()
                                       if domain in ("Cubes", "LayeredCubes")]),
        "boundary_hausdorff_voxels": number_or_none(measured["HausdorffVoxels"]),
        "gradient_jump_percent": number_or_none(measured["GradientJumpPercent"]),
        "min_scaled_jacobian": number_or_none(measured["MinimumScaledJacobian"]),
        "inverted_cells": whole_or_none(measured["InvertedCells"]),
        **segments.quality(),
        "seconds": step.seconds,
        "seconds_of_fit": seconds_by_step(simple.OutputPort(fit, 1)),
        "peak_memory_bytes": 1024 * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss,
        "model_bytes": os.path.getsize(path("model.tspline")),
        "raw_bytes": int(measured["RawBytes"]),
        "zlib_bytes": int(measured["ZLibBytes"]),
        "label_bytes": int(measured["LabelBytes"]),
        "threads": vtkSMPTools.GetEstimatedNumberOfThreads(),
        "version": trivariate.__version__,
    }
    with open(path("report.json"), "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    print_table(report)
    say(f"results in {options.output}")


main()
