# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The fit under 1, 2 and 3 ranks: the same bytes, and one warning that the pieces are gathered."""
from Ranks import alone, same, says

reference, output = alone("FitUnderRanks.py")
fault = says('no point array "absent"', 1)
fault(output)
assert 500 < len(reference["RTData"]) <= 600 and reference["RMS"][-1] < reference["RMS"][0]
same(reference, "FitUnderRanks.py",
     lambda output: (fault(output), says("gathered to process 0", 1)(output)))
print(len(reference["RTData"]), "control points, RMS", reference["RMS"][-1], "under 1, 2, 3 ranks")
