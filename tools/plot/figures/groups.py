"""A mesh and its named parts, before any run: what `gnomon mesh -o` draws."""

import xml.etree.ElementTree as tree
from typing import NamedTuple

import matplotlib
import numpy
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from . import plane, space, style
from .complaints import BadInput

MANY = 12  # more labels than this would cover the picture; the legend has all names
WIDTH = style.DOUBLE
GAP = 1.5  # points between labels
TALLEST = 1.1  # times the width
NARROWEST = 2.5  # height by width of what is shown: a slender body gets room for names beside it
EYES = ((-0.5, -1.0, 0.8), (0.5, 1.0, -0.8))  # two views, so that every side is seen


class Part(NamedTuple):
    name: str
    points: object
    cells: object  # E x 1 of points, E x 2 of lines, E x 4 of faces, E x 8 of hexahedra


def read(path):
    """Of a file of `gnomon mesh`: the names of the coordinates, the body, and its parts."""
    try:
        root = tree.parse(path).getroot()
        axes = root.find("./Domain/Grid/Information[@Name='axes']").get("Value").split()
        grids = root.findall("./Domain/Grid/Grid")
        parts = [Part(grid.get("Name"), numbers(grid.find("Geometry/DataItem"), float),
                      numbers(grid.find("Topology/DataItem"), int)) for grid in grids]
    except (tree.ParseError, AttributeError, ValueError) as error:
        raise BadInput(f"cannot read {path}: {error}; expected a mesh of gnomon") from error
    if not parts:
        raise BadInput(f"{path} holds no mesh of gnomon")
    return axes, parts[0], parts[1:]


def numbers(item, kind):
    rows, columns = (int(extent) for extent in item.get("Dimensions").split())
    return numpy.array(item.text.split(), dtype=kind).reshape(rows, columns)


def draw(body, parts, axes=("x", "y")):
    return draw_plane(body, parts, axes) if body.cells.shape[1] == 4 else draw_space(body, parts)


def colours_of(parts):
    palette = [colour for colour in style.COLOURS if colour != "#000000"]  # edges of cells are black
    if len(parts) > len(palette):
        palette = [matplotlib.colormaps["tab20"](i % 20) for i in range(len(parts))]
    return palette[:len(parts)]


def draw_plane(body, parts, names):
    low, high = plane.widened(plane.box(body.points, margin=0.12), 0, NARROWEST)
    ratio = (high[1] - low[1]) / (high[0] - low[0])
    width = WIDTH * min(1, TALLEST / ratio)
    figure = style.figure(width=width, height=(width - 0.5) * ratio + 0.45)
    axes = figure.add_subplot()
    corners = body.points[body.cells][:, :, :2]
    scale = 72 * (width - 0.5) / (high[0] - low[0])
    plane.add_cells(axes, corners, numpy.ones((len(corners), 4)), scale)
    handles, labels = [], []
    for part, colour in zip(parts, colours_of(parts)):
        ends = part.points[part.cells][:, :, :2]
        handles.append(draw_points(axes, part, colour, ends[:, 0]) if ends.shape[1] == 1
                       else draw_lines(axes, part, colour, ends))
        for chain in chains(part.cells) if len(parts) <= MANY else []:
            labels.append(note(axes, part.name, colour, *anchor(ends[chain])))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal",
             xlabel=f"${names[0]}$ [mm]", ylabel=f"${names[1]}$ [mm]")
    finish(figure, handles, labels)
    return figure


def draw_lines(axes, part, colour, ends):
    axes.add_collection(LineCollection(ends, color=colour, linewidth=2.2, zorder=3,
                                       capstyle="round"))
    return Line2D([], [], color=colour, linewidth=2.2, label=f"{part.name}: {len(ends)} facets")


def draw_points(axes, part, colour, places):
    axes.plot(*places.T, "o", color=colour, markersize=3.5, zorder=4)
    return Line2D([], [], color=colour, marker="o", linestyle="",
                  label=f"{part.name}: points, {len(places)}")


def chains(cells):
    """The facets of a part where one goes on from the one before; of points, each."""
    breaks = 1 + numpy.flatnonzero(cells[1:, 0] != cells[:-1, -1])
    return numpy.split(numpy.arange(len(cells)), breaks)


def anchor(ends):
    """The middle of a chain by its length, and the direction out of the body, which is to the left
    of its facets."""
    if ends.shape[1] == 1:
        return ends[len(ends) // 2, 0], numpy.array([0.0, 1.0])
    along = ends[:, 1] - ends[:, 0]
    length = numpy.linalg.norm(along, axis=1)
    middle = numpy.searchsorted(numpy.cumsum(length), length.sum() / 2)
    middle = min(middle, len(ends) - 1)
    outward = numpy.array([along[middle, 1], -along[middle, 0]]) / max(length[middle], 1e-300)
    return ends[middle].mean(axis=0), outward


def note(axes, name, colour, place, outward):
    """The name beside its part, out of the body. It takes no room from the axes; `separate` keeps
    it within the picture."""
    across = "left" if outward[0] > 0.5 else "right" if outward[0] < -0.5 else "center"
    along = "bottom" if outward[1] > 0.5 else "top" if outward[1] < -0.5 else "center"
    label = axes.annotate(
        name, place, 6 * outward, textcoords="offset points", ha=across, va=along, color=colour,
        fontsize=8, zorder=5, annotation_clip=False,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8, "alpha": 0.85})
    label.set_in_layout(False)
    return label


def draw_space(body, parts):
    faces, _ = space.boundary_faces(body.cells)
    surfaces = [part for part in parts if part.cells.shape[1] == 4]
    dots = [part for part in parts if part.cells.shape[1] == 1]
    colours = colours_of(parts)
    of_part = {part.name: colour for part, colour in zip(parts, colours)}
    figure = style.figure(width=WIDTH)
    panels = figure.subplots(1, len(EYES), squeeze=False)[0]
    labels = []
    for axes, eye in zip(panels, EYES):
        view = space.Eye(eye)
        draw_faces(axes, view, body, faces, surfaces, of_part)
        for part in dots:
            axes.plot(*(part.points @ view.screen).T, "o", color=of_part[part.name], markersize=3.5)
        if len(parts) <= MANY:
            labels += label_faces(axes, view, surfaces, of_part)
        space.finish(axes)
        space.add_arms(axes, view.screen)
    handles = [Patch(facecolor=of_part[part.name], edgecolor="black", linewidth=0.4,
                     label=f"{part.name}: {len(part.cells)} facets") for part in surfaces]
    handles += [Line2D([], [], color=of_part[part.name], marker="o", linestyle="",
                       label=f"{part.name}: points, {len(part.cells)}") for part in dots]
    ratio = max(space.ratio(axes) for axes in panels)
    figure.set_figheight(min(WIDTH / 2 * ratio, WIDTH) + 0.2)
    finish(figure, handles, labels)
    return figure


def draw_faces(axes, view, body, faces, surfaces, of_part):
    """All faces of the boundary; those of parts in their colours, the others white."""
    corners = [body.points[faces]] + [part.points[part.cells] for part in surfaces]
    tints = [numpy.ones((len(faces), 4))]
    tints += [numpy.tile(matplotlib.colors.to_rgba(of_part[part.name]), (len(part.cells), 1))
              for part in surfaces]
    # A face of a part lies on a white one: the later is drawn on top of it.
    rank = numpy.concatenate([numpy.full(len(group), k > 0) for k, group in enumerate(corners)])
    corners, tints = numpy.concatenate(corners), numpy.concatenate(tints)
    towards = space.unit(space.normals(corners)) @ view.eye
    depth = corners.mean(axis=1) @ view.eye
    order = numpy.lexsort((rank, numpy.round(depth, 9)))
    order = order[towards[order] > 1e-9]
    flat = corners[order] @ view.screen
    tints = tints[order]
    tints[:, :3] *= (0.7 + 0.3 * towards[order])[:, None]
    scale = 72 * WIDTH / 2 / numpy.ptp(flat[..., 0])
    space.add_faces(axes, flat, tints, scale, plane.MANY_CELLS)


def label_faces(axes, view, surfaces, of_part):
    """At the middle of what is seen of a part; parts that turn away get no label here."""
    labels = []
    for part in surfaces:
        corners = part.points[part.cells]
        normals = space.normals(corners)
        weight = normals @ view.eye
        if weight.sum() <= 0.05 * numpy.linalg.norm(normals, axis=1).sum():
            continue
        seen = numpy.maximum(weight, 0)
        middle = (seen[:, None] * corners.mean(axis=1)).sum(axis=0) / seen.sum()
        nearest = numpy.argmin(numpy.linalg.norm(corners.mean(axis=1) - middle, axis=1)
                               + 1e9 * (weight <= 0))
        labels.append(axes.annotate(
            part.name, corners[nearest].mean(axis=0) @ view.screen, (0, 0),
            textcoords="offset points", ha="center", va="center", fontsize=8, zorder=5,
            bbox={"facecolor": "white", "edgecolor": of_part[part.name], "linewidth": 0.8,
                  "pad": 1.2, "alpha": 0.9}))
    return labels


def finish(figure, handles, labels):
    if handles:
        style.legend_above_all(figure, handles)
    separate(figure, labels)


def separate(figure, labels):
    """Moves labels into the picture, and those that would cover others away from them: those above
    a part upwards, those below it downwards, others to where they are already. A name without room is in the legend alone."""
    figure.draw_without_rendering()
    placed = []
    for label in labels:
        box = label.get_window_extent().padded(GAP * figure.dpi / 72)
        box = moved(figure, label, box, inwards(figure.bbox, box), 0)
        upwards = {"bottom": True, "top": False}.get(label.get_verticalalignment())
        while covered := next((other for other in placed if box.overlaps(other)), None):
            if upwards is None:
                upwards = box.y0 + box.y1 >= covered.y0 + covered.y1
            shift = covered.y1 - box.y0 + 1 if upwards else covered.y0 - box.y1 - 1
            box = moved(figure, label, box, 0, shift)
        label.set_visible(figure.bbox.y0 <= box.y0 and box.y1 <= figure.bbox.y1)
        placed.append(box)


def inwards(picture, box):
    """How far to the right a box must move to be in the picture; its beginning has precedence."""
    return max(picture.x0 - box.x0, min(0, picture.x1 - box.x1))


def moved(figure, label, box, right, up):
    """Moves a label by pixels; returns its box."""
    points = 72 / figure.dpi
    across, along = label.xyann
    label.xyann = across + points * right, along + points * up
    return box.translated(right, up)
