"""The counter-body in figures: its surface near the body, as far as the result has it."""

import numpy
from matplotlib.collections import LineCollection, PolyCollection

from . import space, style

DEPTH = 0.03  # of the grey band on the side of the counter-body, of the width of the view
SHOWN = 0.07  # of a body's longest side: its surroundings in which the counter-body is seen
DENSITY = 0.35  # of its facets in space


def draw_line(axes, result, step, width):
    """Of a body in the plane: its line, and a band on the side where it is. Leaves the limits of
    the axes as they are. `width` of the view in mm."""
    surface = result.counter_body(step)
    if surface is None:
        return
    ends = surface.points[surface.facets][:, :, :2]
    axes.add_collection(PolyCollection(band(ends, DEPTH * width), facecolor=style.BAND, zorder=0.5,
                                       edgecolor=style.BAND, linewidth=0.3), autolim=False)
    axes.add_collection(LineCollection(ends, color=style.GREY, linewidth=1.0, capstyle="round",
                                       zorder=0.6), autolim=False)


def band(ends, depth):
    """A quadrilateral behind each facet: the counter-body is to the left of facets."""
    along = ends[:, 1] - ends[:, 0]
    length = numpy.maximum(numpy.linalg.norm(along, axis=1, keepdims=True), 1e-300)
    inward = depth * numpy.stack([-along[:, 1], along[:, 0]], axis=1) / length
    return numpy.stack([ends[:, 0], ends[:, 1], ends[:, 1] + inward, ends[:, 0] + inward], axis=1)


def draw_patch(axes, result, step, view, points):
    """Of a body in space: the facets near its points, transparent, so that contact is seen through
    them; farther off they fade away."""
    surface = result.counter_body(step)
    if surface is None:
        return
    corners = surface.points[surface.facets]
    visible = 1 - outside(corners.mean(axis=1), points) / SHOWN
    corners, visible = corners[visible > 0], visible[visible > 0]
    if not len(corners):
        return
    light = numpy.abs(space.unit(space.normals(corners)) @ view.eye)
    grey = 0.35 + 0.45 * light
    colours = numpy.stack([grey, grey, grey, DENSITY * visible], axis=1)
    axes.add_collection(PolyCollection(corners @ view.screen, facecolor=colours, edgecolor="none",
                                       linewidth=0, antialiased=False, rasterized=True, zorder=3))


def outside(places, points):
    """How far places are outside of the box around a body, by its longest side."""
    low, high = points.min(axis=0), points.max(axis=0)
    return numpy.maximum(low - places, places - high).max(axis=1).clip(0) / (high - low).max()
