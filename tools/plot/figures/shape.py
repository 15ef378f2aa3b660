"""Evolution of the contact surface: the worn undeformed shape at stored times (figs. 2, 4)."""

import numpy
from matplotlib.lines import Line2D

from . import plane, style
from .complaints import Unsuitable

STRETCHES = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
MOST_TIMES = 6
SEEN = 0.04  # wear that is less of the height of the picture is shown by its depth, below
DEPTHS = 0.5  # height of that panel by the width
HIGHEST = 1.6  # height of the shape by the width: bores and other steep surfaces


def draw(result):
    if result.dim != 2:
        raise Unsuitable("the contact surface is not a curve")
    steps = result.some_steps(MOST_TIMES)
    first, last = result.contact(0), result.contact(steps[-1] if steps else 0)
    breaks = breaks_of(result, first)
    figure = style.figure()
    hidden = is_hidden(last)
    axes, *below = figure.subplots(2 if hidden else 1, 1, squeeze=False)[:, 0]
    rows, ends = outline(result, first, breaks)
    handles = [draw_initial(axes, first[rows], ends)]
    for step, colour in zip(steps, style.sequence(len(steps))):
        table = result.contact(step)
        axes.plot(*joined(ends, table["X"][rows], table["Y"][rows]), color=colour)
        handles.append(Line2D([], [], color=colour, label=result.clock.text(result.times[step])))
        for panel in below:
            panel.plot(*joined(breaks, along(first), table["wear_depth"]), color=colour)
    frame(axes, last)
    stretch, ratio = scale(axes)
    axes.set_xlabel(across(stretch, result.axes[0]))
    axes.set_ylabel(f"${result.axes[1].upper()}$ [mm]")
    ratio = min(ratio, HIGHEST)
    for panel in below:
        frame_depths(panel, along(first), last)
        panel.set_xlabel("length along the initial surface [mm]")
        panel.set_ylabel("wear depth [mm]")
        if result.has_pairs:
            name_bodies(panel, result, first)
    columns = min(4, style.legend_columns(handles, 0.9 * style.SINGLE))
    heights = [ratio] + [DEPTHS] * len(below)
    axes.get_gridspec().set_height_ratios(heights)
    figure.set_figheight(sum(heights) * 0.86 * style.SINGLE + 0.52 * len(heights)
                         + 0.15 * -(-len(handles) // columns))
    style.legend(axes, handles, columns=columns)
    return figure


def draw_initial(axes, table, breaks=()):
    return axes.plot(*joined(breaks, table["X0"], table["Y0"]), color="black", linestyle=":",
                     linewidth=0.8, label="initial")[0]


def is_hidden(table):
    """Whether the worn surface could not be told from the initial one: wear is a small part of the
    height that the picture must show."""
    heights = numpy.concatenate([table["Y0"][worn_part(table)], table["Y"][worn_part(table)]])
    return 0 < table["wear_depth"].max() < SEEN * numpy.ptp(heights)


def sides_of(result):
    return {tuple(side) for side in numpy.sort(plane.outline(result.cells), axis=1)}


def breaks_of(result, table):
    """The rows after which the surface does not go on: rows follow each other along it."""
    sides = sides_of(result)
    nodes = table["node"]
    pairs = numpy.sort(numpy.stack([nodes[:-1], nodes[1:]], axis=1), axis=1)
    return 1 + numpy.flatnonzero([tuple(pair) not in sides for pair in pairs])


def outline(result, table, breaks):
    """Rows along the surface, the first of a closed curve once more at its end."""
    sides = sides_of(result)
    pieces = numpy.split(numpy.arange(len(table)), breaks)
    closed = [tuple(sorted(table["node"][piece[[0, -1]]])) in sides and len(piece) > 2
              for piece in pieces]
    rows = [numpy.append(piece, piece[0]) if close else piece
            for piece, close in zip(pieces, closed)]
    ends = numpy.cumsum([len(piece) for piece in rows])[:-1]
    return numpy.concatenate(rows), ends


def joined(breaks, *columns):
    """Columns with gaps in the line where the surface does not go on."""
    return [numpy.insert(numpy.asarray(column, float), list(breaks), numpy.nan) for column in columns]


def along(table):
    """The length along the initial surface up to each row; from one surface to the next, straight."""
    steps = numpy.hypot(numpy.diff(table["X0"]), numpy.diff(table["Y0"]))
    return numpy.concatenate([[0], numpy.cumsum(steps)])


def name_bodies(axes, result, table):
    """Of two bodies that meet: whose surfaces follow each other along the axis, above it."""
    length, bodies = along(table), result.bodies[table["node"]]
    left, right = axes.get_xlim()
    starts = numpy.flatnonzero(numpy.diff(bodies, prepend=-1))
    for start, end in zip(starts, [*starts[1:], len(bodies)]):
        low, high = max(length[start], left), min(length[end - 1], right)
        if low < high:
            axes.annotate(result.names_of_bodies.get(bodies[start], ""), ((low + high) / 2, 1),
                          xycoords=("data", "axes fraction"), xytext=(0, 2),
                          textcoords="offset points", ha="center", fontsize=7,
                          annotation_clip=False)


def frame_depths(axes, length, table):
    """The part that is worn at the end and a margin, depths downwards."""
    seen = length[worn_part(table)]
    margin = 0.12 * numpy.ptp(seen)
    axes.set_xlim(max(seen.min() - margin, 0), min(seen.max() + margin, length[-1]))
    axes.set_ylim(1.08 * table["wear_depth"].max(), 0)


def frame(axes, table):
    """The part that is worn at the end and a margin; the whole surface if there is no wear."""
    worn = worn_part(table)
    left, right = table["X0"][worn].min(), table["X0"][worn].max()
    margin = 0.12 * (right - left)
    left = max(left - margin, table["X0"].min())
    right = min(right + margin, table["X0"].max())
    seen = (table["X0"] >= left) & (table["X0"] <= right)
    heights = numpy.concatenate([table["Y0"][seen], table["Y"][seen]])
    low, high = heights.min(), heights.max()
    pad = 0.06 * (high - low) or 0.05 * (right - left)
    axes.set_xlim(left, right)
    axes.set_ylim(low - pad, high + pad)


def worn_part(table):
    depth = table["wear_depth"]
    worn = depth > 1e-6 * depth.max() if depth.max() > 0 else numpy.ones(len(depth), bool)
    return worn if worn.sum() > 1 else numpy.ones(len(depth), bool)


def scale(axes, lowest=0.22):
    """Equal scales if that gives a useful picture, otherwise the least round magnification of the
    height. Returns the magnification, and height divided by width of the panel."""
    (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
    ratio = (high - low) / (right - left)
    stretch = next((s for s in STRETCHES if s * ratio >= lowest), STRETCHES[-1])
    axes.set_aspect(stretch)
    return stretch, stretch * ratio


def across(stretch, name="x"):
    return f"${name.upper()}$ [mm]" + ("" if stretch == 1 else f"   (heights drawn {stretch}×)")
