"""Worn shapes of a study: the longest fixed step of a method over its shortest (figs. 2, 4)."""

import string
from dataclasses import dataclass

import numpy
from matplotlib.lines import Line2D

from . import shape, style
from .complaints import Unsuitable
from .errors import sweep_text
from .result import Result
from .study import distinct


SHORTEST = {"color": "black", "linewidth": 0.7, "linestyle": (0, (4, 2))}


@dataclass
class Overlay:
    """Contact tables by stored time, of the longest and of the shortest step of a method."""

    method: str
    steps: tuple
    tables: tuple

    def times(self):
        """The times after the start that both have stored."""
        return [t for t in self.tables[0] if t > 0 and t in self.tables[1]]


def draw(folder, runs):
    """For one value of the sweep: one panel per method, one colour per stored time."""
    overlays = overlays_of(folder, runs)
    times = sorted({t for overlay in overlays for t in overlay.times()})
    if not times:
        raise Unsuitable("no stored time is common to a method's longest and shortest step")
    times = times[::-1][::-(-len(times) // shape.MOST_TIMES)][::-1]  # the last is one of them
    colours = dict(zip(times, style.sequence(len(times))))
    figure = style.figure()
    panels = figure.subplots(len(overlays), 1, sharex=True, squeeze=False)[:, 0]
    soundest = min((overlay.tables[1][max(overlay.times())] for overlay in overlays
                    if overlay.times()), key=lambda table: table["wear_depth"].max())
    for axes, letter, overlay in zip(panels, string.ascii_lowercase, overlays):
        draw_panel(axes, overlay, colours)
        axes.set_title(f"({letter}) {overlay.method}", loc="left")
        axes.set_title(sweep_text(runs[0].sweep), loc="right")
        axes.set_ylabel("$Y$ [mm]")
        shape.frame(axes, soundest)
        stretch, ratio = shape.scale(axes)
    panels[-1].set_xlabel(shape.across(stretch))
    figure.set_figheight(len(panels) * (ratio * 0.86 * style.SINGLE + 0.25) + 0.3)
    style.legend_above_all(figure, handles_of(colours), steps_of(overlays))
    return figure


def overlays_of(folder, runs):
    overlays = []
    for method in distinct(run.method for run in runs):
        own = sorted((run for run in runs if run.method == method and run.fixed_step),
                     key=lambda run: -run.setting)
        paths = [folder / "runs" / f"{run.run}.h5" for run in own]
        paths = [path for path in (paths[:1] + paths[1:][-1:]) if path.is_file()]
        if len(paths) == 2:
            overlays.append(Overlay(method, (own[0].setting, own[-1].setting),
                                    tuple(tables_of(path) for path in paths)))
    if not overlays:
        raise Unsuitable("no method has results of two fixed steps")
    return overlays


def tables_of(path):
    with Result(path) as result:
        if result.dim != 2:
            raise Unsuitable("the contact surface is not a curve")
        return {float(t): numpy.sort(result.contact(i), order="X0")
                for i, t in enumerate(result.times)}


def draw_panel(axes, overlay, colours):
    shape.draw_initial(axes, overlay.tables[1][0.0])
    longest, shortest = overlay.tables
    for t in overlay.times():
        if t in colours:
            axes.plot(longest[t]["X"], longest[t]["Y"], color=colours[t], linewidth=1.3)
            axes.plot(shortest[t]["X"], shortest[t]["Y"], **SHORTEST)  # visible where they coincide


def handles_of(colours):
    return [Line2D([], [], color=colour, label=f"{style.number(t)} s")
            for t, colour in colours.items()]


def steps_of(overlays):
    """The meaning of solid and dashed lines; the methods' steps may differ."""
    notes = [Line2D([], [], color="black", linestyle=":", linewidth=0.8, label="initial")]
    for i, look in enumerate(({"color": style.GREY, "linewidth": 1.3}, SHORTEST)):
        steps = sorted({overlay.steps[i] for overlay in overlays})
        text = " or ".join(style.number(step) for step in steps)
        notes.append(Line2D([], [], **look, label=f"steps of {text} s"))
    return notes
