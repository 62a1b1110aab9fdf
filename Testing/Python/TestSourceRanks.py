# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Orbital and T-spline source under 1, 2 and 3 ranks: the same bytes. What is made where the spline
is lies on rank 0, values at points and the orbital on the rank that has the points."""
import numpy

import Ranks

SPREAD = ["Points", "Orbital"]
GATHERED = ["Image", "Labelled Image", "Linear Hexahedra", "Bezier Hexahedra",
            "Iso-Parametric Surfaces", "T-Mesh"]


def run(ranks):
    Ranks.run("SourceUnderRanks.py", ranks, f"ranks{ranks}", "--symmetric")
    return {name: [dict(numpy.load(f"ranks{ranks}-{name}-{rank}.npz")) for rank in range(ranks)]
            for name in GATHERED + SPREAD}


def by_place(part, array):
    return dict(zip(map(tuple, part["places"]), array))


whole = run(1)
assert all(whole[name][0]["count"][0] > 100 for name in whole)
found = whole["Labelled Image"][0]["point vtkValidPointMask"]
assert 0 < found.sum() < len(found), "the labels say where the spline stands"
for ranks in (2, 3):
    parts = run(ranks)
    for name in GATHERED:
        expected = whole[name][0]
        assert parts[name][0].keys() == expected.keys(), name
        for array in expected:
            assert numpy.array_equal(parts[name][0][array], expected[array]), (ranks, name, array)
        assert all(part["count"][0] == 0 for part in parts[name][1:]), (ranks, name)
    for name in SPREAD:
        expected = whole[name][0]
        arrays = [a for a in expected if a.startswith("point ") and a != "point vtkGhostType"]
        assert len(arrays) >= (4 if name == "Points" else 1)
        places = set()
        for part in parts[name]:
            assert 0 < part["count"][0] < expected["count"][0], (ranks, name)
            places.update(map(tuple, part["places"]))
            for array in arrays:
                reference = by_place(expected, expected[array])
                for place, value in by_place(part, part[array]).items():
                    assert numpy.array_equal(value, reference[place]), (ranks, name, array, place)
        assert len(places) == expected["count"][0], (ranks, name)
print({name: int(part[0]["count"][0]) for name, part in whole.items()}, "points, 1 to 3 ranks")
