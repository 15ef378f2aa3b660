"""Contact pressure: profiles at stored times in 2D."""

import numpy

from . import style
from .complaints import Unsuitable
from .shape import MOST_TIMES


def draw(result):
    if result.dim != 2:
        raise Unsuitable("the contact surface is not a curve; see the map of the pressure")
    steps = result.some_steps(MOST_TIMES)
    figure = style.figure(height=0.68 * style.SINGLE)
    axes = figure.add_subplot()
    profile(axes, result, 0, color="black", linestyle="--", linewidth=0.8)
    for step, colour in zip(steps, style.sequence(len(steps))):
        profile(axes, result, step, color=colour)
    frame(axes, result, steps)
    axes.set_xlabel("$x$ [mm]")
    axes.set_ylabel("contact pressure [MPa]")
    style.legend(axes, columns=4)
    return figure


def profile(axes, result, step, **look):
    """Over the current position: where the pressure acts."""
    table = result.contact(step)
    order = numpy.argsort(table["x"])
    axes.plot(table["x"][order], table["pressure"][order], marker=".", markersize=2.2,
              label=f"{style.number(result.times[step])} s", **look)


def frame(axes, result, steps):
    """The part that was ever in contact, and a margin."""
    reach = [-numpy.inf, numpy.inf]
    for step in [0, *steps]:
        table = result.contact(step)
        loaded = table["x"][table["pressure"] > 0]
        if len(loaded):
            reach = [max(reach[0], loaded.max()), min(reach[1], loaded.min())]
    if reach[0] > reach[1]:
        margin = 0.12 * (reach[0] - reach[1])
        axes.set_xlim(reach[1] - margin, reach[0] + margin)
    axes.set_ylim(bottom=0)
