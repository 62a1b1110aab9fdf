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


def number(value):
    return "" if value is None else f"{value:,.0f}"


def row(benchmark):
    kind, given = arguments(benchmark.get("run_name", benchmark["name"]))
    rate = benchmark.get("items_per_second")
    return [kind, RULES.get(given.get("rule"), ""), given.get("derivatives", ""),
            number(benchmark.get("control_points")), number(benchmark.get("cells")),
            f"{benchmark['real_time']:.4g}", "" if rate is None else f"{rate * 1e-6:.3g}"]


def main(command):
    report = run(command)
    context = report["context"]
    print(f"{context['num_cpus']} cores at {context['mhz_per_cpu']} MHz, load "
          + "/".join(f"{load:.1f}" for load in os.getloadavg()) + ", " + context["date"])
    print()
    heads = ["", "rule", "derivatives", "control points", "cells", "ms", "million items/s"]
    print("| " + " | ".join(heads) + " |")
    print("|" + "---|" * len(heads))
    results = report["benchmarks"]
    medians = [b for b in results if b.get("aggregate_name") == "median"]
    for benchmark in medians or results:
        print("| " + " | ".join(row(benchmark)) + " |")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
