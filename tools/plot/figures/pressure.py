"""Contact pressure: profiles at stored times, in space along and across the sliding direction
(figs. 11, 15), and those of two results in one figure (fig. 11)."""

import numpy
from matplotlib.lines import Line2D

from . import curves, style
from .complaints import Unsuitable
from .shape import MOST_TIMES


def draw(result):
    lines = curves.of(result)
    steps = result.some_steps(MOST_TIMES)
    tables = [[line.at(step) for step in [0, *steps]] for line in lines]
    figure, panels = panels_for(lines)
    for axes, line, (start, *later) in zip(panels, lines, tables):
        profile(axes, line, start, color="black", linestyle="--", linewidth=0.8)
        for table, colour in zip(later, style.sequence(len(steps))):
            profile(axes, line, table, color=colour)
        frame(axes, [start, *later], line.axis)
    labels = [f"{style.number(result.times[step])} s" for step in [0, *steps]]
    labels[0] += limit(panels[0], tables)
    handles = panels[0].get_lines()
    for handle, label in zip(handles, labels):
        handle.set_label(label)
    style.legend_above_all(figure, handles)
    return figure


def draw_two(first, second):
    """At the times that both have stored: colours show time, dashes the second result."""
    if first.attribute("problem") != second.attribute("problem"):
        raise Unsuitable("the results are of different problems")
    pairs = [(i, j) for i in first.some_steps(MOST_TIMES) for j, t in enumerate(second.times)
             if numpy.isclose(first.times[i], t, rtol=1e-9)]
    if not pairs:
        raise Unsuitable("the results share no time after the start")
    lines, others = curves.of(first), curves.of(second)
    figure, panels = panels_for(lines)
    colours = style.sequence(len(pairs))
    for axes, line, other in zip(panels, lines, others):
        tables = [(line.at(i), other.at(j)) for i, j in pairs]
        for (one, two), colour in zip(tables, colours):
            profile(axes, line, one, color=colour)
            profile(axes, other, two, color=colour, linestyle=style.DASHES)
        frame(axes, [table for pair in tables for table in pair], line.axis)
    panels[0].set_ylim(bottom=0)
    times = [Line2D([], [], color=colour, label=f"{style.number(first.times[i])} s")
             for (i, _), colour in zip(pairs, colours)]
    names = [Line2D([], [], color="black", linestyle=dashes, label=title(result))
             for result, dashes in ((first, "-"), (second, style.DASHES))]
    style.legend_above_all(figure, names, times)
    return figure


def title(result):
    return f"{result.name} ({len(result.history) - 1} steps)"


def panels_for(lines):
    """One panel per curve."""
    width = style.SINGLE if len(lines) == 1 else style.DOUBLE
    figure = style.figure(width=width, height=0.62 * style.SINGLE)
    panels = figure.subplots(1, len(lines), sharey=True, squeeze=False)[0]
    panels[0].set_ylabel("contact pressure [MPa]")
    for axes, line in zip(panels, lines):
        axes.set_xlabel(f"${line.axis}$ [mm]" + (f"   at {line.where}" if line.where else ""))
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


def limit(axes, tables):
    """Cuts off a peak at the start if the later pressures would look flat, and says so."""
    start = max(start["pressure"].max() for start, *_ in tables)
    later = max((table["pressure"].max() for _, *rest in tables for table in rest), default=0)
    if 0 < 4 * later < start:
        axes.set_ylim(0, 1.15 * later)
        return f" (up to {style.number(start)} MPa)"
    axes.set_ylim(bottom=0)
    return ""
