"""Work and precision: error against Newton iterations, factorizations and wall time."""

import numpy
from matplotlib.lines import Line2D

from . import style
from .complaints import Unsuitable
from .errors import (ROOM_ABOVE, draw_reference, error_limits, handles_of, has_band, looks_of,
                     reference_note, sweep_text)
from .study import distinct

COSTS = {"newton_iterations": "Newton iterations", "factorizations": "factorizations",
         "wall_seconds": "wall time [s]"}
FIXED = (0, (1.2, 1.2))  # dashes of series with fixed steps


def draw(runs):
    """For one value of the sweep, without failed runs."""
    every = len(runs)
    runs = sound(runs)
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
    panels[len(panels) // 2].set_title(sweep_text(runs[0].sweep))
    style.legend_above_all(figure, handles_of(looks),
                           notes_of(runs, every - len(runs), has_band(runs, limits)))
    return figure


def sound(runs):
    """Finished runs whose errors are not far above the others."""
    runs = [run for run in runs if run.finished and run.shape_error > 0]
    typical = numpy.median([run.shape_error for run in runs]) if runs else 0
    return [run for run in runs if run.shape_error < ROOM_ABOVE * typical]


def draw_panel(axes, runs, looks, cost, limits):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.tick_params(which="both", top=False, right=False)
    draw_reference(axes, runs, limits)
    both = len({run.fixed_step for run in runs}) == 2
    for name, look in looks.items():
        for fixed in (True, False):
            members = [run for run in runs if run.method == name and run.fixed_step == fixed
                       and getattr(run, cost) > 0]
            members.sort(key=lambda run: run.setting)
            axes.plot([getattr(run, cost) for run in members],
                      [run.shape_error for run in members],
                      linestyle=FIXED if fixed and both else "-", **look)
    style.log_ticks(axes.xaxis)
    style.log_ticks(axes.yaxis)


def notes_of(runs, left_out, band):
    both = len({run.fixed_step for run in runs}) == 2
    notes = [Line2D([], [], color="black", linestyle=FIXED if fixed else "-",
                    label="fixed steps" if fixed else "steps by tolerance")
             for fixed in (True, False) if any(run.fixed_step == fixed for run in runs) and both]
    if band:
        notes.append(reference_note())
    if left_out:
        notes.append(Line2D([], [], linestyle="", label=f"{left_out} failed or far off: not drawn"))
    return notes
