#!/usr/bin/env python3
"""The cam's follower: the tables of docs/notes/cam.md and the figure of worn faces, written into
the folder that is named (python3 cam.py docs/tutorials)."""

import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "plot"))

from cycle_tables import compare
from figures import style
from program import SCENES, percent, run, table

SCENE = SCENES / "cam.toml"
COEFFICIENT, TURNS = 2e-9, 1e5


def lift(angle):
    return 2 * ((1 + math.cos(angle)) / 2) ** 2


def worn_area():
    """k times the integral of force times path: the cam's surface slides by its height for each
    radian."""
    angles = [2 * math.pi * i / 1000 for i in range(1000)]
    mean = sum((10 + 5 * lift(a)) * (12 + lift(a)) for a in angles) / len(angles)
    return COEFFICIENT * TURNS * 2 * math.pi * mean


def drawn(runs, reference):
    """Faces by different numbers of phases, and pressures."""
    figure = style.figure(style.DOUBLE, 0.4 * style.DOUBLE)
    left, right = figure.subplots(1, 2)
    shown = [value for value in runs if value != reference]
    for value, colour in zip((*shown, reference), (*style.sequence(len(shown)), "black")):
        rows = runs[value].contact()
        x = [row["X"] for row in rows]
        label = f"{value} phases"
        left.plot(x, [1e3 * (row["Y"] - 14) for row in rows], color=colour, label=label)
        right.plot(x, [row["pressure"] for row in rows], color=colour, label=label)
    left.set(xlabel="x [mm]", ylabel="worn face of the follower [µm]")
    right.set(xlabel="x [mm]", ylabel="mean pressure over a turn [MPa]")
    style.legend_above_all(figure, left.get_legend_handles_labels()[0])
    return figure


def main():
    style.apply()
    expected = worn_area()
    print(f"k times force times path: {expected:.6f} mm^2\n")
    phases = compare(SCENE, "cycle.phases", (8, 12, 16, 24, 32, 48), 64)
    table(["phases", "area against k times force times path"],
          [[value, percent(done.history()[-1]["worn_volume"] / expected, 3)]
           for value, done in phases.items()])
    compare(SCENE, "integrator.rtol", ("1e-1", "1e-2", "1e-3", "1e-4"), "1e-5", "cycle.phases=16")
    if len(sys.argv) > 1:
        figure = drawn({value: phases[value] for value in (8, 16, 32, 64)}, 64)
        figure.savefig(pathlib.Path(sys.argv[1]) / "cam_phases.png", dpi=200)


if __name__ == "__main__":
    main()
