# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The segmentation under 1, 2 and 3 ranks: every point has the same label and attributes."""
import numpy

import Ranks


def run(ranks):
    output = Ranks.run("SegmentationUnderRanks.py", ranks, f"of{ranks}", "--symmetric")
    assert output.count("choose a smaller radius") == 1, output
    assert output.count('no texture attribute "Roughness"') == 1, output
    return [dict(numpy.load(f"of{ranks}-{rank}.npz")) for rank in range(ranks)]


def grid(piece, name):
    x0, x1, y0, y1, z0, z1 = piece["extent"]
    return piece[name].reshape(z1 - z0 + 1, y1 - y0 + 1, x1 - x0 + 1)


(whole,) = run(1)
x0, _, y0, _, z0, _ = whole["extent"]
counts = numpy.bincount(whole["point Segment"])
assert len(counts) == 2 and counts.min() > 0.2 * counts.sum(), counts
assert "point Contrast" in whole and "point MaximalCorrelationCoefficient" not in whole
for ranks in (2, 3):
    pieces = run(ranks)
    covered = numpy.zeros(grid(whole, "point Segment").shape, int)
    for piece in pieces:
        assert piece.keys() == whole.keys()
        a0, a1, b0, b1, c0, c1 = piece["extent"]
        part = (slice(c0 - z0, c1 - z0 + 1), slice(b0 - y0, b1 - y0 + 1), slice(a0 - x0, a1 - x0 + 1))
        covered[part] += 1
        for name, array in whole.items():
            if name.startswith("point"):
                assert numpy.array_equal(grid(piece, name), grid(whole, name)[part]), name
            elif name.startswith("field"):
                assert numpy.array_equal(piece[name], array), name
    # Neighbouring pieces share a layer of points, no more.
    assert covered.min() == 1 and (covered > 1).sum() < 0.2 * covered.size
print(counts, "points a segment under 1, 2, 3 ranks")
