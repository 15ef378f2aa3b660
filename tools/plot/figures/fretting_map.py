"""A fretting map: running conditions over amplitude and load, of a study without errors whose contact
may stick, and the share of the energy of a cycle that friction dissipates."""

import math

from . import parameters, style, tables
from .complaints import Unsuitable
from .result import Result

CONDITIONS = {"partial slip": ("o", style.COLOURS[0]), "mixed": ("D", style.COLOURS[1]),
              "gross slip": ("s", style.COLOURS[5])}
TRANSITION = 0.2  # of the energy ratio, between partial and gross slip in an elastic contact (Fouvry)
NEEDED = ("stroke", "friction_force", "friction_work", "stick_area", "contact_force")


def draw(path, rows):
    rows = [row for row in rows if row["status"] == "finished"]
    if not rows or any(name not in rows[0] for name in NEEDED):
        raise Unsuitable("no contact of its runs may stick")
    figure = style.figure(style.DOUBLE, 0.42 * style.DOUBLE)
    conditions, energies = figure.subplots(1, 2)
    points = [point_of(path, row) for row in rows]
    points = [point for point in points if point[0] > 0]
    if not points:
        raise Unsuitable("nothing moves along the contact")
    for name, (marker, colour) in CONDITIONS.items():
        own = [point for point in points if point[2] == name]
        for axes, ordinate in ((conditions, 1), (energies, 3)):
            axes.plot([point[0] for point in own], [point[ordinate] for point in own], marker=marker,
                      color=colour, linestyle="", label=name if own else None)
    energies.axhline(TRANSITION, color=style.GREY, linewidth=0.7, linestyle=style.DASHES)
    conditions.set_ylabel(f"normal force [{'N/mm' if flat(path) else 'N'}]")
    energies.set_ylabel("energy ratio $E_d / (4 Q^* \\delta^*)$")
    for axes in (conditions, energies):
        axes.set_xscale("log")
        axes.set_xlabel("amplitude of displacement [um]")
        style.log_ticks(axes.xaxis)
    conditions.set_ylim(bottom=0)
    style.legend_above_all(figure, conditions.get_legend_handles_labels()[0])
    return figure


def point_of(path, row):
    """Amplitude [um], normal force, condition, energy ratio."""
    stroke, force, work, normal = (tables.number(path, row, name) for name in
                                   ("stroke", "friction_force", "friction_work", "contact_force"))
    ratio = work / (2 * stroke * force) if stroke * force > 0 else math.nan
    return 1e3 * stroke / 2, normal, condition(path, row), ratio


def condition(path, row):
    """Whether a part of the contact sticks throughout the cycle: at the start, and at the end."""
    sticks = [area > 0 for area in sticking(path, row)]
    return "partial slip" if all(sticks) else "mixed" if any(sticks) else "gross slip"


def sticking(path, row):
    with Result(path.parent / "runs" / f"{row['run']}.h5") as result:
        return result.history["stick_area"][[0, -1]]


def flat(path):
    return parameters.units(path).get("friction_force", "N/mm") == "N/mm"
