# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Writes small T-spline files in every accepted kind of storage, for the fuzzer to start from.

usage: make_seeds.py FOLDER"""
import pathlib
import sys

import h5py
import numpy as np

STORAGES = {
    "contiguous": {},
    "chunked": {"chunks": True},
    "packed": {"chunks": True, "shuffle": True, "compression": "gzip", "fletcher32": True},
}


def write(path, libver, points, attributes, storage):
    with h5py.File(path, "w", libver=libver) as file:
        file.attrs["Format"] = np.bytes_("Trivariate T-spline")
        file.attrs["Version"] = np.array([1, 0], "<i4")
        file.attrs["RootCells"] = np.array([1, 1, 1], "<i4")
        datasets = {
            "Points": np.arange(3.0 * points).reshape(points, 3),
            "Weight": np.ones(points),
            "Segment": np.zeros(points, "<i4"),
            "Block": np.zeros(points, "<i4"),
        }
        for axis in "UVW":
            datasets["KnotLine" + axis] = np.array([0.0, 1.0, 2.0])
            datasets["Knots" + axis] = np.array([[0, 0, 0, 1, 2]] * points, "u1")
        for i in range(attributes):
            datasets[f"Attributes/{i}"] = np.zeros((points, i + 1))
        for name, data in datasets.items():
            file.create_dataset(name, data=data, **storage)
        for i in range(attributes):
            file[f"Attributes/{i}"].attrs["Name"] = np.bytes_(f"attribute{i}")


folder = pathlib.Path(sys.argv[1])
folder.mkdir(parents=True, exist_ok=True)
for name, storage in STORAGES.items():
    for points in (1, 3):
        write(folder / f"{name}-{points}.tspline", "v110", points, points, storage)
write(folder / "old.tspline", "earliest", 1, 1, {})
