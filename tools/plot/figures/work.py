"""Work and precision: error against Newton iterations, factorizations and wall time."""

import math

from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import NullFormatter

from . import style
from .complaints import Unsuitable
from .errors import error_limits, looks_of
from .study import distinct

COSTS = {"newton_iterations": "Newton iterations", "factorizations": "factorizations",
         "wall_seconds": "wall time [s]"}


def draw(runs):
    """Of one value of the sweep. Runs that failed have no place here."""
    runs = [run for run in runs if run.finished and run.shape_error > 0]
    if not runs:
        raise Unsuitable("no run finished with an error")
    looks = looks_of(distinct(run.method for run in runs), ordered=False)
    figure = style.figure(style.DOUBLE, 0.4 * style.DOUBLE)
    panels = figure.subplots(1, len(COSTS), sharey=True)
    limits = error_limits(runs)
    for axes, (cost, label) in zip(panels, COSTS.items()):
        draw_panel(axes, runs, looks, cost, limits)
        axes.set_xlabel(label)
    panels[0].set_ylabel("shape error [mm]")
    style.legend_above_all(figure, handles_of(looks, runs))
    return figure


def draw_panel(axes, runs, looks, cost, limits):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_ylim(limits)
    references = [run.reference_error for run in runs if run.reference_error > 0]
    if references:
        axes.axhspan(limits[0], max(references), color=style.BAND, zorder=0, linewidth=0)
    for name, look in looks.items():
        members = [run for run in runs if run.method == name and getattr(run, cost) > 0]
        members.sort(key=lambda run: run.setting)
        inside = [min(run.shape_error, limits[1] / 1.5) for run in members]
        axes.plot([getattr(run, cost) for run in members], inside, **look)
    axes.xaxis.set_minor_formatter(NullFormatter())


def handles_of(looks, runs):
    handles = [Line2D([], [], label=name, **look) for name, look in looks.items()]
    if any(math.isfinite(run.reference_error) and run.reference_error > 0 for run in runs):
        handles.append(Patch(color=style.BAND, linewidth=0, label="reference's own error"))
    return handles
