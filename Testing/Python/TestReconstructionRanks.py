# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The reconstruction under 1, 2 and 3 ranks: the same T-spline, bit by bit, and errors told."""
from Ranks import alone, same

reference, output = alone("ReconstructionUnderRanks.py", quiet=False)


def fault(said):
    assert 'no point array "absent" to fit' in said, said


fault(output)
assert 700 < len(reference["BoxPoints"]) <= 1500, len(reference["BoxPoints"])
assert set(reference["AutomaticSegment"]) == {0, 1}
assert len(reference["Patches"]) > 100 and len(reference["Cubes"]) >= 8
assert len(reference["Hexahedra"]) > 100
same(reference, "ReconstructionUnderRanks.py", fault)
print(len(reference["AutomaticPoints"]), "control points under 1, 2, 3 ranks")
