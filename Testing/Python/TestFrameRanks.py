# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Frames under 1, 2 and 3 ranks: the same, and a warning that the pieces are gathered."""
import pathlib
import subprocess
import sys

import numpy

pvbatch, mpiexec = sys.argv[1:3]
script = pathlib.Path(__file__).with_name("FramesUnderRanks.py")


def run(ranks):
    file = f"ranks{ranks}.npz"
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(script), file]
    done = subprocess.run(command, capture_output=True, text=True)
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    assert output.count("There is no segment 9") == 1, output
    return dict(numpy.load(file)), output


reference, output = run(1)
assert "Warning" not in output and "WARN|" not in output, output
assert len(reference["AlignedFrames"]) > 9000 and len(reference["AlignedGraph"]) == 0
assert len(reference["UnalignedGraph"]) > 20
for ranks in (2, 3):
    result, output = run(ranks)
    assert output.count("Frames are made on one process") == 3, output  # of three updates
    assert result.keys() == reference.keys()
    for name, array in reference.items():
        assert numpy.array_equal(array, result[name]), f"{name} differs under {ranks} ranks"
print(len(reference["AlignedFrames"]), "lines under 1, 2, 3 ranks")
