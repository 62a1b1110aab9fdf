# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""The install tree serves another CMake project, Python and ParaView, and only from within itself.

Arguments: cmake, source tree, build tree, name of the library folder, folder of the Python package
and of the plugins in it, plain Python, pvpython (or nothing).
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys

cmake, source, build, lib, python_dir, plugin_dir, python = sys.argv[1:8]
pvpython = sys.argv[8] if len(sys.argv) > 8 else None
prefix = pathlib.Path("install").absolute()
# Nothing of the build tree may help.
clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PV_PLUGIN_PATH")}


def run(*command, **variables):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True,
                          env={**clean, **variables})
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"
    return done.stdout


def check_libraries(file):
    """All libraries are found, ours in the install tree, and returns their names."""
    table = run("ldd", file)
    assert "not found" not in table, f"{file}\n{table}"
    for line in table.splitlines():
        if "Trivariate" in line:
            assert str(prefix) in line, f"{file}: {line}"
    return re.findall(r"^\s*(lib\S+)", table, re.MULTILINE)


def test_cmake_project():
    shutil.rmtree("consumer", ignore_errors=True)
    run(cmake, "-S", pathlib.Path(source) / "Examples" / "Consumer", "-B", "consumer",
        f"-DCMAKE_PREFIX_PATH={prefix}")
    run(cmake, "--build", "consumer")
    needed = check_libraries("consumer/volume")
    assert any(name.startswith("libvtkTrivariateFilters") for name in needed), needed
    alien = [name for name in needed if re.match(r"lib(vtkPV|vtkRemoting|pq)", name)]
    assert not alien, alien
    for arguments in ([], ["model.tspline"]):
        words = run("consumer/volume", *arguments).split()
        assert 300 < int(words[0]) <= 1000, words
        assert abs(float(words[-1]) - 80.0**3) < 1e-5 * 80.0**3, words


def test_python():
    where = prefix / python_dir
    for module in (where / "trivariate").glob("*.so"):
        check_libraries(module)
    for interpreter in filter(None, (python, pvpython)):
        text = run(interpreter, "-c", "import trivariate; print(trivariate.__file__);"
                   "print(trivariate.vtkTSplineFit().GetMaximumNumberOfControlPoints())",
                   PYTHONPATH=str(where))
        assert str(prefix) in text and "50000" in text, text


def test_plugin():
    where = prefix / plugin_dir
    check_libraries(where / "Trivariate" / "Trivariate.so")
    text = run(pvpython, "-c", "from paraview import simple;"
               "print(simple.TSplineFit(Input=simple.Wavelet()).MaximumNumberOfControlPoints)",
               PV_PLUGIN_PATH=str(where))
    assert "50000" in text, text


shutil.rmtree(prefix, ignore_errors=True)
run(cmake, "--install", build, "--prefix", prefix)
for library in (prefix / lib).glob("*.so"):
    check_libraries(library)
test_cmake_project()
test_python()
if pvpython:
    test_plugin()
