# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Parameters and hexahedra under 1, 2 and 3 ranks: the same, and a warning that the pieces are
gathered."""
from Ranks import alone, same, says

reference, output = alone("ParametersUnderRanks.py")
fault = says("does not have the point array FrameU", 1)
fault(output)
assert len(reference["Places"]) > 500 and reference["Lengths"].shape == (7, 3)
assert len(reference["HexesCells"]) > 8 * 300 and len(reference["ResampledCells"]) > 8 * 300
same(reference, "ParametersUnderRanks.py",
     lambda output: (fault(output), says("Parameters are found on one process", 1)(output)))
print(len(reference["Places"]), "cells of voxels,", len(reference["HexesCells"]) // 8,
      "hexahedra under 1, 2, 3 ranks")
