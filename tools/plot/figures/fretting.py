"""Friction that may stick, over a cycle: the loop of the force that moves the partner over its
place, at the start and at up to two stored times, and where the contact sticks and slips at the
end. In space along x at y = 0."""

import numpy
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from . import cycle, curves, style

MOST_TIMES = 2
STATES = ("open", "sticks", "slips")
STUCK = 1e-3  # of the longest slip in a phase of the cycle: less is creep of a node at its limit


def draw(result):
    figure = style.figure(width=style.DOUBLE, height=0.8 * style.SINGLE)
    loop, zones = figure.subplots(1, 2)
    draw_loops(loop, result)
    draw_zones(zones, result)
    return figure


def draw_loops(axes, result):
    """Along the direction in which the partner moves most to and fro beside the press, or about the
    axis about which it turns."""
    steps = [0, *result.some_steps(MOST_TIMES)]
    along = None if result.turns else driven(result.phase_loop(steps[-1]), result.dim)
    for step, colour in zip(steps, style.COLOURS):
        place, force = loop_of(result, step, along)
        axes.plot(1e3 * numpy.append(place, place[0]), numpy.append(force, force[0]), color=colour,
                  marker="o", markersize=2, label="$t$ = " + result.clock.text(result.times[step]))
    whole = result.dim == 3 or result.axes[0] == "r"
    partner = "other body" if result.has_pairs else "counter-body"
    if along is None:
        axes.set_xlabel(f"angle of the {partner} [mrad]")
        axes.set_ylabel(f"moment about its axis [{'N mm' if whole else 'N'}]")
    else:
        name = result.axes[along]
        axes.set_xlabel(f"displacement of the {partner} along {name} [um]")
        axes.set_ylabel(f"force along {name} [{'N' if whole else 'N/mm'}]")
    axes.legend(loc="upper left")
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.25 * (high - low))  # room for the legend


def loop_of(result, step, along):
    """Place and force along a direction, or angle and moment without one."""
    if along is None:
        return result.phase_turn(step).T
    rows = result.phase_loop(step)
    return rows[:, along], rows[:, result.dim + along]


def driven(rows, dim):
    """The direction in which force times displacement encloses most; without any, of the largest
    change of force."""
    rows = numpy.vstack([rows, rows[:1]])
    work = [abs(numpy.trapezoid(rows[:, dim + i], rows[:, i])) if hasattr(numpy, "trapezoid")
            else abs(numpy.trapz(rows[:, dim + i], rows[:, i])) for i in range(dim)]
    if max(work) > 0:
        return int(numpy.argmax(work))
    return int(numpy.argmax(numpy.ptp(rows[:, dim:], axis=0)))


def draw_zones(axes, result):
    step = len(result.times) - 1
    line = curves.that_slip(result, step)[0]
    where, states = zones_of(result, line, step)
    borders = cycle.parts_of_cycle(result.phases)
    colours = [style.BAND, style.COLOURS[0], style.COLOURS[5]]
    axes.pcolormesh(cycle.parts_of_surface(where), borders, numpy.concatenate([states] * 3),
                    cmap=ListedColormap(colours), vmin=-0.5, vmax=2.5, edgecolor="face",
                    linewidth=0.1, rasterized=True)
    axes.set_xlabel(line.label(initial=True))
    axes.set_ylabel("position in the cycle")
    axes.set_ylim(0, 1)
    touched = where[(states > 0).any(axis=0)]
    if len(touched):
        margin = 0.15 * numpy.ptp(touched)
        axes.set_xlim(touched.min() - margin, touched.max() + margin)
    axes.set_title("$t$ = " + result.clock.text(result.times[step]))
    axes.legend(handles=[Patch(color=colour, label=name) for colour, name in zip(colours, STATES)],
                loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3)


def zones_of(result, line, step):
    """Positions on the initial surface, ascending, and 0, 1 or 2, open, stuck or slipping, one row
    per phase."""
    table, slip = result.contact(step), result.phase_slip(step)
    closed = result.phase_pressure(step) > 0
    length = numpy.where(closed, numpy.linalg.norm(slip, axis=2), 0)
    states = numpy.where(length > STUCK * length.max(), 2, 1)
    states[~closed] = 0
    rows = []
    for state in states:
        of_phase = table.copy()
        of_phase["pressure"] = state
        rows.append(line.of(of_phase))
    return rows[0][line.axis.upper() + "0"], numpy.stack([row["pressure"] for row in rows])
