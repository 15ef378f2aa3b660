"""Evolution of the contact surface: the worn undeformed shape at stored times (figs. 2, 4)."""

import numpy
from matplotlib.lines import Line2D

from . import style
from .complaints import Unsuitable

STRETCHES = (1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
MOST_TIMES = 6


def draw(result):
    if result.dim != 2:
        raise Unsuitable("the contact surface is not a curve")
    steps = result.some_steps(MOST_TIMES)
    figure = style.figure()
    axes = figure.add_subplot()
    handles = [draw_initial(axes, result.contact(0))]
    for step, colour in zip(steps, style.sequence(len(steps))):
        table = result.contact(step)
        order = numpy.argsort(table["X0"])
        axes.plot(table["X"][order], table["Y"][order], color=colour)
        handles.append(Line2D([], [], color=colour, label=f"{style.number(result.times[step])} s"))
    frame(axes, result.contact(steps[-1] if steps else 0))
    stretch, ratio = scale(axes)
    axes.set_xlabel(across(stretch, result.axes[0]))
    axes.set_ylabel(f"${result.axes[1].upper()}$ [mm]")
    figure.set_figheight(ratio * 0.86 * style.SINGLE + 0.52 + 0.15 * -(-len(handles) // 4))
    style.legend(axes, handles, columns=4)
    return figure


def draw_initial(axes, table):
    order = numpy.argsort(table["X0"])
    return axes.plot(table["X0"][order], table["Y0"][order], color="black", linestyle=":",
                     linewidth=0.8, label="initial")[0]


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
