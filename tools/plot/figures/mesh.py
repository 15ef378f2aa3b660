"""The worn mesh and, below, the equivalent stress in the deformed body (figs. 1, 3; in space, seen
obliquely, figs. 7, 9, 12, 14)."""

import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize

from . import space, style
from .complaints import Unsuitable

MANY_CELLS = 1000  # above this number an SVG contains the mesh as a bitmap


def draw(result):
    view, width, columns = views(result)
    steps = [0, *result.some_steps(columns - 1)]
    figure = style.figure(width=width)
    panels = figure.subplots(2, len(steps), sharex=True, sharey=True, squeeze=False)
    for column, step in zip(panels.T, steps):
        draw_state(figure, column, view, result, step)
    if result.dim == 2:
        finish_plane(panels)
    else:
        finish_space(panels, view)
    for axes, what in zip(panels[:, 0], ("undeformed", "deformed")):
        axes.set_ylabel(what + ("  [mm]" if result.dim == 2 else ""))
    figure.set_figheight(height(panels[0, 0], width / len(steps)))
    return figure


def views(result):
    """The projection of the mesh, the width of the figure, and how many times it can show."""
    nodes = {2: 4, 3: 8}[result.dim]
    if result.cells.shape[1] != nodes:
        raise Unsuitable(f"cells of {result.cells.shape[1]} nodes")
    if result.dim == 3:
        return space.View(result), style.DOUBLE, 3
    return Plane(result.cells), style.SINGLE, 2


class Plane:
    """The view of a body in the plane: every cell, with full brightness."""

    def __init__(self, cells):
        self.cells = cells

    def polygons(self, points):
        return points[self.cells][:, :, :2], slice(None), numpy.ones(len(self.cells))


def draw_state(figure, column, view, result, step):
    worn = result.points + result.field(step, "shape")
    corners, _, light = view.polygons(worn)
    add_mesh(column[0], corners, shaded(numpy.ones((len(corners), 4)), light))
    corners, cells, light = view.polygons(worn + result.field(step, "displacement"))
    stress = result.field(step, "equivalent_stress")[cells]
    scale = ScalarMappable(Normalize(0, stress.max()), style.STRESS_MAP)
    add_mesh(column[1], corners, shaded(scale.to_rgba(stress), light))
    figure.colorbar(scale, ax=list(column), orientation="horizontal", aspect=18,
                    label="equivalent stress [MPa]")
    column[0].set_title(f"$t$ = {style.number(result.times[step])} s")


def shaded(colours, light):
    """Darker where a face is turned away, but not so much that colours could be confused."""
    colours = colours.copy()
    colours[:, :3] *= (0.75 + 0.25 * light)[:, None]
    return colours


def add_mesh(axes, corners, colours):
    edge = 0.25 if len(corners) <= 4 * MANY_CELLS else 0.1
    axes.add_collection(PolyCollection(corners, facecolor=colours, edgecolor="black",
                                       linewidth=edge, rasterized=len(corners) > MANY_CELLS))
    axes.autoscale_view()
    axes.set_aspect("equal")


def finish_plane(panels):
    for axes in panels[-1]:
        axes.set_xlabel("[mm]")


def finish_space(panels, view):
    """A projection has no scales; instead the axes are drawn, with arms of known length, in a strip
    below the bodies."""
    for axes in panels.flat:
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
    (left, right), (low, high) = panels[0, 0].get_xlim(), panels[0, 0].get_ylim()
    arm = style.round_number(0.16 * (right - left))
    panels[0, 0].set_ylim(low - arm, high)
    for axes in panels[:, 0]:
        add_arms(axes, view.screen, arm)


def add_arms(axes, screen, arm):
    """At the lower left."""
    tips = arm * screen
    corner = numpy.array([axes.get_xlim()[0], axes.get_ylim()[0]])
    origin = corner - 1.5 * numpy.minimum(tips.min(axis=0), 0)
    for name, tip in zip("xyz", tips):
        axes.annotate("", origin + tip, origin,
                      arrowprops={"arrowstyle": "-|>,head_width=0.1,head_length=0.2",
                                  "linewidth": 0.6, "color": "black", "shrinkA": 0, "shrinkB": 0})
        axes.text(*(origin + 1.35 * tip), f"${name}$", ha="center", va="center", fontsize=7)
    axes.text(origin[0] + 1.7 * tips[0, 0], corner[1], f"arms: {style.number(arm)} mm", fontsize=7)


def height(axes, panel):
    """The height of the figure for panels of this width."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    return min(2 * 0.86 * panel * (high - low) / (right - left) + 0.9, 2.4 * style.SINGLE)
