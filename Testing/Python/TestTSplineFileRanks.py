# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Save Data and Open of .tspline files under 1, 2 and 3 ranks: the same bytes, nothing lost."""
import pathlib
import subprocess
import sys

pvbatch, mpiexec = sys.argv[1:3]
script = pathlib.Path(__file__).with_name("FileUnderRanks.py")
for ranks in (1, 2, 3):
    command = [mpiexec, "--oversubscribe", "-n", str(ranks), pvbatch, str(script), str(ranks)]
    done = subprocess.run(command, capture_output=True, text=True)
    output = done.stdout + done.stderr
    assert done.returncode == 0 and "saved" in output, output
    assert "ERR|" not in output, output
    whole = pathlib.Path(f"fit{ranks}.tspline").read_bytes()
    assert whole == pathlib.Path("fit1.tspline").read_bytes(), f"another file from {ranks} ranks"
assert not list(pathlib.Path().glob("*.part"))
print(len(whole), "bytes under 1, 2, 3 ranks")
