# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Surfaces under 1, 2 and 3 ranks: the same, and a warning that the pieces are gathered."""
from Ranks import alone, same, says

reference, output = alone("BoundaryUnderRanks.py")
fault = says("no segment 9", 1)
fault(output)
assert {tuple(pair) for pair in reference["BoundaryLabels"]} == {(1, 0), (1, 2), (1, -1), (2, -1)}
same(reference, "BoundaryUnderRanks.py",
     lambda output: (fault(output), says("gathered to process 0", 2)(output)))  # of two updates
print(len(reference["Points"]), "points under 1, 2, 3 ranks")
