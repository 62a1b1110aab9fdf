# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""A rank that runs out of memory while pieces are brought together says so, once, and no other one
waits for it, nor for one that is stopped."""
from Ranks import run

for case in ("fit,0,60", "fit,1,10", "boundary,0,60", "boundary,1,10", "segmentation,1,100",
             "segmentation,1,0.3"):
    output = run("StarvedRanks.py", 2, case, "--symmetric")
    assert output.count("went on with 0 points") == 2, (case, output)
    assert output.count("Out of memory") == (0 if case.endswith(".3") else 1), (case, output)
    print(case, "ends on both ranks")
