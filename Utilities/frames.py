# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frame fields of real segments: the tables of Documentation/Results.md, and pictures.

    . BUILD/environment.sh
    Utilities/with-display.sh pvpython Utilities/frames.py [--picture FILE.png] [VOLUME=THRESHOLD ...]

With --picture no table, but the default's frames of all volumes in one picture, and what is said of
them. A segment is what lies above a threshold, made whole, with its surface as it comes without
density, whose half-way level is another than the threshold. The volumes are the .vti files of
TRIVARIATE_DATA_DIR (default: ../shared/data).

Energies are sums over neighbours, those of the default in full, the others in parts of it, with the
sweeps over the voxels that they took. Two of them. Of crosses: the squared distance as spherical
harmonics, 5/3 (3 - sum R_kl^4), which no exchange of axes changes. Of labelled frames: 20/3
(3 - tr R), the same where frames are close, which tells u from v and w. Neighbours are parted by a
jump where another axis of one is the closest to u, v or w of the other. Before labelled frames are
measured, each cross gets the labels that bring it closest to the default's frame at its voxel.
"""
import argparse
import itertools
import os
import pathlib
import tempfile
import time

import numpy
from paraview import simple
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy

import picture
import views

RUNS = ["hydrogen_atom=20", "fuel=15", "tooth=105", "ankle_128=40", "walnut=5000"]
root = pathlib.Path(__file__).resolve().parent.parent
data = pathlib.Path(os.environ.get("TRIVARIATE_DATA_DIR", root.parent / "shared" / "data"))

# On the voxels alone, until a sweep gains less than 1e-5: the paper's with and without jumps, and the
# best known for crosses.
CONVERGED = dict(CoarseToFine=0, Relaxed=0, Sweeps=2000, EnergyDrop=1e-5)
WAYS = {"default": {},
        "no jumps": dict(Step="Registration", Start="Principal Axes", **CONVERGED),
        "jumps": dict(Step="Registration With Jumps", Start="Principal Axes", **CONVERGED),
        "linear + quartic": dict(Step="Quartic", Start="Linear", **CONVERGED),
        "harmonic start": dict(Start="Harmonic Coordinates")}


def cube_rotations():
    """The 24 rotations of the cube: 24 x 3 x 3."""
    signed = [numpy.eye(3)[list(order)] * numpy.array(signs)[:, None]
              for order in itertools.permutations(range(3))
              for signs in itertools.product((1.0, -1.0), repeat=3)]
    return numpy.array([s for s in signed if numpy.linalg.det(s) > 0.0])


CUBE = cube_rotations()


def closest(frames, others):
    """For each frame which of the cube's rotations brings it closest to the other one."""
    between = (others @ frames.transpose(0, 2, 1)).reshape(-1, 9)
    return numpy.argmax(between @ CUBE.reshape(24, 9).T, axis=1)


class Field:
    """A field of frames, and what the filter says of it."""

    def __init__(self, source):
        start = time.process_time()
        source.UpdatePipeline()
        self.source = source
        self.cpu = time.process_time() - start
        algorithm = source.GetClientSideObject()
        image, table = algorithm.GetOutputDataObject(0), algorithm.GetOutputDataObject(2)
        self.voxels, self.energy, self.error, self.singular = (
            image.GetFieldData().GetArray("Frame" + name).GetComponent(0, 0)
            for name in ("Voxels", "Energy", "AlignmentError", "SingularPlaquettes"))
        self.sweeps = table.GetValueByName(table.GetNumberOfRows() - 1, "Sweep").ToInt()
        rows = [vtk_to_numpy(image.GetPointData().GetArray("Frame" + axis)) for axis in "UVW"]
        self.inside = numpy.flatnonzero(numpy.any(rows[0] != 0.0, axis=1))
        self.frames = numpy.stack(rows, axis=1)[self.inside].astype(float)
        self.size = image.GetDimensions()

    def print_default(self, volume, bounds):
        print(f"{volume}, {bounds}: {self.voxels:,.0f} voxels, energy of crosses "
              f"{self.energy:,.0f} ({self.sweeps} sweeps), {self.singular:.0f} singular plaquettes, "
              f"alignment {self.error:.1g} degrees, {self.cpu:.1f} CPU s", flush=True)

    def name_after(self, other):
        self.frames = CUBE[closest(self.frames, other.frames)] @ self.frames

    def measure_labels(self):
        """The energy of labelled frames, and the share of neighbours that are parted by a jump."""
        number = numpy.full(numpy.prod(self.size), -1)
        number[self.inside] = numpy.arange(len(self.inside))
        grid = number.reshape(self.size[::-1])
        energy = crosses = jumps = pairs = 0
        for axis in range(3):
            low, high = (numpy.delete(grid, end, axis).ravel() for end in (-1, 0))
            both = (low >= 0) & (high >= 0)
            a, b = self.frames[low[both]], self.frames[high[both]]
            between = a @ b.transpose(0, 2, 1)
            energy += 20.0 / 3.0 * (3.0 - numpy.trace(between, axis1=1, axis2=2)).sum()
            crosses += 5.0 / 3.0 * (3.0 - (between**4).sum((1, 2))).sum()
            jumps += numpy.count_nonzero(numpy.abs(CUBE[closest(a, b)] - numpy.eye(3)).sum((1, 2)))
            pairs += len(a)
        # The filter's, where voxels are cubes.
        assert abs(crosses - self.energy) < 1e-4 * self.energy
        return energy, jumps / pairs


def parts(fields, energies):
    """Cells of a row: the first energy and its sweeps, the others in parts of it."""
    return [f"{energies[0]:,.0f} ({fields[0].sweeps})",
            *(f"{energy / energies[0]:.4f} ({field.sweeps})"
              for field, energy in zip(fields[1:], energies[1:]))]


def print_rows(head, rows):
    for name, cells in rows.items():
        print(f"| {head} | {name} | " + " | ".join(cells) + " |", flush=True)
        head = " | ".join([" "] * (head.count("|") + 1))


def segment_of(volume, threshold):
    """Labels, surface and patches."""
    source = simple.OpenDataFile(str(data / f"{volume}.vti"))
    source.UpdatePipeline()
    name = source.PointData[0].GetName()
    labels = simple.Calculator(Input=source, ResultArrayName="Segment",
                               Function=f"if({name} > {threshold}, 1, 0)")
    whole = simple.SegmentTopology(Input=labels)
    surface = simple.SegmentBoundary(Input=whole, UseDensity=0)
    domain = simple.PolycubeDomain(Input=surface)
    domain.UpdatePipeline()
    return whole, surface, simple.OutputPort(domain, 0)


def print_table(volume, threshold):
    whole, surface, patches = segment_of(volume, threshold)

    def fields(bounds, ways):
        return [Field(simple.FrameField(Input=whole, Patches=bounds, **WAYS[way])) for way in ways]
    aligned = fields(patches, WAYS)
    unaligned = fields(surface, list(WAYS)[:4])
    for field in aligned[2:4]:
        field.name_after(aligned[0])
    energies, jumps = zip(*(field.measure_labels() for field in aligned))
    head = f"{volume} > {threshold} | {aligned[0].voxels:,.0f}"
    print_rows(head + " | patches", {
        "labelled frames": parts(aligned, energies),
        "crosses": parts(aligned, [field.energy for field in aligned]),
        "neighbours parted": [f"{100.0 * share:.2f} %" for share in jumps],
        "singular plaquettes": [f"{field.singular:.0f}" for field in aligned]})
    print_rows(head + " | surface", {
        "crosses": parts(unaligned, [field.energy for field in unaligned]) + ["-"],
        "singular plaquettes": [f"{field.singular:.0f}" for field in unaligned] + ["-"]})
    aligned[0].print_default(volume, "patches")
    unaligned[0].print_default(volume, "surface")


def draw_row(volume, threshold, file):
    whole, surface, patches = segment_of(volume, threshold)
    fields = [simple.FrameField(Input=whole, Patches=bounds) for bounds in (patches, surface)]
    for bounds, field in zip(("patches", "surface"), map(Field, fields)):
        field.print_default(volume, bounds)
    picture.save_frames(file, volume, *fields)


def paste(files, width, path):
    """Beneath each other."""
    rows = []
    for file in files:
        with Image.open(file) as row:
            height = row.height * width // row.width
            rows.append(row.convert("RGB").resize((width, height), Image.LANCZOS))
    whole = Image.new("RGB", (width, sum(row.height for row in rows)), "white")
    top = 0
    for row in rows:
        whole.paste(row, (0, top))
        top += row.height
    views.save_small(whole, path)


parser = argparse.ArgumentParser(description=__doc__,
                                 formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--picture", metavar="FILE.png")
parser.add_argument("runs", nargs="*", metavar="VOLUME=THRESHOLD", default=RUNS)
arguments = parser.parse_args()
runs = [argument.split("=") for argument in arguments.runs]
if arguments.picture:
    with tempfile.TemporaryDirectory() as folder:
        files = [os.path.join(folder, f"{volume}.png") for volume, _ in runs]
        for (volume, threshold), file in zip(runs, files):
            draw_row(volume, threshold, file)
            simple.ResetSession()
        paste(files, 1050, arguments.picture)
else:
    print("| segment | voxels | bound by | measured | " + " | ".join(WAYS) + " |")
    print("|---" * 9 + "|", flush=True)
    for volume, threshold in runs:
        print_table(volume, threshold)
        simple.ResetSession()
