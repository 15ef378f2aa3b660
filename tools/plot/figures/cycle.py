"""The contact pressure over a cycle: on the surface, and over the position in the cycle, at the
start and at up to three stored times. In space along the sliding direction at y = 0."""

import numpy
from matplotlib.ticker import MaxNLocator

from . import curves, shape, style

MOST_TIMES = 3


def draw(result):
    borders = parts_of_cycle(result.phases)
    line = curves.of(result)[0]
    named = result.has_pairs and goes_back(result)
    steps = [0, *result.some_steps(MOST_TIMES)]
    maps = [map_of(result, line, step) for step in steps]
    figure = style.figure(width=style.DOUBLE, height=0.8 * style.SINGLE)
    panels = figure.subplots(1, len(steps), sharex=True, sharey=True, squeeze=False)[0]
    scale = style.colour_bar(figure, panels, max(values.max() for _, values in maps), "pressure [MPa]")
    for axes, step, (where, values) in zip(panels, steps, maps):
        paint(axes, where, borders, values, scale)
        axes.set_title("$t$ = " + result.clock.text(result.times[step]), pad=12 if named else None)
        axes.set_xlabel(name_of(result, line))
    panels[0].set_ylabel("position in the cycle")
    panels[0].set_ylim(0, 1)
    panels[0].set_xlim(range_of(maps))
    if named:
        for axes in panels:
            shape.name_bodies(axes, result, result.contact(0))
    return figure


def goes_back(result):
    """Whether a surface in the plane bends so much that x does not say where on it a node is."""
    if result.dim != 2:
        return False
    steps = numpy.diff(result.contact(0)["X0"])
    return (steps > 0).any() and (steps < 0).any()


def name_of(result, line):
    if goes_back(result):
        return "length along the initial surface [mm]"
    return line.label(initial=True)


def map_of(result, line, step):
    """Positions on the initial surface, ascending, and pressures, one row per phase."""
    table, pressures = result.contact(step), result.phase_pressure(step)
    if goes_back(result):
        return shape.along(table), pressures
    rows = []
    for pressure in pressures:
        of_phase = table.copy()
        of_phase["pressure"] = pressure
        rows.append(line.of(of_phase))
    where = rows[0][line.axis.upper() + "0"]
    return where, numpy.stack([row["pressure"] for row in rows])


def parts_of_cycle(positions):
    """Borders of the parts of the cycle that the phases stand for: the middles between them; over
    the cycle before and the next one too."""
    around = numpy.concatenate([positions - 1, positions, positions + 1])
    middles = (around[1:] + around[:-1]) / 2
    return numpy.concatenate([[2 * around[0] - middles[0]], middles, [2 * around[-1] - middles[-1]]])


def parts_of_surface(where):
    """Borders of the parts of the surface that the nodes stand for."""
    return numpy.concatenate([where[:1], (where[1:] + where[:-1]) / 2, where[-1:]])


def paint(axes, where, borders, values, scale):
    """Grey: no contact."""
    seen = numpy.ma.masked_where(values <= 0, values)
    axes.set_facecolor(style.BAND)
    axes.pcolormesh(parts_of_surface(where), borders, numpy.ma.concatenate([seen] * 3),
                    cmap=scale.cmap, norm=scale.norm, edgecolor="face", linewidth=0.1,
                    rasterized=True)
    axes.xaxis.set_major_locator(MaxNLocator(4))


def range_of(maps):
    """The part of the surface that was ever in contact, and a margin; at most the surface."""
    touched = [where[(values > 0).any(axis=0)] for where, values in maps]
    seen = numpy.concatenate(touched)
    whole = numpy.concatenate([where for where, _ in maps])
    if not len(seen):
        seen = whole
    margin = 0.08 * numpy.ptp(seen)
    return max(seen.min() - margin, whole.min()), min(seen.max() + margin, whole.max())
