"""Accuracy of error control: differences of DIR/extremes.csv against the tolerance."""

from dataclasses import dataclass

import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator

from . import style, tables
from .complaints import Unsuitable
from .errors import panels_for
from .study import distinct

TEXTS = ("study", "sweep", "method", "integrator", "marked")
NUMBERS = ("rtol", "difference")
USUAL = (0.1, 100)  # of rtol, docs/extremes.md
SHORTEST = 3  # least number of cases of a line
VARIANT = style.DASHES  # a method with additional settings, as its name says


@dataclass
class Case:
    """A row with error control: the columns that the figure uses."""

    study: str
    sweep: str
    method: str
    integrator: str
    marked: bool
    rtol: float
    ratio: float


def read(folder):
    path = folder / "extremes.csv"
    cases = []
    for row in tables.read(path, (*TEXTS, *NUMBERS)):
        rtol, difference = (tables.number(path, row, name) for name in NUMBERS)
        if rtol > 0 and difference > 0:
            cases.append(Case(row["study"], row["sweep"], row["method"], row["integrator"],
                              row["marked"] == "1", rtol, difference / rtol))
    return cases


def draw(cases):
    """One panel per integrator: lines for cases with several tolerances, otherwise points."""
    if not cases:
        raise Unsuitable("no case with error control has a difference")
    names = distinct(case.integrator for case in cases)
    figure, panels = panels_for(len(names))
    ratios = [case.ratio for case in cases]
    limits = (min(0.5 * min(ratios), 0.5 * USUAL[0]), max(2 * max(ratios), 2 * USUAL[1]))
    for i, (axes, name) in enumerate(zip(panels, names)):
        draw_panel(axes, [case for case in cases if case.integrator == name], name)
        axes.set_ylim(limits)
        axes.set_title(name)
    finish(panels)
    style.legend_above_all(figure, notes_of(cases))
    return figure


def draw_panel(axes, cases, name):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.tick_params(which="both", top=False, right=False)
    axes.axhspan(*USUAL, color=style.BAND, zorder=0, linewidth=0)
    for series in series_of(cases):
        x = numpy.array([case.rtol for case in series])
        y = numpy.array([case.ratio for case in series])
        hollow = numpy.array([case.marked for case in series])
        is_line = len(series) >= SHORTEST
        look = {"color": style.COLOURS[0] if is_line else style.COLOURS[5], "zorder": 2 + is_line}
        if is_line:
            axes.plot(x, y, linestyle="-" if series[0].method == name else VARIANT, **look)
        sign = {"marker": "o", "linestyle": "", "markersize": 3.5 if is_line else 2.5}
        axes.plot(x[~hollow], y[~hollow], **sign, **look)
        axes.plot(x[hollow], y[hollow], markerfacecolor="white", markeredgewidth=0.7, **sign,
                  **look)


def series_of(cases):
    groups = {}
    for case in cases:
        groups.setdefault((case.study, case.sweep, case.method), []).append(case)
    return [sorted(group, key=lambda case: case.rtol) for group in groups.values()]


def finish(panels):
    for axes in panels:
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel("difference / rtol")
        style.log_ticks(axes.yaxis)
        style.log_ticks(axes.xaxis)
        axes.xaxis.set_major_locator(LogLocator(numticks=7))
    columns = panels[0].get_subplotspec().get_gridspec().ncols
    for axes in panels[-columns:]:
        axes.set_xlabel("rtol")
        axes.tick_params(labelbottom=True)


def notes_of(cases):
    """The meaning of the signs that occur."""
    line = {"color": style.COLOURS[0], "marker": "o"}
    point = {"color": style.COLOURS[5], "marker": "o", "linestyle": "", "markersize": 2.5}
    series = series_of(cases)
    lines = [group for group in series if len(group) >= SHORTEST]
    notes = [Line2D([], [], label="one case, by its tolerance", **line)] if lines else []
    variants = distinct(group[0].method.removeprefix(group[0].integrator).strip()
                        for group in lines if group[0].method != group[0].integrator)
    if variants:
        notes.append(Line2D([], [], label=", ".join(variants), linestyle=VARIANT,
                            color=style.COLOURS[0]))
    if len(lines) < len(series):
        notes.append(Line2D([], [], label="other cases", **point))
    if any(case.marked for case in cases):
        notes.append(Line2D([], [], color="black", marker="o", linestyle="",
                            markerfacecolor="white", label="below 10× the reference's error"))
    return notes + [Patch(color=style.BAND, linewidth=0, label=f"{USUAL[0]:g} to {USUAL[1]:g} rtol")]
