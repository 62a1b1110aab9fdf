#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Figures 5 and 6 of the paper for its four models, from their volumes to two pictures.

    . BUILD/environment.sh
    python3 Utilities/figures.py FOLDER

FOLDER gets figure5.png (input against reconstruction) and figure6.png (corners, parameters), and all
that they are made of, the splines and domains, which take a few minutes. See figure5.py, figure6.py.
"""
import pathlib
import subprocess
import sys

SPLINES = ["hydrogen_atom=1500:box", "fuel=5000:box", "tooth=15000:box", "ankle_128=16000:box"]
DOMAINS = ["tooth=105+", "ankle_128=40", "fuel=15", "hydrogen_atom=20"]
EDGES = ["4", "6", "2", "2"]  # of the cells of each domain, in voxels
here = pathlib.Path(__file__).resolve().parent


def run(script, *arguments):
    subprocess.run([sys.executable, here / script, *arguments], check=True)


def draw(script, *arguments):
    subprocess.run([here / "with-display.sh", "pvpython", here / script, *arguments], check=True)


def main():
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    run("table1.py", "--save", folder, *SPLINES)
    draw("figure5.py", folder, folder / "figure5.png", *SPLINES)
    run("domains.py", "--save", folder, *DOMAINS)
    draw("figure6.py", folder, folder / "figure6.png",
         *(f"{domain}:{edge}" for domain, edge in zip(DOMAINS, EDGES)))


if __name__ == "__main__":
    main()
