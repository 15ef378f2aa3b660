"""Maps of the surface of a body in space: contact pressure at the start and at up to three stored
times (figs. 8, 10, 13), and the wear depth, the track. Grey where there is no contact or no wear; a
half is completed by its mirror image."""

import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation

from . import curves, space, style
from .complaints import Unsuitable

NAMES = "xyz"
LEVELS = 20  # bands of colour
LEAST = 1e-6  # of the largest value: where a map begins


def draw_pressure(result):
    return draw(result, [0, *steps_of(result)], "pressure", "pressure [MPa]")


def draw_depth(result):
    """Over the initial places, which the wear depth belongs to; of the body that is worn deepest."""
    steps = steps_of(result)
    depth = result.contact(steps[-1])["wear_depth"] if steps else numpy.zeros(1)
    if not depth.max() > 0:
        raise Unsuitable("nothing is worn")
    return draw(result, steps, "wear_depth", "wear depth [mm]", of_place="0",
                deepest=depth.argmax())


def steps_of(result):
    if result.dim != 3:
        raise Unsuitable("the contact surface is a curve")
    return result.some_steps(3)


def draw(result, steps, column, label, of_place="", deepest=0):
    """`of_place`: the ending of the columns of places; `deepest`: a row of the body that is seen."""
    first = result.contact(0)
    body = result.bodies[first["node"][deepest]] if result.has_pairs else None
    rows, faces = numpy.unique(space.contact_faces(result, body), return_inverse=True)
    faces = faces.reshape(-1, 4)
    across = seen_axes(first[rows], faces)
    label = f"{label} {curves.name_of_body(result, first[rows])}".rstrip()
    places = [NAMES[axis].upper() + of_place if of_place else NAMES[axis] for axis in across]
    mirrored = 1 in across and space.is_half(result)
    maps = [map_of(result.contact(step)[rows], faces, places, column, mirrored) for step in steps]
    figure = style.figure(width=style.DOUBLE)
    panels = figure.subplots(1, len(steps), sharex=True, sharey=True, squeeze=False)[0]
    for axes, step, (points, quads, values) in zip(panels, steps, maps):
        paint(figure, axes, points, quads, values, label)
        axes.set_title("$t$ = " + result.clock.text(result.times[step]))
        axes.set_xlabel(f"${NAMES[across[0]]}$ [mm]")
    panels[0].xaxis.set_major_locator(MaxNLocator(4))
    panels[0].set_ylabel(f"${NAMES[across[1]]}$ [mm]")
    ratio = frame(panels[0], maps)
    panel = (style.DOUBLE - 0.4) / len(steps) - 0.03
    tall = min(panel * ratio, style.DOUBLE)
    figure.set_figheight(tall + 1.1 + panel / 18 + 0.03 * tall)  # title, labels, bar, space above it
    return figure


def seen_axes(table, faces):
    """The two coordinates that are visible when looking along the mean normal."""
    points = numpy.stack([table["X0"], table["Y0"], table["Z0"]], axis=1)
    normal = space.normals(points[faces]).sum(axis=0)
    return [axis for axis in range(3) if axis != numpy.abs(normal).argmax()]


def map_of(table, faces, places, column, mirrored):
    """Places, faces and values that are seen, of both halves if one is mirrored at y = 0. Less than a
    millionth of the largest value is none."""
    points = numpy.stack([table[place] for place in places], axis=1)
    values = table[column]
    values = numpy.where(values > LEAST * values.max(), values, 0)
    if not mirrored:
        return points, faces, values
    image = points * [-1 if place.lower().startswith("y") else 1 for place in places]
    return (numpy.concatenate([points, image]), numpy.concatenate([faces, faces + len(points)]),
            numpy.tile(values, 2))


def paint(figure, axes, points, faces, values, label):
    axes.add_collection(PolyCollection(points[faces], color=style.BAND))
    if values.max() > 0:
        levels = numpy.linspace(0, values.max(), LEVELS + 1)
        levels[0] = LEAST * values.max()
        scale = ScalarMappable(Normalize(0, values.max()), style.STRESS_MAP)
        axes.tricontourf(*triangles(points, faces, values), levels, cmap=scale.cmap,
                         norm=scale.norm)
        figure.colorbar(scale, ax=axes, orientation="horizontal", aspect=18,
                        ticks=MaxNLocator(4), label=label)
    for painted in axes.collections:
        painted.set(edgecolor="face", linewidth=0.2, rasterized=True)
    axes.set_aspect("equal")


def triangles(points, faces, values):
    """Four triangles per face, meeting at its centre, so that no diagonal is preferred."""
    centres = len(points) + numpy.arange(len(faces))
    corners = [numpy.stack([faces[:, i], faces[:, (i + 1) % 4], centres], axis=1) for i in range(4)]
    everywhere = numpy.concatenate([points, points[faces].mean(axis=1)])
    at_corners = numpy.concatenate([values, values[faces].mean(axis=1)])
    return Triangulation(*everywhere.T, numpy.concatenate(corners)), at_corners


def frame(axes, maps):
    """The range that was ever in contact or is worn, and a margin, within the surface; returns height
    by width."""
    loaded = numpy.concatenate([points[faces[(values[faces] > 0).any(axis=1)]].reshape(-1, 2)
                                for points, faces, values in maps])
    whole = numpy.concatenate([points for points, _, _ in maps])
    seen = loaded if len(loaded) else whole
    margin = 0.15 * numpy.ptp(seen, axis=0).max()
    low = numpy.maximum(seen.min(axis=0) - margin, whole.min(axis=0))
    high = numpy.minimum(seen.max(axis=0) + margin, whole.max(axis=0))
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    return (high[1] - low[1]) / (high[0] - low[0])
