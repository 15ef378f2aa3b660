#!/usr/bin/python3
"""Compares the speed of two builds of gnomon, by alternating measurements.

    scripts/pair_timings.py BUILD_A BUILD_B [--repetitions N] [--only assembly newton runs]

A build is a folder of CMake with `gnomon` and, for assembly and newton,
`benchmarks/gnomon_benchmarks`:

    cmake -S . -B build/benchmarks -G Ninja -DCMAKE_BUILD_TYPE=Release -DGNOMON_TESTS=OFF \\
        -DGNOMON_BENCHMARKS=ON && cmake --build build/benchmarks

What is measured:

    assembly   residual and tangents of one hexahedron, residual and Jacobian of 60,000 hexahedra
               (benchmarks/solid_assembly.cpp), residual and Jacobian of the pin
    newton     an iteration on the coupled system of the pin, with its factorization and solve
               (benchmarks/coupled_system.cpp)
    runs       whole runs of `gnomon run`: the pin with 40x40 elements by esdirk-3 and bdf, a
               coarse groove, a coarse ball

The two builds run in turns, A B A B ..., each with one thread, and what counts is processor time
(user and system), so that other work on the machine disturbs the ratios little. "ratio" is the
median of B by the median of A: above 1, B is slower. "90 %" is the interval that holds nine of
ten such ratios when pairs are drawn from the measured ones at random (bootstrap); "pairs" are the
smallest and the largest ratio of two neighbouring measurements, and "best" is the ratio of the
smallest times, which other work on the machine disturbs least. "changed" marks a ratio that, like
the best one, differs from 1 by more than --notable, where the whole interval is on the same side of
1 and there are five pairs or more. Of fewer pairs, the interval says little. On a busy machine
such a mark can still be chance: compare a build with itself to see how far ratios scatter there.

A run that takes other counts of steps and Newton iterations in B does not do the same work: the
table says so. With five repetitions all this takes about six minutes on an idle machine.
"""

import argparse
import csv
import json
import os
import random
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

BENCHMARKS = {  # part: regular expression of the names
    "assembly": r"^(residual/hexahedron_.*|tangent/hexahedron_.*|block_residual.*|block_jacobian.*"
                r"|residual/40|jacobian/40)$",
    "newton": r"^newton_iteration/(40|80)(/.*)?$",
}

PIN, BALL, GROOVE = (f"{name}/small_deformation" for name in
                     ("pin_on_flat", "ball_on_flat", "ball_on_half_space"))
RUNS = {  # name: scene, settings
    "pin 40x40 esdirk-3": (PIN, ["mesh.elements=[40, 40]", "integrator.name=esdirk-3"]),
    "pin 40x40 bdf": (PIN, ["mesh.elements=[40, 40]", "integrator.name=bdf"]),
    "groove 10x20x6 esdirk-2": (GROOVE, [
        "mesh.elements=[10, 20, 6]", "mesh.size=[0.06, 0.06, 0.06]", "mesh.fine=[0, 0, 0]",
        "integrator.name=esdirk-2"]),
    "ball 5x2x3 bdf": (BALL, ["mesh.elements=[5, 2, 3]", "integrator.name=bdf"]),
}
WORK = ["steps", "newton_iterations", "factorizations", "krylov_iterations"]

ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
FEWEST_PAIRS = 5  # that can mark a change
SECONDS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}


class Build:
    def __init__(self, letter, folder, problems, settings):
        self.letter, self.folder = letter, folder.resolve()
        self.problems, self.settings = problems, settings
        self.program = self.folder / "gnomon"
        self.benchmarks = self.folder / "benchmarks" / "gnomon_benchmarks"

    def names(self, part):
        """The benchmarks of a part."""
        listing = subprocess.run([self.benchmarks, "--benchmark_list_tests"], check=True,
                                 capture_output=True, text=True, env=ENVIRONMENT).stdout
        return [name for name in listing.split() if re.search(BENCHMARKS[part], name)]

    def benchmark(self, names, least):
        """{name: (processor seconds, no counts)} of some benchmarks, in one process, because
        preparing their data takes longer than measuring."""
        pattern = "|".join(re.escape(name) for name in names)
        output = subprocess.run(
            [self.benchmarks, f"--benchmark_filter=^({pattern})$",
             "--benchmark_format=json", f"--benchmark_min_time={least}"],
            check=True, capture_output=True, text=True, env=ENVIRONMENT).stdout
        return {result["name"]: (result["cpu_time"] * SECONDS[result["time_unit"]], {})
                for result in json.loads(output)["benchmarks"]}

    def run(self, name):
        """{name: (processor seconds, user and system, and counts)} of a whole run."""
        scene, settings = RUNS[name]
        with tempfile.TemporaryDirectory() as folder:
            summary = Path(folder, "run.json")
            words = [word for text in settings + self.settings for word in ("--set", text)]
            process = subprocess.Popen(
                [self.program, "run", self.problems / f"{scene}.toml", *words, "--quiet",
                 "-o", Path(folder, "run.h5"), "--summary", summary], env=ENVIRONMENT)
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            if process.returncode != 0:
                sys.exit(f"{self.program}: {name}: exit code {process.returncode}")
            counts = json.loads(summary.read_text())
        work = {key: counts.get(key) for key in WORK}
        return {name: (usage.ru_utime + usage.ru_stime, work)}


def ratio_of_medians(pairs):
    a, b = (statistics.median(times) for times in zip(*pairs))
    return b / a


def interval(pairs, draws=2000):
    """5 % and 95 % quantiles of the ratios of medians of as many pairs, drawn with replacement."""
    chance = random.Random(1)
    ratios = sorted(ratio_of_medians(chance.choices(pairs, k=len(pairs))) for _ in range(draws))
    return ratios[draws // 20], ratios[-draws // 20 - 1]


class Measurement:
    """The times of one measurement by both builds, one pair per repetition."""

    def __init__(self, part, name):
        self.part, self.name, self.pairs, self.note = part, name, [], ""

    def add(self, of_a, of_b):
        (a, work_a), (b, work_b) = of_a, of_b
        self.pairs.append((a, b))
        self.note = ", ".join(f"{key} {work_a[key]} / {work_b[key]}" for key in work_a
                              if work_a[key] != work_b[key])

    def numbers(self, notable):
        a, b = (statistics.median(times) for times in zip(*self.pairs))
        ratios = [other / one for one, other in self.pairs]
        low, high = interval(self.pairs)
        ratio, best = b / a, min(b for _, b in self.pairs) / min(a for a, _ in self.pairs)
        beyond = [min(ratio, best) > 1 + notable and low > 1,
                  max(ratio, best) < 1 - notable and high < 1]
        changed = any(beyond) and len(self.pairs) >= FEWEST_PAIRS
        note = "; ".join(filter(None, ["changed" if changed else "", self.note]))
        return [self.part, self.name, a, b, ratio, low, high, min(ratios), max(ratios), best, note]


COLUMNS = ["part", "name", "a_seconds", "b_seconds", "ratio", "low_5_percent",
           "high_95_percent", "smallest", "largest", "best", "notes"]


def time_text(seconds):
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("us", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds / 1e-9:.3g} ns"


def table_line(row):
    part, name, a, b, ratio, low, high, smallest, largest, best, note = row
    return (f"| {part} | {name} | {time_text(a)} | {time_text(b)} | {ratio:.3f} "
            f"| {low:.3f} to {high:.3f} | {smallest:.3f} to {largest:.3f} | {best:.3f} | {note} |")


HEADER = ("| part | what | A | B | ratio | 90 % | pairs | best | notes |\n"
          "|---|---|---|---|---|---|---|---|---|")


def arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("a", type=Path, metavar="BUILD_A", help="folder of the reference build")
    parser.add_argument("b", type=Path, metavar="BUILD_B", help="folder of the candidate's")
    parser.add_argument("--repetitions", type=int, default=5, metavar="N",
                        help="pairs of measurements, after one that is not counted; default: 5")
    parser.add_argument("--only", nargs="+", choices=[*BENCHMARKS, "runs"],
                        default=[*BENCHMARKS, "runs"], metavar="PART",
                        help="assembly, newton, runs; default: all")
    parser.add_argument("--filter", default="", metavar="WORD",
                        help="only measurements with this word in their name")
    parser.add_argument("--min-time", type=float, default=0.1, metavar="SECONDS",
                        help="shortest time of one measurement of a benchmark; default: 0.1")
    parser.add_argument("--notable", type=float, default=0.03, metavar="FRACTION",
                        help="change of a ratio that is marked; default: 0.03")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="scene key for the runs of B only; repeatable")
    parser.add_argument("--problems", type=Path, default=ROOT / "problems", metavar="DIR",
                        help="scenes of the runs; default: those beside this script")
    parser.add_argument("--candidate-problems", type=Path, metavar="DIR", help="those of B")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE.csv",
                        help="also writes the table as CSV")
    options = parser.parse_args()
    if options.repetitions < 1:
        parser.error("--repetitions: expected one or more")
    builds = [Build("A", options.a, options.problems.resolve(), []),
              Build("B", options.b, (options.candidate_problems or options.problems).resolve(),
                    options.set)]
    for build in builds:
        needed = [build.program] if "runs" in options.only else []
        needed += [build.benchmarks] if set(options.only) - {"runs"} else []
        for file in needed:
            if not os.access(file, os.X_OK):
                parser.error(f"{file}: expected a program; --help says how to build it")
    return options, builds


def planned(options, builds):
    """Pairs of (measurements, function that makes one round of them with a build)."""
    for part in options.only:
        if part == "runs":
            for name in RUNS:
                if options.filter in name:
                    yield [Measurement(part, name)], lambda build, name=name: build.run(name)
            continue
        of_a, of_b = (build.names(part) for build in builds)
        for name in set(of_a) ^ set(of_b):
            print(f"{name}: only one of the builds has this benchmark", file=sys.stderr)
        names = [name for name in of_a if name in of_b and options.filter in name]
        if names:
            yield ([Measurement(part, name) for name in names],
                   lambda build, names=names: build.benchmark(names, options.min_time))


def main():
    options, builds = arguments()
    for build in builds:
        print(f"{build.letter}: {build.folder}")
    print(f"\n{HEADER}", flush=True)
    rows = []
    for measurements, turn in planned(options, builds):
        for repetition in range(options.repetitions + 1):
            a, b = (turn(build) for build in builds)
            for measurement in measurements:
                if repetition > 0:  # the first pair fills the caches
                    measurement.add(a[measurement.name], b[measurement.name])
        for measurement in measurements:
            rows.append(measurement.numbers(options.notable))
            print(table_line(rows[-1]), flush=True)
    if not rows:
        print("no measurement has such a name", file=sys.stderr)
        return 2
    if options.output:
        with open(options.output, "w", newline="") as stream:
            csv.writer(stream).writerows([COLUMNS, *rows])
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except KeyboardInterrupt:
        sys.exit("interrupted")
