# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames under 1, 2 and 3 ranks: the same, and a warning that the pieces are gathered."""
from Ranks import alone, same, says

reference, output = alone("FramesUnderRanks.py")
fault = says("There is no segment 9", 1)
fault(output)
assert len(reference["AlignedFrames"]) > 9000 and len(reference["AlignedGraph"]) == 0
assert len(reference["UnalignedGraph"]) > 20
same(reference, "FramesUnderRanks.py",
     lambda output: (fault(output), says("Frames are made on one process", 3)(output)))
print(len(reference["AlignedFrames"]), "lines under 1, 2, 3 ranks")
