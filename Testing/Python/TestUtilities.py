# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Most of the scripts that make the tables and figures of Documentation/Results.md run on tiny
volumes, so that a column or a field that gets another name is missed here first."""
import os
import pathlib
import shutil
import subprocess
import sys

from vtkmodules.vtkIOXML import vtkXMLImageDataWriter
from vtkmodules.vtkImagingSources import vtkImageGaussianSource

from trivariate import vtkHydrogenOrbitalSource

root = pathlib.Path(sys.argv[1])
utilities = root / "Utilities"
os.environ["TRIVARIATE_DATA_DIR"] = "data"


def make_data():
    """Volumes by the names of some that the figures know how to look at: an orbital, and a ball."""
    orbital = vtkHydrogenOrbitalSource()
    orbital.SetDimensions(16, 16, 16)
    ball = vtkImageGaussianSource()
    ball.SetWholeExtent(0, 23, 0, 19, 0, 19)
    ball.SetCenter(11.5, 9.5, 9.5)
    ball.SetMaximum(40.0)
    ball.SetStandardDeviation(6.4)
    os.makedirs("data", exist_ok=True)
    for volume, source in (("fuel", orbital), ("hydrogen_atom", ball)):
        writer = vtkXMLImageDataWriter()
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(f"data/{volume}.vti")
        writer.SetDataModeToBinary()  # appended data do not read back
        writer.Write()


def run(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    assert done.returncode == 0 and "Traceback" not in done.stderr, done.stdout + done.stderr
    return done.stdout


def check_table(text, rows):
    """As many rows, each with a cell for each column; returns them."""
    lines = [line.strip("| \n").split("|") for line in text.splitlines() if line.startswith("|")]
    print(text)
    assert len(lines) == 2 + rows, text
    assert all(len(line) == len(lines[0]) for line in lines), text
    return [[cell.strip() for cell in line] for line in lines[2:]]


def test_table1():
    text = run(sys.executable, utilities / "table1.py", "--save", "saved", "fuel=200:box",
               "orbital_16=200:segments")
    rows = check_table(text, 2)
    assert [row[:3] for row in rows] == [["fuel", "box", "4,096"], ["orbital_16", "segments", "4,096"]]
    assert 64 <= int(rows[0][5]) <= 200 and int(rows[0][6]) == int(rows[0][5]) + 12, rows
    assert float(rows[0][3]) == float(rows[0][7]) and rows[0][8] == "100.00", rows
    assert "boxes" in rows[0][14] and "segments" in rows[1][14], rows


def test_figure5():
    picture = pathlib.Path("figure5.png")
    picture.unlink(missing_ok=True)
    run(utilities / "with-display.sh", "pvpython", utilities / "figure5.py", "saved", picture,
        "fuel=200:box")
    assert picture.stat().st_size > 10000


def test_figures():
    """The lists that it hands on fit together, and to the tables of the scripts that it runs."""
    sys.path.insert(0, str(utilities))
    import figures
    import table1
    assert len(figures.DOMAINS) == len(figures.EDGES)
    assert all(run.split(":")[1] in table1.DOMAINS for run in figures.SPLINES)
    assert callable(figures.main)


def test_fits():
    shutil.rmtree("fitted", ignore_errors=True)
    os.makedirs("fitted")
    rows = check_table(run(sys.executable, utilities / "fits.py", "--baselines", "fitted",
                           "ball=0/cube:8:150"), 1)
    points, shape, numbers = (int(cell.replace(",", "")) for cell in rows[0][1:4])
    assert shape < points <= 150 and numbers == 3 * shape + points, rows


def draw(script, *arguments):
    picture = pathlib.Path(script).with_suffix(".png")
    picture.unlink(missing_ok=True)
    folder, *runs = arguments
    run(utilities / "with-display.sh", "pvpython", utilities / script, folder, picture, *runs)
    assert picture.stat().st_size > 2000, script


def test_domains():
    """Domains, parameters and hexahedra of the ball, and their pictures."""
    shutil.rmtree("domains", ignore_errors=True)
    os.makedirs("domains")
    ball = "hydrogen_atom=20"
    rows = check_table(run(sys.executable, utilities / "domains.py", "--save", "domains", ball), 1)
    assert rows[0][2:6] == ["8", "1", "7", "0"], rows
    rows = check_table(run(sys.executable, utilities / "parameters.py", "domains", ball), 1)
    assert float(rows[0][2].split(",")[0]) < 0.01 and rows[0][4].startswith("0 of "), rows
    rows = check_table(run(sys.executable, utilities / "hexes.py", "domains", ball + ":2"), 1)
    assert rows[0][3].endswith(", then 0") and abs(float(rows[0][6].rstrip(" %"))) < 0.5, rows
    draw("domains_picture.py", "domains", ball)
    draw("figure6.py", "domains", ball + ":2")
    draw("hexes_picture.py", "domains/hydrogen_atom_20_hexes.vtu")


def test_results():
    rows = check_table(run(sys.executable, utilities / "results.py", "results", "fuel=200"), 1)
    assert rows[0][:2] == ["fuel", "4,096"] and 64 <= int(rows[0][2]) <= 200, rows


make_data()
test_table1()
test_figure5()
test_figures()
test_fits()
test_domains()
test_results()
