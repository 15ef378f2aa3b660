"""Steady rolling at the end: pressure and traction of friction along the contact, and the slip of
material from one node to the next. In space along x at y = 0."""

import numpy

from . import curves, style


def draw(result):
    figure = style.figure(width=style.DOUBLE, height=0.7 * style.SINGLE)
    stress, slip = figure.subplots(1, 2)
    step = len(result.times) - 1
    line = curves.that_slip(result, step)[0]
    where, pressure, traction, slipped = along(result, line, step)
    stress.plot(where, pressure, color=style.COLOURS[0], label="pressure")
    stress.plot(where, traction, color=style.COLOURS[5], marker="o", markersize=2,
                label="traction of friction")
    slip.plot(where, 1e6 * slipped, color=style.COLOURS[5], marker="o", markersize=2)
    for axes in (stress, slip):
        axes.set_xlabel(line.label(initial=True))
        axes.set_ylim(bottom=0)
    stress.legend()
    stress.set_ylabel("stress [MPa]")
    slip.set_ylabel("slip from node to node [nm]")
    slip.set_title("$t$ = " + result.clock.text(result.times[step]))
    return figure


def along(result, line, step):
    """Where it is in contact: positions on the initial surface, pressures, and the magnitudes of
    tractions and slip."""
    table = result.contact(step)
    rows = []
    for values in (result.phase_pressure(step)[0],
                   numpy.linalg.norm(result.phase_traction(step)[0], axis=1),
                   numpy.linalg.norm(result.phase_slip(step)[0], axis=1)):
        of_quantity = table.copy()
        of_quantity["pressure"] = values
        rows.append(line.of(of_quantity))
    closed = rows[0]["pressure"] > 0
    where = rows[0][line.axis.upper() + "0"]
    return where[closed], *(row["pressure"][closed] for row in rows)
