"""Critical steps of explicit methods over time: by the spectrum, and found by running them."""

import numpy
from matplotlib.lines import Line2D

from . import style, tables
from .study import distinct

LINES = ("-", "--", "-.", ":")
COLUMNS = ("time", "method", "critical_step", "empirical")


def read(folder):
    """Rows (time, method, critical step, empirical or nan)."""
    path = folder / "critical_steps.csv"
    return [(tables.number(path, row, "time"), row["method"],
             tables.number(path, row, "critical_step"), tables.number(path, row, "empirical"))
            for row in tables.read(path, COLUMNS)]


def draw(rows):
    figure = style.figure(height=0.72 * style.SINGLE)
    axes = figure.add_subplot()
    handles = []
    for i, method in enumerate(distinct(row[1] for row in rows)):
        own = numpy.array([(t, step, found) for t, name, step, found in rows if name == method])
        own = own[own[:, 0].argsort()]
        look = {"color": style.COLOURS[i % 8], "marker": style.MARKERS[i % 8]}
        line = {"linestyle": LINES[i % len(LINES)]}  # so that coinciding lines stay visible
        axes.plot(own[:, 0], own[:, 1], **line, **look)
        axes.plot(own[:, 0], own[:, 2], linestyle="", markerfacecolor="none", markersize=6, **look)
        handles.append(Line2D([], [], label=method, **line, **look))
    set_scale(axes, [row[2] for row in rows] + [row[3] for row in rows])
    if any(numpy.isfinite(row[3]) for row in rows):
        handles.append(Line2D([], [], color="black", linestyle="", marker="o", markersize=6,
                              markerfacecolor="none", label="found by running"))
    axes.set_xlabel("time [s]")
    axes.set_ylabel("critical step [s]")
    style.legend_above_all(figure, handles)
    return figure


def set_scale(axes, steps):
    """From zero, or logarithmic if the small values would not be visible."""
    steps = [step for step in steps if 0 < step < numpy.inf]
    if steps and max(steps) > 20 * min(steps):
        axes.set_yscale("log")
    else:
        axes.set_ylim(0, 1.1 * max(steps, default=1))
