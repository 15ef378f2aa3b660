#!/usr/bin/env python3
"""Draws docs/stressed_surface.png from runs, and prints its numbers: growth rates of waves, the
shrinking disc and its lobes, notches on their way to a cusp, energies.

    problems/stressed_surface/figures.py        # by build/release/gnomon, or that of $GNOMON
"""

import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(ROOT / "tools" / "plot"))
from figures import style  # noqa: E402

GNOMON = os.environ.get("GNOMON", str(ROOT / "build" / "release" / "gnomon"))
M, E, NU, SIGMA = 1e-3, 1000.0, 0.3, 10.0
GAMMA = 0.01448309982
NEUTRAL = 2 * (1 - NU**2) * SIGMA**2 / (E * GAMMA)


def rows(*words):
    text = subprocess.run([GNOMON, *map(str, words)], capture_output=True, text=True, check=True).stdout
    return [{key.split(" [")[0]: float(value) for key, value in row.items()}
            for row in csv.DictReader(text.splitlines())]


class Run:
    """A run, which may end at a cusp; its result lies in `folder`."""

    def __init__(self, folder, scene, **settings):
        self.result = pathlib.Path(folder) / f"{len(list(pathlib.Path(folder).iterdir()))}.h5"
        words = [f"--set={key.replace('__', '.')}={value}" for key, value in settings.items()]
        done = subprocess.run([GNOMON, "run", HERE / scene, *words, "-o", self.result],
                              capture_output=True, text=True)
        self.end = done.stderr

    def history(self, column):
        return numpy.array([row[column] for row in rows("history", self.result)])

    def surface(self, time):
        points = rows("contact", self.result, "--time", time)
        return [row["X"] for row in points], [row["Y"] for row in points]


def growth(folder, q, n):
    rate = M * GAMMA * NEUTRAL**2 / 4
    run = Run(folder, "wave.toml", surface__size=2 * math.pi / q, surface__amplitude=1e-5 / q,
              mesh__elements=f"[{n},{n}]", time__end=0.2 / rate, integrator__rtol=1e-7)
    amplitude, time = run.history("amplitude"), run.history("t")
    return math.log(amplitude[-1] / amplitude[0]) / time[-1]


def draw_growth(axes, folder):
    q = numpy.linspace(0, 1.75, 100) * NEUTRAL
    unit = M * GAMMA * NEUTRAL**2
    axes.axhline(0, color=style.GREY, linewidth=0.5)
    axes.plot(q / NEUTRAL, M * GAMMA * q * (NEUTRAL - q) / unit, color="k", label="half-plane")
    for k, n in enumerate((12, 24)):
        parts = (0.25, 0.5, 0.75, 1.25, 1.5)
        computed = [growth(folder, part * NEUTRAL, n) / unit for part in parts]
        for part, rate in zip(parts, computed):
            print(f"growth at {part} q_c, {n} elements: {rate / (part * (1 - part)) - 1:+.2%}")
        axes.plot(parts, computed, style.MARKERS[k], color=style.COLOURS[k], fillstyle="none",
                  label=f"{n} elements")
    axes.set_xlabel(r"wave number $q / q_c$")
    axes.set_ylabel(r"growth rate / $m \gamma q_c^2$")
    axes.legend(loc="lower left")


def draw_disc(axes, folder):
    run = Run(folder, "circle.toml", surface__amplitude=0.05, surface__lobes=4, output__interval=75,
              mesh__elements="[8, 6]", output__every=0)
    for k, time in enumerate((0, 75, 150, 225, 300, 375)):
        x, y = run.surface(time)
        axes.plot(x, y, color=style.COLOURS[0], alpha=1 - 0.13 * k)
    for time in (0, 75, 150, 225, 300, 375):
        x, y = run.surface(time)
        radius = math.sqrt(1 - 2 * M * time)
        lobes = 0.05 * radius**15
        angle = numpy.linspace(0, math.pi / 2, 200)
        axes.plot((radius + lobes * numpy.cos(4 * angle)) * numpy.cos(angle),
                  (radius + lobes * numpy.cos(4 * angle)) * numpy.sin(angle), "k:", linewidth=0.6)
    axes.set_aspect("equal")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")


def draw_cusp(axes, folder):
    run = Run(folder, "wave.toml", surface__amplitude=0.08, mesh__elements="[48,40]", time__end=1e4,
              output__times="[100.0,200.0,250.0,290.0]", integrator__rtol=1e-4)
    print(run.end.strip())
    reached = float(re.search(r"from t = ([0-9.]+)", run.end)[1])
    for k, time in enumerate((0, 100, 200, 250, 290, reached)):
        x, y = run.surface(time)
        x, y = numpy.array(x), numpy.array(y)
        axes.plot(numpy.concatenate([x, 1 - x[::-1]]), numpy.concatenate([y, y[::-1]]),
                  color=style.COLOURS[1], alpha=0.3 + 0.14 * k, label=f"{time:.0f} s")
    axes.set_xlabel("x [mm]")
    axes.set_ylabel("y [mm]")
    axes.legend(loc="lower left")
    return run


def draw_energy(axes, folder, cusp):
    wave = Run(folder, "wave.toml", output__every=0)
    decays = Run(folder, "wave.toml", surface__size=1 / 3, output__every=0)
    for k, (run, label) in enumerate(((wave, r"$q_c/2$"), (decays, r"$3 q_c/2$"),
                                      (cusp, r"$q_c/2$, to a cusp"))):
        energy, time = run.history("energy"), run.history("t")
        print(f"{label}: largest change of the energy in a step {numpy.diff(energy).max():.2e} N of {energy[0]:.2e}")
        axes.plot(time / time[-1], energy / energy[0], style.MARKERS[k] + "-", color=style.COLOURS[k],
                  label=label, markersize=2)
    axes.set_xlabel("time / that of the end")
    axes.set_ylabel("energy / that at the start")
    axes.legend()


def main():
    style.apply()
    made = style.figure(style.DOUBLE, 0.75 * style.DOUBLE)
    axes = made.subplots(2, 2)
    with tempfile.TemporaryDirectory() as folder:
        draw_growth(axes[0][0], folder)
        draw_disc(axes[0][1], folder)
        draw_energy(axes[1][1], folder, draw_cusp(axes[1][0], folder))
    made.savefig(ROOT / "docs" / "stressed_surface.png", dpi=200)


if __name__ == "__main__":
    main()
