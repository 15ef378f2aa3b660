"""Contact pressure: profiles at stored times, in space along and across the sliding direction
(figs. 11, 15), and those of two results in one figure (fig. 11)."""

from itertools import combinations

import numpy
from matplotlib.lines import Line2D

from . import curves, style
from .complaints import Unsuitable
from .shape import MOST_TIMES, joined

READABLE = 4  # times the lowest peak: higher ones get panels of their own
MOST_ROWS = 3


def draw(result):
    steps = [0, *result.some_steps(MOST_TIMES)]
    lines = curves.of_whole_surface(result, steps)
    tables = [[line.at(step) for step in steps] for line in lines]
    looks = [{"color": "black", "linestyle": "--", "linewidth": 0.8},
             *({"color": colour} for colour in style.sequence(len(steps) - 1))]
    groups = groups_of([peak(states) for states in zip(*tables)])
    figure, rows = panels_for(lines, len(groups), name_of(result))
    handles = {}
    for panels, group in zip(rows, groups):
        for axes, line, states in zip(panels, lines, tables):
            for k in group:
                handles[k] = profile(axes, line, states[k], **looks[k])
                handles[k].set_label(result.clock.text(result.times[steps[k]]))
            frame(axes, states, line.axis)
        end_at(panels[0], [states[k] for states in tables for k in group])
    style.legend_above_all(figure, [handles[k] for k in range(len(steps))])
    figure.align_ylabels()
    return figure


def draw_two(first, second):
    """At the times that both have stored: colours show time, black the start, dashes the second
    result. Below, the pressure of the second minus that of the first."""
    if first.attribute("problem") != second.attribute("problem"):
        raise Unsuitable("the results are of different problems")
    pairs = [(i, j) for i in (0, *first.some_steps(MOST_TIMES)) for j, t in enumerate(second.times)
             if numpy.isclose(first.times[i], t, rtol=1e-9)]
    if not pairs:
        raise Unsuitable("the results share no time")
    lines = curves.of_whole_surface(first, [i for i, _ in pairs])
    others = curves.of_whole_surface(second, [j for _, j in pairs])
    tables = [[(line.at(i), other.at(j)) for i, j in pairs] for line, other in zip(lines, others)]
    require_same_places(lines[0], others[0], *tables[0][0])
    groups = groups_of([peak(sum(states, ())) for states in zip(*tables)])
    figure, (*rows, below) = panels_for(lines, len(groups), name_of(first),
                                          differences=True)
    after = [i for i, _ in pairs if i > 0]
    colours = ["black"] * (len(pairs) - len(after)) + style.sequence(len(after))
    for panels, group in zip(rows, groups):
        for axes, line, other, states in zip(panels, lines, others, tables):
            for k in group:
                # Dots of close nodes would hide the dashes.
                profile(axes, line, states[k][0], color=colours[k], marker="")
                profile(axes, other, states[k][1], color=colours[k], marker="",
                        linestyle=style.DASHES)
        end_at(panels[0], [table for states in tables for k in group for table in states[k]])
    for lower, line, states in zip(below, lines, tables):
        lower.axhline(0, color=style.GREY, linewidth=0.6)
        for (one, two), colour in zip(states, colours):
            lower.plot(*difference(one, two, line.axis), color=colour)
        frame(lower, [table for pair in states for table in pair], line.axis)
    times = [Line2D([], [], color=colour, label=first.clock.text(first.times[i]))
             for (i, _), colour in zip(pairs, colours)]
    names = [Line2D([], [], color="black", linestyle=dashes, label=title(result))
             for result, dashes in ((first, "-"), (second, style.DASHES))]
    style.legend_above_all(figure, names, times)
    figure.align_ylabels()
    return figure


def require_same_places(line, other, first, second):
    """Lengths are of the same places only if they begin at the same one and go the same way round;
    which it is on a closed surface depends on the mesh."""
    size = numpy.ptp(first[line.axis])
    same = line.axis == other.axis
    if same and line.axis == "length":
        tables = first, second
        starts = [[table[name][numpy.abs(table["length"]).argmin()] for name in ("X0", "Y0")]
                  for table in tables]
        later = max(table["length"][0] for table in tables) + 0.1 * size
        places = [[numpy.interp(later, table["length"], table[name]) for name in ("X0", "Y0")]
                  for table in tables]
        same = (numpy.allclose(*starts, rtol=0, atol=1e-6 * size)
                and numpy.allclose(*places, rtol=0, atol=0.02 * size))
    if not same:
        raise Unsuitable("it is not known which places of the two surfaces are the same")


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


def name_of(result):
    """Of a cycle, what is stored with the contact surface is the mean over it."""
    return "contact pressure" if result.clock.unit == "s" else "mean contact pressure"


def panels_for(lines, rows, pressure_name, differences=False):
    """One column per curve; rows of pressures and a lower one for differences."""
    width = style.SINGLE if len(lines) == 1 else style.DOUBLE
    shares = [1.7] * rows + [1.0] * differences
    figure = style.figure(width=width, height=(0.18 + 0.26 * sum(shares)) * style.SINGLE)
    panels = figure.subplots(len(shares), len(lines), sharex="col", sharey="row", squeeze=False,
                             height_ratios=shares)
    for axes in panels[:rows, 0]:
        axes.set_ylabel(f"{pressure_name} [MPa]")
    if differences:
        panels[-1, 0].set_ylabel("second − first\n[MPa]")
    for axes, line in zip(panels[-1], lines):
        axes.set_xlabel(line.label())
    return figure, panels


def profile(axes, line, table, **look):
    """Over the current position, where the pressure acts, or the length along the surface."""
    columns = joined(line.breaks, table[line.axis], table["pressure"])
    return axes.plot(*columns, **({"marker": ".", "markersize": 2.2} | look))[0]


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


def groups_of(peaks):
    """Curves, by their numbers, that can be read on one axis, the highest first: their peaks are
    within READABLE of the lowest one, as far as MOST_ROWS axes suffice. Those without contact are
    with the lowest."""
    order = sorted((k for k in range(len(peaks)) if peaks[k] > 0), key=lambda k: -peaks[k])
    without = [k for k in range(len(peaks)) if peaks[k] <= 0]
    groups = min((split(order, ends) for count in range(MOST_ROWS)
                  for ends in combinations(range(1, len(order)), count)),
                 key=lambda made: (max(READABLE, spread(peaks, made)), len(made)))
    groups[-1] += without
    return [sorted(group) for group in groups]


def split(order, ends):
    return [order[low:high] for low, high in zip((0, *ends), (*ends, len(order)))]


def spread(peaks, groups):
    """The largest ratio of peaks that have an axis in common."""
    return max(peaks[group[0]] / peaks[group[-1]] if group else 1 for group in groups)


def end_at(axes, tables):
    highest = peak(tables)
    axes.set_ylim(0, 1.08 * highest if highest > 0 else None)
