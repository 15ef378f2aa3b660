#!/usr/bin/python3
"""Time and memory of a coupled Newton iteration by the block solver against the size of the mesh.

    benchmarks/scaling.py build/release/benchmarks/gnomon_benchmarks DIR

Runs the benchmarks block_newton/*, each in a process of its own because what is read of the memory
is its peak, and writes DIR/scaling.csv, DIR/scaling.png and DIR/scaling.svg. Prints the exponents
of fits in logarithms over all sizes. What the table holds is not measured again. With
GNOMON_LARGE_BENCHMARKS in the environment, sizes beyond 100,000 elements too.
"""

import csv
import json
import math
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLUMNS = ["name", "elements", "unknowns", "krylov", "assembly", "first_set_up", "set_up", "solve",
           "newton", "peak_MB"]


def names(program):
    listing = subprocess.run([program, "--benchmark_list_tests", "--benchmark_filter=block_newton"],
                             check=True, capture_output=True, text=True)
    return listing.stdout.split()


def measured(program, name):
    run = subprocess.run([program, f"--benchmark_filter=^{name}$", "--benchmark_format=json"],
                         check=True, capture_output=True, text=True)
    result = json.loads(run.stdout)["benchmarks"][0]
    return {column: result[column] for column in COLUMNS}


def read(table):
    if not table.exists():
        return []
    with table.open(newline="") as file:
        return [{key: value if key == "name" else float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]


def write(table, rows):
    with table.open("w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


def exponent(rows, column):
    """Slope of the column over the elements in logarithms, by least squares."""
    x = [math.log(row["elements"]) for row in rows]
    y = [math.log(row[column]) for row in rows]
    mean_x, mean_y = sum(x) / len(x), sum(y) / len(y)
    return (sum((a - mean_x) * (b - mean_y) for a, b in zip(x, y))
            / sum((a - mean_x) ** 2 for a in x))


def draw(series, folder):
    figure, panels = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for panel, column, label in zip(panels, ["newton", "peak_MB"],
                                    ["processor time of a Newton iteration [s]",
                                     "peak memory of the process [MB]"]):
        for solver, rows in series.items():
            panel.loglog([row["elements"] for row in rows], [row[column] for row in rows], "o-",
                         label=f"{solver}, exponent {exponent(rows, column):.2f}")
        panel.set_xlabel("elements")
        panel.set_ylabel(label)
        panel.grid(True, which="both", alpha=0.3)
        panel.legend()
    for suffix in ["png", "svg"]:
        figure.savefig(folder / f"scaling.{suffix}", dpi=150)


def main(program, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    table = folder / "scaling.csv"
    rows = read(table)
    for name in names(program):
        if name not in [row["name"] for row in rows]:
            rows.append(measured(program, name))
            write(table, rows)
    series = {}
    for row in sorted(rows, key=lambda row: row["elements"]):
        series.setdefault(row["name"].split("/")[1], []).append(row)
    for solver, of_solver in series.items():
        if len(of_solver) > 1:
            print(f"{solver}: time ~ elements^{exponent(of_solver, 'newton'):.2f}, "
                  f"memory ~ elements^{exponent(of_solver, 'peak_MB'):.2f}")
    draw(series, folder)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
