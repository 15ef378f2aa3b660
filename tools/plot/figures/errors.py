"""Error against the step or the tolerance (figs. 5, 6), or against the work for each value of a
sweep."""

import math

import numpy
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import style
from .complaints import Unsuitable
from .study import distinct

ROOM_ABOVE = 1e3  # times the median error; larger errors are drawn at the edge

SELF = {"marker": "", "linestyle": (0, (1, 1)), "linewidth": 0.9}  # against a run of the study

SYMBOLS = {"body.young_modulus": "$E$ [MPa]", "mesh.elements": "mesh",
           "integrator.nonlinear_fraction": "$\\kappa$"}


def draw_steps(runs):
    return draw([run for run in runs if run.fixed_step], "step [s]", "no run has a fixed step")


def draw_tolerances(runs):
    return draw([run for run in runs if not run.fixed_step], "relative tolerance",
                "no run has a tolerance")


def draw_sweep_work(runs):
    if len(distinct(run.sweep for run in runs)) < 2:
        raise Unsuitable("the study has no sweep")
    return draw(runs, "Newton iterations", "", "newton_iterations")


def draw_sweep_time(runs):
    """Of a sweep over meshes, whose iterations cost different times."""
    if not any(run.sweep.startswith("mesh.") for run in runs):
        raise Unsuitable("the study has no sweep over meshes")
    return draw(runs, "CPU time [s]", "", "cpu_seconds", with_self=True)


def draw(runs, across, otherwise, x="setting", with_self=False):
    """Several sweep values: a panel for each method, a colour for each value. One value: a colour
    for each method."""
    if not any(0 < run.shape_error < math.inf for run in runs):
        raise Unsuitable("no run has an error" if runs else otherwise)
    swept = len(distinct(run.sweep for run in runs)) > 1
    titles = distinct(run.method for run in runs) if swept else [""]
    names = distinct(run.sweep if swept else run.method for run in runs)
    looks = looks_of(names, ordered=swept)
    figure, panels = panels_for(len(titles))
    limits = error_limits(runs, with_self)
    guides = False
    for panel, title in zip(panels, titles):
        members = [run for run in runs if not swept or run.method == title]
        guides |= draw_panel(panel, members, looks,
                             lambda run: run.sweep if swept else run.method, limits, x)
        panel.set_title(title)
    finish(figure, panels, across)
    style.legend_above_all(figure, handles_of(looks), notes_of(runs, limits, guides))
    return figure


def looks_of(names, ordered):
    colours = style.sequence(len(names)) if ordered else style.COLOURS
    return {name: {"color": colours[i % len(colours)],
                   "marker": style.MARKERS[(i + i // len(colours)) % len(style.MARKERS)]}
            for i, name in enumerate(names)}


def panels_for(count):
    """Up to two panels are in one column, more fill the page's width."""
    columns = 1 if count <= 2 else 2 if count == 4 else 3
    rows = math.ceil(count / columns)
    width = style.SINGLE if columns == 1 else style.DOUBLE
    figure = style.figure(width, rows * 0.68 * width / (columns * 0.92) + 0.3)
    panels = figure.subplots(rows, columns, sharex=True, sharey=True, squeeze=False)
    for spare in panels.flat[count:]:
        spare.remove()
    return figure, list(panels.flat[:count])


def error_limits(runs, with_self=False):
    errors = [run.shape_error for run in runs if 0 < run.shape_error < math.inf]
    sound = [run.shape_error for run in runs if run.finished and run.shape_error > 0] or errors
    typical = numpy.median(sound)
    top = min(max(errors), ROOM_ABOVE * typical)
    # Errors of references that are far below the measured errors would take too much space.
    low = min(errors)
    if with_self:
        low = min([low, *(run.shape_error_self for run in runs if run.shape_error_self > 0)])
    references = [run.reference_error for run in runs if run.reference_error > 0.1 * low]
    return 0.5 * min([low, *references]), 4 * top


def draw_panel(axes, runs, looks, key, limits, x):
    """True if there are lines of slope."""
    axes.set_xmargin(0.1)  # space for the numbers of the slopes
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.tick_params(which="both", top=False, right=False)
    draw_reference(axes, runs, limits)
    for name, look in looks.items():
        for fixed in (True, False):
            members = sorted((run for run in runs if key(run) == name and run.fixed_step == fixed),
                             key=lambda run: run.setting)
            draw_series(axes, members, look, limits, x)
    return x == "setting" and draw_guides(axes, runs, key)


def draw_reference(axes, runs, limits):
    """The band in which a difference from the reference has no meaning."""
    axes.set_ylim(limits)
    if has_band(runs, limits):
        highest = max(run.reference_error for run in runs if run.reference_error > 0)
        axes.axhspan(limits[0], highest, color=style.BAND, zorder=0, linewidth=0)


def has_band(runs, limits):
    return any(run.reference_error > limits[0] for run in runs)


def draw_series(axes, runs, look, limits, across):
    """A cross for unstable runs, and at the upper edge for errors beyond the limits and for runs
    without an error."""
    edge = limits[1] / 1.5
    x = numpy.array([getattr(run, across) for run in runs])
    errors = numpy.array([run.shape_error for run in runs])
    lost = ~(errors < edge)
    crossed = lost | numpy.array([run.unstable for run in runs], bool)
    marked = numpy.array([run.marked for run in runs], bool) & ~crossed
    y = numpy.where(lost, edge, errors)
    axes.plot(x, y, **(look | {"marker": ""}))
    axes.plot(x, [run.shape_error_self for run in runs], **(look | SELF))
    hollow = {"markerfacecolor": "white", "markeredgewidth": 0.7}
    cross = {"marker": "x", "markersize": 5}
    for chosen, sign in ((~crossed & ~marked, {}), (marked, hollow), (crossed, cross)):
        if chosen.any():
            axes.plot(x[chosen], y[chosen], **(look | {"linestyle": ""} | sign))


def draw_guides(axes, runs, key):
    """Lines of slope 1 and of the highest observed order, each below its lowest series; returns
    false if no series is long enough to have a slope."""
    series = [[run for run in runs if key(run) == name and run.finished and run.shape_error > 0
               and not run.unstable] for name in distinct(key(run) for run in runs)]
    series = {order: [runs for runs in series if order_of(runs) == order]
              for order in {order_of(runs) for runs in series} - {0}}
    every = [run for group in series.values() for runs in group for run in runs]
    for order in sorted({1, max(series, default=1)}):
        own = [run for runs in series.get(order, []) for run in runs] or every
        if own:
            factor = 0.5 * min(run.shape_error / run.setting**order for run in own)
            draw_guide(axes, sorted(run.setting for run in own), order, factor)
    return bool(every)


def draw_guide(axes, settings, order, factor):
    x = numpy.array([settings[0], settings[-1]])
    y = factor * x**order
    axes.plot(x, y, color=style.GREY, linewidth=0.7, linestyle=style.DASHES, zorder=1)
    text = axes.annotate(str(order), (x[1], y[1]), (3, 0), textcoords="offset points", va="center",
                         fontsize=7, color="#555555", annotation_clip=True)
    text.set_in_layout(False)


def order_of(runs):
    """The slope of most of the series, rounded; 0 if there is none."""
    if len(runs) < 3:
        return 0
    runs = sorted(runs, key=lambda run: run.setting)
    slopes = numpy.diff(numpy.log([run.shape_error for run in runs])) / numpy.diff(
        numpy.log([run.setting for run in runs]))
    return int(numpy.clip(numpy.round(numpy.median(slopes)), 1, 5))


def notes_of(runs, limits, guides):
    """The meaning of the signs that occur."""
    notes = []
    if any(run.unstable or not run.shape_error < limits[1] / 1.5 for run in runs):
        notes.append(Line2D([], [], color="black", linestyle="", marker="x", markersize=5,
                            label="unstable, beyond, or failed"))
    if has_band(runs, limits):
        notes.append(reference_note())
    if any(run.marked for run in runs):
        known = any(run.reference_error > 0 for run in runs)
        notes.append(Line2D([], [], color="black", linestyle="", marker="o",
                            markerfacecolor="white",
                            label="below 10× the reference's error" if known else "by an unsure reference"))
    if any(run.shape_error_self > 0 for run in runs):
        notes.append(Line2D([], [], color="black", **SELF, label="against the study's own run"))
    if guides:
        notes.append(Line2D([], [], color=style.GREY, linewidth=0.7, linestyle=style.DASHES,
                            label="slope, as numbered"))
    return notes


def reference_note():
    return Patch(color=style.BAND, linewidth=0, label="error of the reference")


def finish(figure, panels, across):
    for axes in panels:
        if axes.get_subplotspec().is_first_col():
            axes.set_ylabel("shape error [mm]")
        style.log_ticks(axes.xaxis)
        style.log_ticks(axes.yaxis)
    columns = panels[0].get_subplotspec().get_gridspec().ncols
    for axes in panels[-columns:]:  # the lowest of each column, whether or not its row is full
        axes.set_xlabel(across)
        axes.tick_params(labelbottom=True)


def handles_of(looks):
    """Sweep values by one key, "body.young_modulus=20": the first one says the key."""
    key = common_key(looks)
    names = [name.removeprefix(key + "=") if key else name for name in looks]
    if key:
        names[0] = SYMBOLS.get(key, key.rpartition(".")[2]) + ": " + names[0]
    return [Line2D([], [], label=name, **look) for name, look in zip(names, looks.values())]


def sweep_text(sweep):
    """A value of the sweep as a title: "body.young_modulus=20" is "E [MPa]: 20"."""
    parts = (part.partition("=") for part in sweep.split("; ") if part)
    return ", ".join(f"{SYMBOLS.get(key, key.rpartition('.')[2])}: {value}"
                     for key, _, value in parts)


def common_key(names):
    keys = {name.partition("=")[0] if name.count("=") == 1 else "" for name in names}
    return keys.pop() if len(keys) == 1 else ""
