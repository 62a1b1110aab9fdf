# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Segment Topology under 1, 2 and 3 ranks: the same labels."""
from Ranks import alone, same, says

reference, output = alone("TopologyUnderRanks.py", quiet=False)
fault = says("no segment 9", 1)
fault(output)
assert "gathered" not in output, output


def check(output):
    fault(output)
    assert "Handles are a matter of the whole" in output, output


same(reference, "TopologyUnderRanks.py", check)
print(len(reference["Points"]), "points under 1, 2, 3 ranks")
