# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The report under 1, 2 and 3 ranks: the same numbers, and a warning that pieces are gathered."""
from Ranks import alone, same, says

reference, output = alone("ReportUnderRanks.py", quiet=False)
fault = says('no attribute "RTData" to compare with', 1)
fault(output)
assert "gathered" not in output, output
assert list(reference["Segment"]) == [0, 3, -1] and reference["Voxels"][2] == 20 * 19 * 18
assert (reference["FoundPercent"] == 100.0).all() and reference["RoundTripRMSPercent"][2] < 20.0
assert 200 < len(reference["Points"]) <= 400, len(reference["Points"])


def check(output):
    fault(output)
    assert "The report is made on one process" in output, output


same(reference, "ReportUnderRanks.py", check)
print(len(reference["Points"]), "control points under 1, 2, 3 ranks")
