"""Worn volume against the integral of the wear rate: they agree when the integrator is accurate."""

import numpy

from . import style
from .complaints import Unsuitable


def draw(result):
    table = result.history
    for name in ("worn_volume", "wear_integral"):
        if name not in table.dtype.names:
            raise Unsuitable(f"the history has no column {name}")
    if len(table) < 2:
        raise Unsuitable("no step was taken")
    unit = result.history_units.get("worn_volume", "")
    figure = style.figure(height=0.95 * style.SINGLE)
    volumes, difference = figure.subplots(2, 1, sharex=True, height_ratios=[1.6, 1])
    unit_of_time, seconds = result.clock
    t, volume, integral = table["t"] / seconds, table["worn_volume"], table["wear_integral"]
    volumes.plot(t, volume, color=style.COLOURS[0], label="worn volume")
    volumes.plot(t, integral, color=style.COLOURS[1], linestyle=(0, (4, 3)), label="wear integral")
    volumes.set_ylim(bottom=0)
    volumes.set_ylabel(f"wear [{style.power(unit)}]")
    style.legend(volumes, columns=2)
    draw_difference(difference, t, volume, integral)
    difference.set_xlabel("time [s]" if unit_of_time == "s" else unit_of_time)
    difference.set_xlim(t[0], t[-1])
    figure.align_ylabels()
    return figure


def draw_difference(axes, t, volume, integral):
    worn = integral > 0
    percent = 100 * (volume[worn] / integral[worn] - 1)
    axes.axhline(0, color=style.GREY, linewidth=0.6)
    axes.plot(t[worn], percent, color=style.COLOURS[0], marker=".", markersize=2)
    axes.set_ylabel("volume − integral\n[% of integral]")
    finite = percent[numpy.isfinite(percent)]
    if len(finite) and numpy.ptp(finite) == 0:
        axes.set_ylim(finite[0] - 1, finite[0] + 1)
