"""Contact pressure on the surface of a body in space, at up to three stored times (fig. 8).
Grey where there is no contact."""

import numpy
from matplotlib.collections import PolyCollection

from . import style
from .complaints import Unsuitable

FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
NAMES = "xyz"


def draw(result):
    if result.dim != 3:
        raise Unsuitable("the contact surface is a curve")
    steps = result.some_steps(3) or [0]
    faces = contact_faces(result)
    across = seen_axes(result, faces)
    figure = style.figure(width=style.DOUBLE)
    panels = figure.subplots(1, len(steps), sharex=True, sharey=True, squeeze=False)[0]
    for axes, step in zip(panels, steps):
        paint(figure, axes, result.contact(step), faces, across)
        axes.set_title(f"$t$ = {style.number(result.times[step])} s")
        axes.set_xlabel(f"${NAMES[across[0]]}$ [mm]")
    panels[0].set_ylabel(f"${NAMES[across[1]]}$ [mm]")
    (left, right), (low, high) = panels[0].get_xlim(), panels[0].get_ylim()
    panel = (0.94 * style.DOUBLE - 0.45) / len(steps) - 0.1
    figure.set_figheight(min(panel * (high - low) / (right - left), style.DOUBLE) + 1.3)
    return figure


def contact_faces(result):
    """Faces of the mesh that lie in the contact surface, by rows of the contact table."""
    nodes = result.contact(0)["node"]
    row = numpy.full(len(result.points), -1)
    row[nodes] = numpy.arange(len(nodes))
    every = numpy.concatenate([result.cells[:, face] for face in FACES])
    faces = row[every][(row[every] >= 0).all(axis=1)]
    if not len(faces):
        raise Unsuitable("the contact surface holds no face of the mesh")
    return faces


def seen_axes(result, faces):
    """The two coordinates that are left when one looks along the mean normal."""
    table = result.contact(0)
    points = numpy.stack([table["X0"], table["Y0"], table["Z0"]], axis=1)[faces]
    normal = numpy.cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1]).sum(axis=0)
    return [axis for axis in range(3) if axis != numpy.abs(normal).argmax()]


def paint(figure, axes, table, faces, across):
    points = numpy.stack([table["X"], table["Y"], table["Z"]], axis=1)[:, across]
    pressure = table["pressure"][faces].mean(axis=1)
    free = PolyCollection(points[faces[pressure <= 0]], color=style.BAND, linewidth=0.1,
                          rasterized=True)
    collection = PolyCollection(points[faces[pressure > 0]], array=pressure[pressure > 0],
                                cmap=style.STRESS_MAP, edgecolor="face", linewidth=0.1,
                                rasterized=True)
    collection.set_clim(0, max(pressure.max(), 1e-300))
    axes.add_collection(free)
    axes.add_collection(collection)
    axes.autoscale_view()
    axes.set_aspect("equal")
    figure.colorbar(collection, ax=axes, orientation="horizontal", aspect=25,
                    label="contact pressure [MPa]")
