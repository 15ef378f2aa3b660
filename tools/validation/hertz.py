#!/usr/bin/env python3
"""Contacts with closed forms by Hertz, on meshes of falling size (docs/notes/validation.md).

The half width a is that of the pressures' second moment, for Hertz's distribution a^2 = 4 <x^2>
(line) or 5/2 <r^2> (point): unlike the edge of the active set it does not depend on where the
nodes are. The last column is the root mean square of the nodal pressures minus Hertz's, over p0."""

import math

from program import SCENES, arc_lengths, percent, run, table

MODULUS = 210e3 / (1 - 0.3**2)


def line(load, radius):
    a = math.sqrt(4 * load * radius / (math.pi * MODULUS))
    return a, 2 * load / (math.pi * a)


def point(force, radius):
    a = (3 * force * radius / (4 * MODULUS)) ** (1 / 3)
    return a, 1.5 * force / (math.pi * a * a)


CASES = {
    "hertz_cylinder": ("line", line(113.26, 100)),
    "hertz_ball_axisymmetric": ("point", point(48.077, 100)),
    "ball_in_seat_axisymmetric": ("ring", line(12811 / (2 * math.pi * 10 * 0.5), 10)),
    "ring_in_groove_axisymmetric": ("ring", line(25623 / (2 * math.pi * 100), 100)),
}


def weighted(rows, kind):
    """(position, weight, pressure) of the ends of all facets: the trapezoidal rule."""
    s = arc_lengths(rows)
    for i in range(len(rows) - 1):
        for k in (i, i + 1):
            radius = 1 if kind == "line" else rows[k]["X"]
            yield s[k], (s[i + 1] - s[i]) / 2 * radius, rows[k]["pressure"]


def measures(rows, kind, a, p0):
    """Half width and root mean square error of the pressure, over p0."""
    points = list(weighted(rows, kind))
    total = sum(w * p for _, w, p in points)
    middle = 0 if kind == "point" else sum(w * p * s for s, w, p in points) / total
    second = sum(w * p * (s - middle) ** 2 for s, w, p in points) / total
    inside = [(s - middle, w, p) for s, w, p in points if abs(s - middle) < 1.2 * a]
    error = sum(w * (p - p0 * math.sqrt(max(0, 1 - (s / a) ** 2))) ** 2 for s, w, p in inside)
    area = sum(w for _, w, _ in inside)
    return math.sqrt((2.5 if kind == "point" else 4) * second), math.sqrt(error / area) / p0


def main():
    rows = []
    for name, (kind, (a, p0)) in CASES.items():
        for factor in (2, 1, 0.5, 0.25):
            done = run(SCENES / f"{name}.toml", f"mesh.factor={factor}")
            nodes = done.contact()
            width, error = measures(nodes, kind, a, p0)
            largest = max(node["pressure"] for node in nodes)
            active = sum(node["active"] for node in nodes)
            rows.append([f"`{name}`" if factor == 2 else "", factor, done.unknowns, int(active),
                         percent(largest / p0), percent(width / a), f"{100 * error:.2f} %",
                         f"{done.cpu:.1f} s"])
    table(["scene", "`mesh.factor`", "unknowns", "nodes in contact", "largest pressure",
           "half width", "pressure, rms", "CPU"], rows)


if __name__ == "__main__":
    main()
