# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a script under pvbatch on some ranks and compares what it saved.

The test's arguments are pvbatch and mpiexec; the scripts lie beside this file.
"""
import pathlib
import subprocess
import sys

import numpy


def run(script, ranks, argument, *options):
    """Runs `script` with one argument and returns all that it said."""
    pvbatch, mpiexec = sys.argv[1:3]
    done = subprocess.run(
        [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, *options,
         str(pathlib.Path(__file__).with_name(script)), argument],
        capture_output=True, text=True, timeout=400)
    output = done.stdout + done.stderr
    assert done.returncode == 0, output
    return output


def results(script, ranks):
    """The arrays that rank 0 saved in the file that is the script's argument, and what was said."""
    file = f"ranks{ranks}.npz"
    output = run(script, ranks, file)
    return dict(numpy.load(file)), output


def alone(script, quiet=True):
    """The results of one rank, and what it said: no warning."""
    reference, output = results(script, 1)
    assert not quiet or ("Warning" not in output and "WARN|" not in output), output
    return reference, output


def same(reference, script, check=lambda output: None, lengths_only=()):
    """Asserts that 2 and 3 ranks give the arrays of one; `check` looks at what they say. Of the
    arrays in `lengths_only` only the numbers of entries are the same."""
    for ranks in (2, 3):
        result, output = results(script, ranks)
        check(output)
        assert result.keys() == reference.keys()
        for name, array in reference.items():
            if name in lengths_only:
                assert len(array) == len(result[name]), f"{name} differs under {ranks} ranks"
            else:
                assert numpy.array_equal(array, result[name], equal_nan=array.dtype.kind == "f"), \
                    f"{name} differs under {ranks} ranks"


def says(words, count):
    """A check that the words are there so many times."""
    def check(output):
        assert output.count(words) == count, output
    return check
