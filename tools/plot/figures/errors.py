"""Error against the step or the tolerance (figs. 5, 6)."""

import math

import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, NullFormatter

from . import style
from .complaints import Unsuitable
from .study import distinct

ROOM_ABOVE = 1e3  # times the largest error of a sound run; what exploded further sits at the edge


def draw_steps(runs):
    return draw([run for run in runs if run.fixed_step], "step [s]", "no run has a fixed step")


def draw_tolerances(runs):
    return draw([run for run in runs if not run.fixed_step], "relative tolerance",
                "no run has a tolerance")


def draw(runs, across, otherwise):
    """Several sweep values: a panel a method, a colour a value. One value: a colour a method."""
    if not any(math.isfinite(run.shape_error) for run in runs):
        raise Unsuitable(otherwise)
    swept = len(distinct(run.sweep for run in runs)) > 1
    titles = distinct(run.method for run in runs) if swept else [""]
    names = distinct(run.sweep if swept else run.method for run in runs)
    looks = looks_of(names, ordered=swept)
    figure, panels = panels_for(len(titles))
    limits = error_limits(runs)
    for panel, title in zip(panels, titles):
        members = [run for run in runs if not swept or run.method == title]
        draw_panel(panel, members, looks, lambda run: run.sweep if swept else run.method, limits)
        panel.set_title(title)
    finish(figure, panels, across, handles_of(looks, runs, limits))
    return figure


def looks_of(names, ordered):
    colours = style.sequence(len(names)) if ordered else style.COLOURS
    return {name: {"color": colours[i % len(colours)],
                   "marker": style.MARKERS[i % len(style.MARKERS)],
                   "linestyle": "-" if i < len(style.MARKERS) else "--"}
            for i, name in enumerate(names)}


def panels_for(count):
    """Two or fewer stand in one column, more fill the page's width."""
    columns = 1 if count <= 2 else 3
    rows = math.ceil(count / columns)
    width = style.SINGLE if columns == 1 else style.DOUBLE
    figure = style.figure(width, rows * 0.68 * width / (columns * 0.92) + 0.3)
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for spare in panels.flat[count:]:
        spare.remove()
    return figure, list(panels.flat[:count])


def error_limits(runs):
    errors = [run.shape_error for run in runs if math.isfinite(run.shape_error) and run.shape_error > 0]
    sound = [run.shape_error for run in runs if run.finished and run.shape_error > 0] or errors
    typical = numpy.median(sound)
    top = min(max(errors), ROOM_ABOVE * typical)
    references = [run.reference_error for run in runs if run.reference_error > 0]
    low = min(errors + [0.5 * reference for reference in references])
    return 0.5 * low, 4 * top


def draw_panel(axes, runs, looks, key, limits):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(limits)
    references = [run.reference_error for run in runs if run.reference_error > 0]
    if references:
        axes.axhspan(limits[0], max(references), color=style.BAND, zorder=0, linewidth=0)
    draw_guides(axes, runs, key)
    for name, look in looks.items():
        members = sorted((run for run in runs if key(run) == name), key=lambda run: run.setting)
        draw_series(axes, members, look, limits)


def draw_series(axes, runs, look, limits):
    """Beyond the limits, or without an error at all: a cross at the upper edge."""
    edge = limits[1] / 1.5
    heights = [min(run.shape_error, edge) if math.isfinite(run.shape_error) else edge
               for run in runs]
    axes.plot([run.setting for run in runs], heights, **(look | {"marker": ""}))
    for run, height in zip(runs, heights):
        lost = height >= edge
        axes.plot(run.setting, height, marker="x" if lost else look["marker"], color=look["color"],
                  markersize=5 if lost else 3.5,
                  markerfacecolor="white" if run.marked else look["color"], clip_on=False)


def draw_guides(axes, runs, key):
    """Lines of slope 1, and of the higher orders that are seen, below the lowest series."""
    series = [[run for run in runs if key(run) == name and run.finished and run.shape_error > 0]
              for name in distinct(key(run) for run in runs)]
    orders = sorted({1} | {order_of(members) for members in series if len(members) > 2})
    x = numpy.array(sorted({run.setting for run in runs}))[[0, -1]]
    for order in orders:
        own = [members for members in series if len(members) > 2 and order_of(members) == order]
        base = min((run for members in own or series for run in members),
                   key=lambda run: run.shape_error / run.setting**order, default=None)
        if base is not None:
            draw_guide(axes, x, order, 0.5 * base.shape_error / base.setting**order)


def draw_guide(axes, x, order, factor):
    axes.plot(x, factor * x**order, color=style.GREY, linewidth=0.7, linestyle=(0, (5, 2)), zorder=1)


def order_of(runs):
    x = numpy.log([run.setting for run in runs])
    y = numpy.log([run.shape_error for run in runs])
    order = numpy.argsort(x)
    slopes = numpy.diff(y[order]) / numpy.diff(x[order])
    return int(numpy.clip(numpy.round(numpy.median(slopes)), 1, 5))


def handles_of(looks, runs, limits):
    handles = [Line2D([], [], label=name, **look) for name, look in looks.items()]
    if any(not run.shape_error < limits[1] / 1.5 for run in runs):
        handles.append(Line2D([], [], color="black", linestyle="", marker="x", markersize=5,
                              label="beyond, or failed"))
    if any(run.marked for run in runs):
        handles.append(Line2D([], [], color="black", linestyle="", marker="o",
                              markerfacecolor="white", label="marked in the table"))
    if any(run.reference_error > 0 for run in runs):
        handles.append(Patch(color=style.BAND, linewidth=0, label="reference's own error"))
    handles.append(Line2D([], [], color=style.GREY, linewidth=0.7, linestyle=(0, (5, 2)),
                          label="slope 1, 2, ..."))
    return handles


def finish(figure, panels, across, handles):
    for axes in panels:
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel("shape error [mm]")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_major_locator(LogLocator(numticks=8))
        axes.yaxis.set_minor_formatter(NullFormatter())
    lowest = max(axes.get_subplotspec().rowspan.start for axes in panels)
    for axes in panels:
        if axes.get_subplotspec().rowspan.start == lowest:
            axes.set_xlabel(across)
    style.legend_above_all(figure, handles)
