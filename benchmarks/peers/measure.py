#!/usr/bin/python3
"""Processor time of gnomon, GetFEM and CalculiX on the worn pin (docs/benchmarks.md).

    benchmarks/peers/measure.py build/release/gnomon DIR [--repetitions 3] [--only PART ...]

Debian: calculix-ccx python3-getfem python3-h5py python3-scipy. The programs run in turns, each with
one thread; times are medians of user and system seconds of whole processes. Long runs are made once.
DIR keeps the reference run, which is not repeated where it exists."""

import argparse
import os
import pathlib
import statistics
import subprocess
import sys

import h5py
import numpy as np

from pin import SCENE, save_mesh

HERE = pathlib.Path(__file__).resolve().parent
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
START = ["integrator.name=backward-euler", "time.end=1e-6", "integrator.step=1e-6"]

# part: [(what, program, elements, settings of gnomon or steps of the loop, in every round)]
PARTS = {
    "solve": [(f"contact solve {n}x{n}", program, n, START if program == "gnomon" else 0, True)
              for n in (40, 80) for program in ("gnomon", "getfem", "calculix")],
    "coarse": [
        ("esdirk-3, rtol 1e-3", "gnomon", 40,
         ["integrator.name=esdirk-3", "integrator.rtol=1e-3"], True),
        ("forward Euler, 5 s", "gnomon", 40,
         ["integrator.name=forward-euler", "integrator.step=5"], True),
        ("forward Euler, 5 s", "getfem", 40, 200, True),
        ("forward Euler, 8 s", "calculix", 40, 125, False)],
    "fine": [
        ("bdf, rtol 1e-4", "gnomon", 40, ["integrator.name=bdf", "integrator.rtol=1e-4"], True),
        ("forward Euler, 0.74 s", "getfem", 40, 1360, False)],
}
REFERENCE = ["integrator.name=bdf", "integrator.rtol=1e-7"]


def processor_seconds(command):
    """User and system time of a process and of those that it has started."""
    process = subprocess.Popen(list(map(str, command)), env=ENVIRONMENT,
                               stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {process.returncode}")
    return usage.ru_utime + usage.ru_stime


class Bench:
    def __init__(self, gnomon, folder):
        self.gnomon, self.folder = gnomon, folder
        folder.mkdir(parents=True, exist_ok=True)
        self.reference = folder / "reference.h5"
        if not self.reference.exists():
            self.run_gnomon(40, REFERENCE, self.reference)
        for n in (40, 80):
            self.write_mesh(n)

    def run_gnomon(self, elements, settings, result):
        words = [f"mesh.elements=[{elements}, {elements}]", "body.element=plain", *settings]
        words = [word for setting in words for word in ("--set", setting)]
        return processor_seconds([self.gnomon, "run", SCENE, *words, "--quiet", "--force",
                                  "-o", result])

    def mesh(self, elements):
        return self.folder / f"mesh{elements}.npz"

    def write_mesh(self, elements):
        result = self.folder / f"start{elements}.h5"
        self.run_gnomon(elements, START, result)
        with h5py.File(result) as file:
            save_mesh(self.mesh(elements), file["mesh/points"][:, :2], file["mesh/cells"][:])

    def run(self, program, elements, how):
        """(Processor time, worn positions of the contact nodes or None)."""
        if program == "gnomon":
            result = self.folder / "run.h5"
            return self.run_gnomon(elements, how, result), worn_contact(result)
        result = self.folder / "run.npz"
        steps = ["--steps", how] if how else []
        seconds = processor_seconds([HERE / f"{program}_pin.py", self.mesh(elements), *steps,
                                     "-o", result])
        return seconds, np.load(result)["worn"] if how else None


def worn_contact(result):
    """Worn positions of the contact nodes at the end of a run of gnomon, in the order of x."""
    with h5py.File(result) as file:
        path = file["gnomon/stored"][-1]["path"].decode().removeprefix("steps/")
        rows = np.sort(file["gnomon/contact"][path][:], order="X0")
    return np.column_stack([rows["X"], rows["Y"]])


def shape_error(worn, reference):
    return np.linalg.norm(worn - reference)


def measured(bench, part, repetitions):
    """[(what, program, median of seconds, shape)] of a part."""
    times = [[] for _ in PARTS[part]]
    shapes = [None] * len(times)
    for repetition in range(repetitions):
        for i, (_, program, elements, how, always) in enumerate(PARTS[part]):
            if always or repetition == 0:
                seconds, shapes[i] = bench.run(program, elements, how)
                times[i].append(seconds)
    return [(what, program, statistics.median(times[i]), shapes[i])
            for i, (what, program, *_) in enumerate(PARTS[part])]


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR")
    parser.add_argument("--repetitions", type=int, default=3, metavar="N")
    parser.add_argument("--only", nargs="+", choices=PARTS, default=list(PARTS), metavar="PART",
                        help=f"{', '.join(PARTS)}; default: all")
    options = parser.parse_args()
    bench = Bench(options.gnomon.resolve(), options.folder.resolve())
    reference, shapes = worn_contact(bench.reference), {}
    print("| what | program | CPU [s] | shape error [mm] |\n|---|---|---|---|")
    for part in options.only:
        for what, program, seconds, shape in measured(bench, part, options.repetitions):
            error = f"{shape_error(shape, reference):.1e}" if part != "solve" else ""
            print(f"| {what} | {program} | {seconds:.3g} | {error} |", flush=True)
            shapes[what, program] = shape
    cross_check(shapes, reference)


def cross_check(shapes, reference):
    """The loop of GetFEM, which shares nothing with gnomon, against gnomon."""
    same = [shapes.get(("forward Euler, 5 s", program)) for program in ("gnomon", "getfem")]
    fine = shapes.get(("forward Euler, 0.74 s", "getfem"))
    if all(shape is not None for shape in same):
        print(f"\nforward Euler, 5 s: gnomon and GetFEM differ by {shape_error(*same):.1e} mm")
    if fine is not None and same[1] is not None:
        limit = fine + (fine - same[1]) * 200 / (1360 - 200)  # the error is of first order
        print(f"GetFEM's loop, extrapolated in the step, and the reference differ by "
              f"{shape_error(limit, reference):.1e} mm")


if __name__ == "__main__":
    main()
