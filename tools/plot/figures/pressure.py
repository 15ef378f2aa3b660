"""Contact pressure: profiles at stored times, in space along and across the sliding direction
(figs. 11, 15), and those of two results in one figure (fig. 11)."""

import numpy
from matplotlib.lines import Line2D

from . import curves, style
from .complaints import Unsuitable
from .shape import MOST_TIMES

READABLE = 3  # times the lowest peak: higher ones are cut off


def draw(result):
    lines = curves.of(result)
    steps = result.some_steps(MOST_TIMES)
    tables = [[line.at(step) for step in [0, *steps]] for line in lines]
    figure, (panels,) = panels_for(lines, 1)
    for axes, line, (start, *later) in zip(panels, lines, tables):
        profile(axes, line, start, color="black", linestyle="--", linewidth=0.8)
        for table, colour in zip(later, style.sequence(len(steps))):
            profile(axes, line, table, color=colour)
        frame(axes, [start, *later], line.axis)
    cut = limit(panels[0], [peak(states) for states in zip(*tables)])
    handles = panels[0].get_lines()
    for handle, step, note in zip(handles, [0, *steps], cut):
        handle.set_label(f"{style.number(result.times[step])} s{note}")
    style.legend_above_all(figure, handles)
    return figure


def draw_two(first, second):
    """At the times that both have stored: colours show time, dashes the second result. Below, the
    pressure of the second minus that of the first."""
    if first.attribute("problem") != second.attribute("problem"):
        raise Unsuitable("the results are of different problems")
    pairs = [(i, j) for i in first.some_steps(MOST_TIMES) for j, t in enumerate(second.times)
             if numpy.isclose(first.times[i], t, rtol=1e-9)]
    if not pairs:
        raise Unsuitable("the results share no time after the start")
    lines, others = curves.of(first), curves.of(second)
    figure, (panels, below) = panels_for(lines, 2)
    colours = style.sequence(len(pairs))
    peaks = numpy.zeros(len(pairs))
    for axes, lower, line, other in zip(panels, below, lines, others):
        tables = [(line.at(i), other.at(j)) for i, j in pairs]
        peaks = numpy.maximum(peaks, [peak(pair) for pair in tables])
        lower.axhline(0, color=style.GREY, linewidth=0.6)
        for (one, two), colour in zip(tables, colours):
            profile(axes, line, one, color=colour)
            profile(axes, other, two, color=colour, linestyle=style.DASHES)
            lower.plot(*difference(one, two, line.axis), color=colour)
        frame(axes, [table for pair in tables for table in pair], line.axis)
    below[0].set_ylabel("second − first\n[MPa]")
    cut = limit(panels[0], peaks)
    times = [Line2D([], [], color=colour, label=f"{style.number(first.times[i])} s{note}")
             for (i, _), colour, note in zip(pairs, colours, cut)]
    names = [Line2D([], [], color="black", linestyle=dashes, label=title(result))
             for result, dashes in ((first, "-"), (second, style.DASHES))]
    style.legend_above_all(figure, names, times)
    figure.align_ylabels()
    return figure


def difference(first, second, axis):
    """Positions and the second pressure minus the first: of the same nodes if both results have
    them, otherwise at all nodes of both, between which pressures are linear."""
    initial = [f"{name}0" for name in "XYZ"]
    if all(len(first[name]) == len(second[name]) and numpy.allclose(
            first[name], second[name], rtol=0, atol=1e-9 * numpy.ptp(first[axis]))
            for name in initial):
        return first[axis], second["pressure"] - first["pressure"]
    low = max(first[axis][0], second[axis][0])
    high = min(first[axis][-1], second[axis][-1])
    where = numpy.union1d(first[axis], second[axis])
    where = where[(where >= low) & (where <= high)]
    at = [numpy.interp(where, table[axis], table["pressure"]) for table in (first, second)]
    return where, at[1] - at[0]


def title(result):
    return f"{result.name} ({len(result.history) - 1} steps)"


def panels_for(lines, rows):
    """One column per curve, in one row or two, the second a lower one."""
    width = style.SINGLE if len(lines) == 1 else style.DOUBLE
    height = 0.62 * style.SINGLE if rows == 1 else 0.95 * style.SINGLE
    figure = style.figure(width=width, height=height)
    panels = figure.subplots(rows, len(lines), sharex="col", sharey="row", squeeze=False,
                             height_ratios=[1.7, 1][:rows])
    panels[0, 0].set_ylabel("contact pressure [MPa]")
    for axes, line in zip(panels[-1], lines):
        axes.set_xlabel(f"${line.axis_name}$ [mm]" + (f"   at {line.where}" if line.where else ""))
    return figure, panels


def profile(axes, line, table, **look):
    """Over the current position, where the pressure acts."""
    axes.plot(table[line.axis], table["pressure"], marker=".", markersize=2.2, **look)


def frame(axes, tables, axis):
    """The range that was ever in contact, to the first node that was not, and a margin; at most the
    surface."""
    seen = numpy.concatenate([table[axis][with_neighbours(table["pressure"] > 0)]
                              for table in tables])
    whole = numpy.concatenate([table[axis] for table in tables])
    if len(seen) and numpy.ptp(seen) > 0:
        margin = 0.05 * numpy.ptp(seen)
        axes.set_xlim(max(seen.min() - margin, whole.min()), min(seen.max() + margin, whole.max()))


def with_neighbours(chosen):
    wider = chosen.copy()
    wider[1:] |= chosen[:-1]
    wider[:-1] |= chosen[1:]
    return wider


def peak(tables):
    return max(table["pressure"].max() for table in tables)


def limit(axes, peaks):
    """Ends the axis where the lowest of the curves can still be read on it. Returns, for each
    curve, what its label says of a peak that is cut off."""
    loaded = [value for value in peaks if value > 0]
    readable = [value for value in loaded if value <= READABLE * min(loaded)]
    if not loaded:
        axes.set_ylim(bottom=0)
        return [""] * len(peaks)
    top = 1.08 * max(readable)
    axes.set_ylim(0, top)
    return [f" (up to {style.number(value)} MPa)" if value > top else "" for value in peaks]
