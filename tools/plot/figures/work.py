"""Work and precision: errors against Newton iterations, factorizations and CPU time."""

import numpy
from matplotlib.lines import Line2D

from . import style
from .complaints import Unsuitable
from .errors import (ROOM_ABOVE, draw_reference, error_limits, handles_of, has_band, looks_of,
                     reference_note, sweep_text)
from .study import distinct

COSTS = {"newton_iterations": "Newton iterations", "factorizations": "factorizations",
         "cpu_seconds": "CPU time [s]"}  # wall time depends more on other processes
ERRORS = {"shape_error": "shape error [mm]", "pressure_error": "pressure error [MPa]"}
FIXED = (0, (1.2, 1.2))  # dashes of series with fixed steps
# Of the second and third method of one integrator, which share the colour of the first.
VARIANTS = [{}, *({"linestyle": dashes, "linewidth": 0.8, "markerfacecolor": "white",
                   "markeredgewidth": 0.7} for dashes in (style.DASHES, (0, (5, 1.5, 1, 1.5))))]


def draw(runs):
    """For one value of the sweep, without failed runs."""
    every = len(runs)
    runs = sound(runs)
    if not runs:
        raise Unsuitable("no run finished with an error")
    looks = looks_of_methods(runs)
    errors = [error for error in ERRORS if any(getattr(run, error) > 0 for run in runs)]
    figure = style.figure(style.DOUBLE, 0.38 * style.DOUBLE * len(errors))
    panels = figure.subplots(len(errors), len(COSTS), sharex="col", sharey="row", squeeze=False)
    limits = error_limits(runs)
    for row, error in zip(panels, errors):
        for axes, cost in zip(row, COSTS):
            draw_panel(axes, runs, looks, cost, error)
            if error == "shape_error":
                draw_reference(axes, runs, limits)
            style.log_ticks(axes.yaxis)
        row[0].set_ylabel(ERRORS[error])
    for axes, label in zip(panels[-1], COSTS.values()):
        axes.set_xlabel(label)
        style.log_ticks(axes.xaxis)
    panels[0][len(COSTS) // 2].set_title(sweep_text(runs[0].sweep))
    style.legend_above_all(figure, handles_of(looks),
                           notes_of(runs, every - len(runs), has_band(runs, limits)))
    return figure


def looks_of_methods(runs):
    """A colour and a sign for each integrator; its first method has filled signs."""
    own = looks_of(distinct(run.integrator for run in runs), ordered=False)
    methods = distinct((run.integrator, run.method) for run in runs)
    looks = {}
    for k, (integrator, method) in enumerate(methods):
        earlier = sum(other == integrator for other, _ in methods[:k])
        looks[method] = own[integrator] | VARIANTS[min(earlier, len(VARIANTS) - 1)]
    return looks


def sound(runs):
    """Finished runs whose errors are not far above the others."""
    runs = [run for run in runs if run.finished and run.shape_error > 0]
    typical = numpy.median([run.shape_error for run in runs]) if runs else 0
    return [run for run in runs if run.shape_error < ROOM_ABOVE * typical]


def draw_panel(axes, runs, looks, cost, error):
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.tick_params(which="both", top=False, right=False)
    both = len({run.fixed_step for run in runs}) == 2
    for name, look in looks.items():
        for fixed in (True, False):
            members = [run for run in runs if run.method == name and run.fixed_step == fixed
                       and getattr(run, cost) > 0 and getattr(run, error) > 0]
            members.sort(key=lambda run: run.setting)
            axes.plot([getattr(run, cost) for run in members],
                      [getattr(run, error) for run in members],
                      **(look | ({"linestyle": FIXED} if fixed and both else {})))


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
