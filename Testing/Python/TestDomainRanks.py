# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Domains under 1, 2 and 3 ranks: the same, and a warning that the pieces are gathered."""
import pathlib
import subprocess
import sys

import numpy

pvbatch, mpiexec = sys.argv[1:3]
script = pathlib.Path(__file__).with_name("DomainUnderRanks.py")


def run(ranks):
    file = f"ranks{ranks}.npz"
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(script), file]
    done = subprocess.run(command, capture_output=True, text=True)
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    assert output.count("Segment 9: There is none such") == 1, output
    return dict(numpy.load(file)), output


reference, output = run(1)
assert "Warning" not in output and "WARN|" not in output, output
assert len(reference["Block1"]) == 13 and len(reference["SphereCorners"]) == 16
for ranks in (2, 3):
    result, output = run(ranks)
    assert output.count("Domains are made on one process") == 3, output  # of three updates
    assert result.keys() == reference.keys()
    for name, array in reference.items():
        if name == "SphereCorners":  # pieces of the sphere: other numbers of points
            assert len(result[name]) == 16
        else:
            assert numpy.array_equal(array, result[name]), f"{name} differs under {ranks} ranks"
print(len(reference["Points0"]), "points under 1, 2, 3 ranks")
