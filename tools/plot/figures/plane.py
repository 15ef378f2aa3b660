"""Bodies in the plane: cells, mesh lines that can be seen, outline, the window around contact."""

import numpy
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Rectangle

MANY_CELLS = 500  # above this number an SVG contains the mesh as a bitmap
LEAST_DISTANCE = 0.8  # points: mesh lines that are closer are not drawn
FLATNESS = 0.6  # height of the window around contact by its width


def add_cells(axes, corners, colours, scale):
    """Cells with the mesh lines that can be seen, each by its distance from the next one. `scale`:
    points of paper per mm."""
    many = len(corners) > MANY_CELLS
    # Hairlines of the cells' own colours, so that no gaps show between them.
    axes.add_collection(PolyCollection(corners, facecolor=colours, edgecolor=colours, linewidth=0.1,
                                       zorder=1, rasterized=many))
    ends = numpy.stack([corners, numpy.roll(corners, -1, axis=1)], axis=2)
    along = ends[:, :, 1] - ends[:, :, 0]
    area = numpy.abs(numpy.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])) / 2
    length = numpy.maximum(numpy.linalg.norm(along, axis=2), 1e-300)
    widths = line_widths(scale * area[:, None] / length)
    seen = widths > 0
    axes.add_collection(LineCollection(ends[seen], color="black", linewidth=widths[seen], zorder=1.1,
                                       rasterized=many))


def line_widths(distances):
    """Of mesh lines at these distances, both in points: finer where they are close, 0 where they
    could not be told apart."""
    return numpy.where(distances >= LEAST_DISTANCE, numpy.minimum(0.05 * distances, 0.25), 0)


def add_outline(axes, cells, points):
    axes.add_collection(LineCollection(points[outline(cells)][:, :, :2], color="black",
                                       linewidth=0.5, zorder=1.2, capstyle="round"), autolim=False)


def outline(cells):
    """The sides of cells that belong to one cell, S x 2."""
    count = cells.shape[1]
    sides = numpy.concatenate([cells[:, [i, (i + 1) % count]] for i in range(count)])
    _, first, times = numpy.unique(numpy.sort(sides, axis=1), axis=0, return_index=True,
                                   return_counts=True)
    return sides[first[times == 1]]


def box(points, margin=0.05):
    """Lower left and upper right corner of all points and a margin."""
    low, high = points[:, :2].min(axis=0), points[:, :2].max(axis=0)
    wider = margin * (high - low).max()
    return low - wider, high + wider


def widened(frame, least, most):
    """A frame whose height by width is between bounds, with the same centre."""
    low, high = frame
    width, height = high - low
    wider = numpy.maximum([height / most - width, least * width - height], 0) / 2
    return low - wider, high + wider


def window(table, points):
    """The window around the nodes in contact, to the first open ones: its lower left and upper
    right corner, its height FLATNESS times its width. None without contact."""
    touching = table["pressure"] > 0
    if not touching.any():
        return None
    surface = numpy.stack([table["x"], table["y"]], axis=1)
    seen = surface[with_neighbours(touching)]
    low, high = seen.min(axis=0), seen.max(axis=0)
    extent = high - low
    width = 1.5 * max(extent[0], extent[1] / FLATNESS)
    size = numpy.array([width, FLATNESS * width])
    centre = (low + high) / 2
    inward = points[:, :2].mean(axis=0) - centre
    # Contact lies off the middle, so that more of the body is seen than of the counter-body.
    free = numpy.maximum(size - extent, 0) / 2
    longest = max(numpy.abs(inward).max(), 1e-300)
    centre = centre + 0.5 * free * inward / longest
    return centre - size / 2, centre + size / 2


def with_neighbours(chosen):
    """Rows of the contact table follow each other along the surface."""
    wider = chosen.copy()
    wider[1:] |= chosen[:-1]
    wider[:-1] |= chosen[1:]
    return wider


def draw_body(axes, result, points, colours, frame, paper_width):
    """The cells within a frame, coloured; `paper_width` of the panel in points."""
    low, high = frame
    corners = points[result.cells][:, :, :2]
    inside = (corners.max(axis=1) >= low).all(axis=1) & (corners.min(axis=1) <= high).all(axis=1)
    add_cells(axes, corners[inside], colours[inside], paper_width / (high[0] - low[0]))
    add_outline(axes, result.cells, points)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")


def mark(axes, frame):
    """Where a window is."""
    low, high = frame
    axes.add_patch(Rectangle(low, *(high - low), fill=False, edgecolor="white", linewidth=1.2,
                             zorder=4))
    axes.add_patch(Rectangle(low, *(high - low), fill=False, edgecolor="black", linewidth=0.5,
                             zorder=4))
