"""Contact pressure on the surface of a body in space, at the start and at up to three stored times
(figs. 8, 10, 13). Grey where there is no contact; a half is completed by its mirror image."""

import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from . import space, style
from .complaints import Unsuitable

NAMES = "xyz"
LEVELS = 20  # bands of colour


def draw(result):
    if result.dim != 3:
        raise Unsuitable("the contact surface is a curve")
    steps = [0, *result.some_steps(3)]
    faces = space.contact_faces(result)
    across = seen_axes(result, faces)
    mirrored = 1 in across and space.is_half(result)
    maps = [map_of(result.contact(step), faces, across, mirrored) for step in steps]
    figure = style.figure(width=style.DOUBLE)
    panels = figure.subplots(1, len(steps), sharex=True, sharey=True, squeeze=False)[0]
    for axes, step, (points, quads, pressure) in zip(panels, steps, maps):
        paint(figure, axes, points, quads, pressure)
        axes.set_title("$t$ = " + result.clock.text(result.times[step]))
        axes.set_xlabel(f"${NAMES[across[0]]}$ [mm]")
    panels[0].xaxis.set_major_locator(MaxNLocator(4))
    panels[0].set_ylabel(f"${NAMES[across[1]]}$ [mm]")
    ratio = frame(panels[0], maps)
    panel = (style.DOUBLE - 0.4) / len(steps) - 0.03
    tall = min(panel * ratio, style.DOUBLE)
    figure.set_figheight(tall + 1.1 + panel / 18 + 0.03 * tall)  # title, labels, bar, space above it
    return figure


def seen_axes(result, faces):
    """The two coordinates that are visible when looking along the mean normal."""
    table = result.contact(0)
    points = numpy.stack([table["X0"], table["Y0"], table["Z0"]], axis=1)
    normal = space.normals(points[faces]).sum(axis=0)
    return [axis for axis in range(3) if axis != numpy.abs(normal).argmax()]


def map_of(table, faces, across, mirrored):
    """Current positions, faces and pressures, of both halves if one is mirrored at y = 0."""
    points = numpy.stack([table[NAMES[axis]] for axis in across], axis=1)
    if not mirrored:
        return points, faces, table["pressure"]
    image = points * [-1 if axis == 1 else 1 for axis in across]
    return (numpy.concatenate([points, image]), numpy.concatenate([faces, faces + len(points)]),
            numpy.tile(table["pressure"], 2))


def paint(figure, axes, points, faces, pressure):
    axes.add_collection(PolyCollection(points[faces], color=style.BAND))
    if pressure.max() > 0:
        levels = numpy.linspace(0, pressure.max(), LEVELS + 1)
        levels[0] = 1e-6 * pressure.max()
        scale = ScalarMappable(Normalize(0, pressure.max()), style.STRESS_MAP)
        axes.tricontourf(*triangles(points, faces, pressure), levels, cmap=scale.cmap,
                         norm=scale.norm)
        figure.colorbar(scale, ax=axes, orientation="horizontal", aspect=18,
                        ticks=MaxNLocator(4), label="pressure [MPa]")
    for painted in axes.collections:
        painted.set(edgecolor="face", linewidth=0.2, rasterized=True)
    axes.set_aspect("equal")


def triangles(points, faces, pressure):
    """Four triangles per face, meeting at its centre, so that no diagonal is preferred."""
    centres = len(points) + numpy.arange(len(faces))
    corners = [numpy.stack([faces[:, i], faces[:, (i + 1) % 4], centres], axis=1) for i in range(4)]
    everywhere = numpy.concatenate([points, points[faces].mean(axis=1)])
    values = numpy.concatenate([pressure, pressure[faces].mean(axis=1)])
    return Triangulation(*everywhere.T, numpy.concatenate(corners)), values


def frame(axes, maps):
    """The range that was ever in contact and a margin, within the surface; returns height by
    width."""
    loaded = numpy.concatenate([points[faces[(pressure[faces] > 0).any(axis=1)]].reshape(-1, 2)
                                for points, faces, pressure in maps])
    whole = numpy.concatenate([points for points, _, _ in maps])
    seen = loaded if len(loaded) else whole
    margin = 0.15 * numpy.ptp(seen, axis=0).max()
    low = numpy.maximum(seen.min(axis=0) - margin, whole.min(axis=0))
    high = numpy.minimum(seen.max(axis=0) + margin, whole.max(axis=0))
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    return (high[1] - low[1]) / (high[0] - low[0])
