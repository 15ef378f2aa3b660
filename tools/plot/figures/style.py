"""The style of all figures: sizes, fonts, colours, labels, legends."""

import matplotlib
import numpy
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.textpath import TextPath
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

SINGLE = 85 / 25.4  # inch: width of a column
DOUBLE = 175 / 25.4  # and of a page

# Okabe and Ito's palette: distinguishable for colour-blind readers, from dark to light in print.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#8C6D31"]
DASHES = (0, (5, 2))
MARKERS = ["o", "s", "^", "D", "v", "p", ">", "<"]
GREY = "#8a8a8a"
BAND = "#dcdcdc"
STRESS_MAP = "viridis"

SETTINGS = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "axes.labelsize": 8,
    "axes.titlesize": 8,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "legend.fontsize": 7,
    "legend.frameon": False,
    "legend.handlelength": 1.8,
    "legend.columnspacing": 1.2,
    "legend.handletextpad": 0.5,
    "legend.borderaxespad": 0.2,
    "axes.linewidth": 0.6,
    "axes.unicode_minus": True,
    "xtick.direction": "in",
    "ytick.direction": "in",
    "xtick.top": True,
    "ytick.right": True,
    "xtick.minor.top": False,
    "ytick.minor.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "lines.linewidth": 1.1,
    "lines.markersize": 3.5,
    "svg.fonttype": "path",
    "figure.dpi": 100,
}


def apply():
    """Sets the style, independent of the user's settings."""
    matplotlib.rcdefaults()
    matplotlib.rcParams.update(SETTINGS)


def figure(width=SINGLE, height=0.75 * SINGLE):
    made = Figure(figsize=(width, height), layout="constrained")
    made.get_layout_engine().set(w_pad=0.02, h_pad=0.03, wspace=0.03, hspace=0.04)
    return made


def sequence(count):
    """Colours of ordered values, from dark to light, without the palest."""
    return [matplotlib.colormaps["viridis"](0.85 * i / max(count - 1, 1)) for i in range(count)]


def legend(axes, handles=None, columns=3, **further):
    """Above the axes, where it covers nothing."""
    handles = handles if handles is not None else axes.get_legend_handles_labels()[0]
    if not handles:
        return None
    return axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.0),
                       ncol=min(columns, len(handles)), **further)


def colour_bar(figure, panels, highest, text):
    """One range of colours from zero for all panels, so that they can be compared; returns it."""
    scale = ScalarMappable(Normalize(0, highest if highest > 0 else 1), STRESS_MAP)
    panels = numpy.asarray(panels)
    figure.colorbar(scale, ax=list(panels.flat), orientation="horizontal",
                    aspect=18 * panels.shape[-1], ticks=MaxNLocator(6), label=text)
    return scale


def label(axes, letter):
    """(a), (b), ... inside the upper left corner."""
    axes.text(0.02, 0.96, f"({letter})", transform=axes.transAxes, va="top", ha="left")


def number(value):
    """A short number, exact enough for a legend: four digits, and all before the point, because
    `gnomon contact --time` takes a zero there as exact."""
    short = f"{value:.0f}" if abs(value) >= 1e4 else f"{value:.4g}"
    return numpy.format_float_positional(float(short), trim="-") \
        if 1e-3 <= abs(value) < 1e6 or value == 0 else f"{value:.3g}"


def round_number(bound):
    """The largest number of one digit up to a bound."""
    power = 10.0 ** numpy.floor(numpy.log10(bound))
    return float(power * numpy.floor(1.000001 * bound / power))


def legend_above_all(figure, *groups):
    """Legends for all panels, one group below the other, in a separate strip above the panels."""
    width, height = figure.get_size_inches()
    groups = [group for group in groups if group]
    columns = [legend_columns(group, width) for group in groups]
    heights = [0.155 * -(-len(group) // n) + 0.05 for group, n in zip(groups, columns)]
    whole = height + sum(heights)
    figure.set_size_inches(width, whole)
    figure.get_layout_engine().set(rect=(0, 0, 1, height / whole))
    top = whole
    for group, n, strip in zip(groups, columns, heights):
        figure.legend(handles=group, loc="upper center", bbox_to_anchor=(0.5, top / whole), ncol=n,
                      borderpad=0.1)
        top -= strip


def legend_columns(handles, width):
    """As many as fit, by the widths of their texts at 7 pt and the keys before them."""
    widths = numpy.array([TextPath((0, 0), handle.get_label() or " ", size=7).get_extents().x1 / 72
                          for handle in handles])
    for columns in range(len(handles), 1, -1):
        widest = [part.max() for part in numpy.array_split(widths, columns)]
        if sum(0.345 + text for text in widest) <= width:
            return columns
    return 1


def log_ticks(axis):
    """Powers of ten; for less than two decades also 2 and 5, for less than a factor of five also
    numbers between them, all written as plain numbers."""
    low, high = axis.get_view_interval()
    axis.set_minor_formatter(NullFormatter())
    if high < 100 * low:
        subs = (1, 2, 5) if high > 5 * low else (1, 1.5, 2, 3, 4, 5, 6, 8)
        axis.set_major_locator(LogLocator(subs=subs))
        axis.set_major_formatter(FuncFormatter(lambda value, _: number(value)))
    else:
        axis.set_major_locator(LogLocator(numticks=12))


def power(unit):
    return unit.replace("^2", "²").replace("^3", "³")
