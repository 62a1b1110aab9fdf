#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the benchmarks and prints a Markdown table, the machine and its load above it.

    Utilities/benchmarks/table.py BUILD/bin/TrivariateBenchmarks [--large] [--benchmark_filter=Fit ...]

--large also fits volumes of 256^3 voxels, for minutes. All further arguments go to the benchmarks.
With --benchmark_repetitions=n the medians are shown. "x uniform" is the time as a multiple of that
of the uniform tensor-product fit, or of its evaluation, in the same run.
"""
import json
import os
import subprocess
import sys

UNIFORM = "2"
RULES = {"0": "compact", "1": "analysis-suitable", UNIFORM: "uniform"}


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
    ("radius", "radius", str),
    ("grey levels", "levels", str),
    ("threads", "threads", str),
    ("derivatives", "derivatives", str),
    ("control points", "control_points", lambda value: f"{float(value):,.0f}"),
    ("cells", "cells", lambda value: f"{value:,.0f}"),
    ("ms", "time", lambda value: f"{value:.4g}"),
    ("x uniform", "times_uniform", lambda value: f"{value:.3g}"),
    ("x plain", "times_plain", lambda value: f"{value:.3g}"),
    ("x 64^3", "times_64", lambda value: f"{value:.3g}"),
    ("x one thread", "times_one_thread", lambda value: f"{value:.3g}"),
    ("million items/s", "items_per_second", lambda value: f"{value * 1e-6:.3g}"),
    ("MB", "megabytes", lambda value: f"{value:.0f}"),
    ("RMS x 100", "rms_percent", lambda value: f"{value:.3g}"),
    ("maximum error", "maximum_error", lambda value: f"{value:.2g}"),
]


def table(benchmarks):
    """Rows of the columns that any of the benchmarks has something for; the first row is heads."""
    rows = []
    uniform = {}
    for benchmark in benchmarks:
        name = benchmark.get("run_name", benchmark["name"])
        kind, given = arguments(name)
        # What is timed on one thread does not depend on what else the machine does.
        time = benchmark["real_time" if "real_time" in name else "cpu_time"]
        rows.append((kind, {**given, **benchmark, "time": time}))
        rule = given.pop("rule", None)
        case = (kind, *given.items())
        if rule == UNIFORM:
            uniform[case] = time
        if case in uniform:
            rows[-1][1]["times_uniform"] = time / uniform[case]
    columns = [c for c in COLUMNS if any(c[1] in values for _, values in rows)]
    yield [""] + [head for head, _, _ in columns]
    for kind, values in rows:
        yield [kind] + [show(values[key]) if key in values else "" for _, key, show in columns]


def main(command):
    if "--large" in command:
        command.remove("--large")
    elif not any(argument.startswith("--benchmark_filter") for argument in command):
        command.append("--benchmark_filter=-voxels:256")
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
