"""The figure of the worn block after 3600 m, measured and computed, in the gallery."""

import csv
import math

from block_on_ring import COMPLIANCE, RADIUS, closed_form, worn_area
from figures import style
from program import SCENES

DATA = SCENES / "block_on_ring"
END = 7200.0


def published(name):
    """Rows of a file without its comments."""
    with open(DATA / name) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def simulated(name):
    """x [mm] and depth [um] after 3600 m; half of a symmetric profile."""
    rows = [row for row in published(name) if float(row["sliding_m"]) == 3600]
    return [float(row["x_mm"]) for row in rows], [float(row["y_um"]) for row in rows]


def exact(x):
    """The circle of the ring, and what the block bends under the uniform pressure (K. L.
    Johnson, Contact Mechanics, eq. 2.30), above its middle."""
    a, depth = closed_form(worn_area(END))
    if abs(x) >= a:
        return 0.0
    bend = COMPLIANCE / (2 * a) * sum(y * math.log((y / a) ** 2) for y in (a + x, a - x))
    return -1e3 * (depth - (RADIUS - math.sqrt(RADIUS**2 - x**2)) + bend)


def profiles(axes, nodes):
    measured = published("measured_cruzado2010.csv")
    x = [float(row["x_mm"]) for row in measured]
    for k, marker in enumerate(style.MARKERS[:3], start=1):
        y = [float(row[f"test{k}_um"]) for row in measured]
        axes.plot(x, y, marker, color=style.GREY, markersize=1.5, markeredgewidth=0,
                  label=f"measured, test {k}")
    axes.plot([n["X"] for n in nodes], [1e3 * n["Y"] for n in nodes], color=style.COLOURS[0],
              label="gnomon")
    axes.set(xlabel="x [mm]", ylabel="surface of the block [µm]", xlim=(-2, 2))
    style.legend(axes, columns=2)


def differences(axes, nodes):
    others = (("mesh_motion", "mesh motion, 45,000 increments"), ("level_set", "level set"))
    for (name, label), colour in zip(others, style.COLOURS[1:]):
        x, y = simulated(f"{name}_block_on_ring.csv")
        axes.plot(x, [b - exact(a) for a, b in zip(x, y)], color=colour, label=label)
    right = [n for n in nodes if n["X"] >= -1e-9]
    axes.plot([n["X"] for n in right], [1e3 * n["Y"] - exact(n["X"]) for n in right],
              color=style.COLOURS[0], label="gnomon")
    axes.set(xlabel="x [mm]", ylabel="difference from the closed form [µm]", xlim=(0, 1.45),
             ylim=(-0.4, 0.5))
    style.legend(axes, columns=2)


def drawn(nodes):
    """The figure of a worn contact surface."""
    figure = style.figure(style.DOUBLE, 0.42 * style.DOUBLE)
    left, right = figure.subplots(1, 2)
    profiles(left, nodes)
    differences(right, nodes)
    return figure
