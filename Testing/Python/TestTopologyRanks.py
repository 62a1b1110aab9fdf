# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Segment Topology under 1, 2 and 3 ranks: the same labels."""
import pathlib
import subprocess
import sys

import numpy

pvbatch, mpiexec = sys.argv[1:3]
script = pathlib.Path(__file__).with_name("TopologyUnderRanks.py")


def run(ranks):
    file = f"ranks{ranks}.npz"
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(script), file]
    done = subprocess.run(command, capture_output=True, text=True, timeout=200)
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    assert output.count("no segment 9") == 1, output
    return dict(numpy.load(file)), output


reference, output = run(1)
assert "gathered" not in output, output
for ranks in (2, 3):
    result, output = run(ranks)
    assert "Handles are a matter of the whole" in output, output
    for name, array in reference.items():
        assert numpy.array_equal(array, result[name]), f"{name} differs under {ranks} ranks"
print(len(reference["Points"]), "points under 1, 2, 3 ranks")
