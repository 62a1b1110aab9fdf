# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Parameters under 1 and 2 ranks: the same, and a warning that the pieces are gathered."""
import pathlib
import subprocess
import sys

import numpy

pvbatch, mpiexec = sys.argv[1:3]
script = pathlib.Path(__file__).with_name("ParametersUnderRanks.py")


def run(ranks):
    file = f"parameter_ranks{ranks}.npz"
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(script), file]
    done = subprocess.run(command, capture_output=True, text=True)
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    assert output.count("does not have the point array FrameU") == 1, output
    return dict(numpy.load(file)), output


reference, output = run(1)
assert len(reference["Places"]) > 500 and reference["Lengths"].shape == (7, 3)
result, output = run(2)
assert output.count("Parameters are found on one process") == 1, output
for name, array in reference.items():
    assert numpy.array_equal(array, result[name]), f"{name} differs under 2 ranks"
print(len(reference["Places"]), "cells under 1 and 2 ranks")
