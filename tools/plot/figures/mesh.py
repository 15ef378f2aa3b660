"""The worn mesh and, below, the equivalent stress in the deformed body (figs. 1, 3)."""

import numpy
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

from . import style
from .complaints import Unsuitable

MANY_CELLS = 1000  # from here on an SVG holds the mesh as a picture


def draw(result):
    if result.dim != 2 or result.cells.shape[1] != 4:
        raise Unsuitable("a mesh in space; ParaView shows it")
    steps = [0, *result.some_steps(1)]
    stresses = [result.field(step, "equivalent_stress") for step in steps]
    figure = style.figure(height=panel_height(result, len(steps)))
    panels = figure.subplots(2, len(steps), sharex=True, sharey=True, squeeze=False)
    for column, (step, stress) in enumerate(zip(steps, stresses)):
        worn = result.points[:, :2] + result.field(step, "shape")[:, :2]
        deformed = worn + result.field(step, "displacement")[:, :2]
        add_mesh(panels[0, column], worn[result.cells], facecolor="white")
        painted = add_mesh(panels[1, column], deformed[result.cells], array=stress,
                           norm=Normalize(0, stress.max()), cmap=style.STRESS_MAP)
        figure.colorbar(painted, ax=panels[:, column], orientation="horizontal", aspect=18,
                        label="equivalent stress [MPa]")
        panels[0, column].set_title(f"$t$ = {style.number(result.times[step])} s")
    finish(panels)
    return figure


def add_mesh(axes, corners, **look):
    edge = 0.25 if len(corners) <= 4 * MANY_CELLS else 0.1
    collection = PolyCollection(corners, edgecolor="black", linewidth=edge,
                                rasterized=len(corners) > MANY_CELLS, **look)
    axes.add_collection(collection)
    axes.autoscale_view()
    axes.set_aspect("equal")
    return collection


def finish(panels):
    for axes in panels[-1]:
        axes.set_xlabel("[mm]")
    for axes, what in zip(panels[:, 0], ("undeformed", "deformed")):
        axes.set_ylabel(f"{what}  [mm]")


def panel_height(result, columns):
    width, height = numpy.ptp(result.points[:, :2], axis=0)
    panel = 0.86 * style.SINGLE / columns * height / width
    return min(2 * panel + 0.9, 2.4 * style.SINGLE)
