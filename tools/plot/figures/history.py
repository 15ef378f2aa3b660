"""The work of the integrator: sizes and orders of steps, events, rejections, Newton iterations."""

import numpy

from . import style
from .complaints import Unsuitable


def draw(result):
    table = result.history
    if len(table) < 2:
        raise Unsuitable("no step was taken")
    figure = style.figure(height=1.15 * style.SINGLE)
    sizes, orders, iterations = figure.subplots(3, 1, sharex=True, height_ratios=[2.2, 1, 1.2])
    unit, seconds = result.clock
    edges = table["t"] / seconds
    draw_sizes(sizes, table, seconds)
    orders.stairs(table["order"][1:], edges, baseline=None, color=style.COLOURS[0])
    highest = max(int(table["order"].max()), 2)
    orders.set_ylim(0.5, highest + 0.5)
    orders.set_yticks(range(1, highest + 1))
    iterations.stairs(table["step_newton_iterations"][1:], edges, fill=True,
                      color=style.COLOURS[4])
    iterations.set_ylim(bottom=0)
    iterations.yaxis.get_major_locator().set_params(integer=True)
    sizes.set_ylabel("step size [s]" if unit == "s" else "accepted jump\n[cycles]")
    orders.set_ylabel("order")
    iterations.set_ylabel("Newton\niterations")
    iterations.set_xlabel("time [s]" if unit == "s" else unit)
    iterations.set_xlim(edges[0], edges[-1])
    figure.align_ylabels()
    return figure


def draw_sizes(axes, table, seconds):
    """Events below, rejections on the step that followed them."""
    time, size = table["t"] / seconds, table["step_size"][1:] / seconds
    end = time[1:]
    axes.stairs(size, time, baseline=None, color=style.COLOURS[0], linewidth=0.9)
    axes.plot(end - 0.5 * size, size, linestyle="", marker=".", markersize=2.5, clip_on=False,
              color=style.COLOURS[0])
    if size.max() > 20 * size.min() > 0:
        axes.set_yscale("log")
        axes.set_ylim(size.min() / 2.5, size.max() * 1.6)
    else:
        axes.set_ylim(0, size.max() * 1.15)
    rejected = numpy.diff(table["rejected_steps"])
    tried = rejected > 0
    if tried.any():
        axes.plot((end - 0.5 * size)[tried], size[tried], linestyle="", marker="x",
                  color=style.COLOURS[1], markeredgewidth=0.9,
                  label=f"after rejected attempts ({rejected.sum()})")
    located = table["switched"][1:] > 0
    if located.any():
        axes.plot(end[located], numpy.full(located.sum(), 0.06), linestyle="", marker="|",
                  color="black", markersize=5, markeredgewidth=0.7,
                  transform=axes.get_xaxis_transform(),
                  label=f"located events ({located.sum()})")
    style.legend(axes, columns=2)
