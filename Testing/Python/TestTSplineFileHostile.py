# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Files that are valid HDF5 but no sound T-spline: each gives one error message that says why, an
empty output, and takes neither memory nor time that its size does not justify."""
import resource

import h5py
import numpy as np
from vtkmodules.util.misc import calldata_type
from vtkmodules.vtkCommonCore import VTK_STRING

from trivariate import vtkTSplineReader

N = 4


def write(path, libver="v110", **options):
    """A valid file, not compressed."""
    with h5py.File(path, "w", libver=libver, **options) as file:
        file.attrs["Format"] = np.bytes_("Trivariate T-spline")
        file.attrs["Version"] = np.array([1, 0], "int32")
        for d in "UVW":
            file["KnotLine" + d] = np.array([0.0, 1.0, 2.0])
            file["Knots" + d] = np.array([[0, 0, 0, 1, 2]] * N, "uint8")
        file["Points"], file["Weight"] = np.zeros((N, 3)), np.ones(N)
        file["Segment"] = np.zeros(N, "int32")
        file["Block"] = np.zeros(N, "int32")
        file["Attributes/0"] = np.zeros((N, 2))
        file["Attributes/0"].attrs["Name"] = np.bytes_("velocity")


def read(path):
    """(number of points, errors) of the reader."""
    errors = []

    @calldata_type(VTK_STRING)
    def collect(_caller, _event, text):
        errors.append(text)

    reader = vtkTSplineReader()
    reader.AddObserver("ErrorEvent", collect)
    reader.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)  # repeats that it failed
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput().GetNumberOfPoints(), errors


def replaced(name, **dataset):
    """A change of the file: another dataset in the place of `name`."""
    def change(file):
        del file[name]
        file.create_dataset(name, **dataset)
    return change


def linked(name, link):
    def change(file):
        del file[name]
        file[name] = link
    return change


def attribute(name, value, where="/"):
    def change(file):
        file[where].attrs.pop(name, None)
        if value is not None:
            file[where].attrs[name] = value
    return change


def virtual(file):
    del file["Weight"]
    layout = h5py.VirtualLayout((N,), "float64")
    layout[:] = h5py.VirtualSource("other.h5", "x", (N,))
    file.create_virtual_dataset("Weight", layout)


def compact(file):
    del file["Weight"]
    creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    creation.set_layout(h5py.h5d.COMPACT)
    h5py.h5d.create(file.id, b"Weight", h5py.h5t.IEEE_F64LE, h5py.h5s.create_simple((N,)), creation)


def group(file):
    del file["Weight"]
    file.create_group("Weight")


def many_links(file):
    for i in range(1, 3000):
        file[f"Attributes/{i}"] = file["Attributes/0"]


def knots(row):
    return replaced("KnotsV", data=np.array([row] * N, "uint8"))


CHANGES = [
    ("not a T-spline file", attribute("Format", None)),
    ("not a T-spline file", attribute("Format", np.bytes_("Trivariate"))),
    ("not a T-spline file", attribute("Format", "Trivariate T-spline")),  # of variable length
    ("no valid format version", attribute("Version", None)),
    ("no valid format version", attribute("Version", np.array([1.0, 0.0]))),
    ("no valid format version", attribute("Version", np.array([1], "int32"))),
    ("format version 2.0", attribute("Version", np.array([2, 0], "int32"))),
    ("Weight is a link", linked("Weight", h5py.SoftLink("/Points"))),
    ("Weight is a link", linked("Weight", h5py.ExternalLink("other.h5", "/x"))),
    ("Attributes is a link", linked("Attributes", h5py.SoftLink("/Other"))),
    ("Weight is not stored", virtual),
    ("Weight is not stored", compact),
    ("Weight is not stored", replaced(
        "Weight", shape=(N,), dtype="float64", external=[("other.raw", 0, 8 * N)])),
    ("Weight cannot be opened", group),
    ("Weight has a wrong type", replaced("Weight", data=np.ones(N, "float32"))),
    ("Weight has a wrong type", replaced("Weight", data=np.ones(N, ">f8"))),
    ("Weight has a wrong type", replaced("Weight", data=["a"] * N)),
    ("KnotsU has a wrong type", replaced("KnotsU", data=np.zeros((N, 5), "int8"))),
    ("Segment has a wrong type", replaced("Segment", data=np.zeros(N, "int64"))),
    ("Segment has a wrong shape", replaced("Segment", data=np.zeros(N + 1, "int32"))),
    ("Weight has a wrong shape", replaced("Weight", data=np.float64(1.0))),
    ("Weight has a wrong shape", replaced("Weight", shape=(0,), dtype="float64")),
    ("Weight has a wrong shape", replaced("Weight", data=np.ones((N, 1)))),
    ("Points has a wrong shape", replaced("Points", data=np.zeros((N, 4)))),
    ("KnotsW has a wrong shape", replaced("KnotsW", data=np.zeros((N, 5, 1), "uint8"))),
    ("Attributes/0 has a wrong shape", replaced("Attributes/0", data=np.zeros(N))),
    ("Weight is larger than the file", replaced("Weight", shape=(2 ** 60,), dtype="float64")),
    ("Weight is larger than the file", replaced(
        "Weight", shape=(2 ** 62,), dtype="float64", chunks=(1,), compression="gzip")),
    ("Weight is larger than what is stored", replaced("Weight", shape=(N,), dtype="float64")),
    ("Weight is larger than what is stored", replaced(
        "Weight", shape=(10 ** 5,), dtype="float64", chunks=(1000,), compression="gzip")),
    ("is larger than what is stored", many_links),
    ("chunks of more than a megabyte", replaced(
        "Weight", shape=(N,), maxshape=(None,), chunks=(2 ** 18,), dtype="float64")),
    ("filter other than", replaced("Weight", data=np.ones(N), compression="lzf")),
    ("filter other than", replaced(
        "Segment", data=np.zeros(N, "int32"), chunks=(N,), scaleoffset=2)),
    ("knot line of direction u", replaced("KnotLineU", data=np.array([0.0, 0.0, 1.0]))),
    ("knot line of direction u", replaced("KnotLineU", data=np.array([0.0, np.nan, 1.0]))),
    ("knot line of direction u", replaced("KnotLineU", data=np.array([0.0]))),
    ("local knot vector in direction v", knots([0, 0, 0, 1, 3])),
    ("local knot vector in direction v", knots([0, 0, 2, 1, 2])),
    ("local knot vector in direction v", knots([1, 1, 1, 1, 1])),
    ("local knot vector in direction w", replaced(
        "KnotsW", data=np.array([[0, 0, 0, 1, 2 ** 32 - 1]] * N, "uint32"))),
    ("weight", replaced("Weight", data=np.array([1.0, 1.0, 0.0, 1.0]))),
    ("weight", replaced("Weight", data=np.array([1.0, 1.0, np.inf, 1.0]))),
    ("not finite", replaced("Points", data=np.full((N, 3), np.nan))),
    ("An attribute has no name", attribute("Name", None, "Attributes/0")),
    ("An attribute has no name", attribute("Name", "of variable length", "Attributes/0")),
    ("\"Weight\" is taken", attribute("Name", np.bytes_("Weight"), "Attributes/0")),
]
CHANGES += [(name + " is missing", lambda file, name=name: file.pop(name)) for name in (
    "KnotLineU", "KnotLineV", "KnotLineW", "KnotsU", "KnotsV", "KnotsW", "Points", "Weight",
    "Segment", "Block")]

write("good.tspline")
assert read("good.tspline") == (N, [])

# A newer minor version may bring objects that this one does not know.
with h5py.File("good.tspline", "a") as newer:
    newer.attrs["Version"] = np.array([1, 7], "int32")
    newer["Other/Thing"] = np.zeros(3)
assert read("good.tspline") == (N, [])

for wanted, change in CHANGES:
    write("bad.tspline")
    with h5py.File("bad.tspline", "a", libver="v110") as bad:
        change(bad)
    points, errors = read("bad.tspline")
    assert points == 0 and len(errors) == 1 and wanted in errors[0], (wanted, points, errors)

for options, wanted in (({"libver": "earliest"}, "without checksums"),
                        ({"userblock_size": 512}, "no HDF5 file")):
    write("bad.tspline", **options)
    points, errors = read("bad.tspline")
    assert points == 0 and len(errors) == 1 and wanted in errors[0], (wanted, errors)

assert vtkTSplineReader.CanReadFile("good.tspline") == 1
write("bad.tspline")
with h5py.File("bad.tspline", "a") as bad:
    bad.attrs["Format"] = np.bytes_("Something else")
assert vtkTSplineReader.CanReadFile("bad.tspline") == 0

peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024
assert peak < 600, f"{peak} MiB were used"
print(len(CHANGES), "files refused")
