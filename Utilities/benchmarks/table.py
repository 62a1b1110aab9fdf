#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and prints a Markdown table, the machine and its load above it.

    Utilities/benchmarks/table.py BUILD/bin/TrivariateBenchmarks [--benchmark_filter=Lattice ...]

All further arguments go to the benchmarks. With --benchmark_repetitions=n the medians are shown.
"""
import json
import os
import subprocess
import sys

RULES = {"0": "compact", "1": "analysis-suitable", "2": "uniform"}


def run(command):
    """The benchmarks' own report, as a dictionary."""
    result = subprocess.run(command + ["--benchmark_format=json"], check=True,
                            stdout=subprocess.PIPE, text=True)
    return json.loads(result.stdout)


def arguments(name):
    """'Lattice/rule:2/control_points:5000' -> ('Lattice', {'rule': '2', ...})."""
    parts = name.split("/")
    return parts[0], dict(part.split(":") for part in parts[1:] if ":" in part)


# Columns: the head, where the value is (an argument or a result), how it is printed.
COLUMNS = [
    ("rule", "rule", lambda value: RULES[value]),
    ("voxels", "voxels", lambda value: f"{value}^3"),
    ("derivatives", "derivatives", str),
    ("control points", "control_points", lambda value: f"{float(value):,.0f}"),
    ("cells", "cells", lambda value: f"{value:,.0f}"),
    ("ms", "real_time", lambda value: f"{value:.4g}"),
    ("million items/s", "items_per_second", lambda value: f"{value * 1e-6:.3g}"),
    ("MB", "megabytes", lambda value: f"{value:.0f}"),
    ("RMS x 100", "rms_percent", lambda value: f"{value:.3g}"),
    ("maximum error", "maximum_error", lambda value: f"{value:.2g}"),
]


def table(benchmarks):
    """Rows of the columns that any of the benchmarks has something for; the first row is heads."""
    rows = []
    for benchmark in benchmarks:
        kind, given = arguments(benchmark.get("run_name", benchmark["name"]))
        rows.append((kind, {**given, **benchmark}))
    columns = [c for c in COLUMNS if any(c[1] in values for _, values in rows)]
    yield [""] + [head for head, _, _ in columns]
    for kind, values in rows:
        yield [kind] + [show(values[key]) if key in values else "" for _, key, show in columns]


def main(command):
    report = run(command)
    context = report["context"]
    print(f"{context['num_cpus']} cores at {context['mhz_per_cpu']} MHz, load "
          + "/".join(f"{load:.1f}" for load in os.getloadavg()) + ", " + context["date"])
    results = report["benchmarks"]
    medians = [b for b in results if b.get("aggregate_name") == "median"]
    heads, *rows = table(medians or results)
    print("\n| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(row) + " |")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
