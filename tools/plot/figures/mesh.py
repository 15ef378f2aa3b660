"""The worn mesh, the equivalent stress in the deformed body and, in the plane, a window around
contact (figs. 1, 3; in space, seen obliquely, figs. 7, 9, 12, 14)."""

import numpy
from matplotlib.ticker import MaxNLocator

from . import counter, plane, space, style
from .complaints import Unsuitable

WIDE = 1.25  # a body that is wider than this times its height gets a figure of a page's width
ZOOM = 0.7  # part of the body's width: a larger contact needs no window of its own
LOWEST, TALLEST = 0.5, 3.6  # inch: panels of bodies in the plane
MANY_FACES = 1000  # in space, above this number an SVG contains them as a bitmap


def draw(result):
    nodes = {2: 4, 3: 8}[result.dim]
    if result.cells.shape[1] != nodes:
        raise Unsuitable(f"cells of {result.cells.shape[1]} nodes")
    return draw_plane(result) if result.dim == 2 else draw_space(result)


class State:
    """A stored step: the worn body, the deformed one, its stress and where it is in contact."""

    def __init__(self, result, step):
        self.step, self.time = step, "$t$ = " + result.clock.text(result.times[step])
        self.worn = result.points + result.field(step, "shape")
        self.deformed = self.worn + result.field(step, "displacement")
        self.stress = result.field(step, "equivalent_stress")


def stress_bar(figure, panels, states):
    highest = max(state.stress.max() for state in states)
    return style.colour_bar(figure, panels, highest, "equivalent stress [MPa]")


def draw_plane(result):
    """Rows: the worn mesh, the deformed body, and contact; one column per time."""
    states = [State(result, step) for step in [0, *result.some_steps(1)]]
    whole = plane.box(numpy.concatenate([points for state in states
                                         for points in (state.worn, state.deformed)]))
    size = whole[1] - whole[0]
    wide = size[0] > WIDE * size[1]
    width = style.DOUBLE if wide else style.SINGLE
    panel = width / len(states) - 0.5  # inch, within the axes
    whole = plane.widened(whole, LOWEST / panel, TALLEST / panel)  # room for the numbers
    body = panel * (whole[1] - whole[0])[1] / (whole[1] - whole[0])[0]
    windows = [plane.window(result.contact(state.step), state.deformed) for state in states]
    small = [window is not None and window[1][0] - window[0][0] < ZOOM * size[0]
             for window in windows]
    heights = [body, body] + ([panel * plane.FLATNESS] if any(small) else [])
    figure = style.figure(width=width, height=sum(heights) + 0.31 * len(heights) + 0.8)
    below = 0.06 / figure.get_figheight()  # tall panels would push the last label out
    figure.get_layout_engine().set(rect=(0, below, 1, 1 - below))
    panels = figure.subplots(len(heights), len(states), squeeze=False, height_ratios=heights)
    scale = stress_bar(figure, panels, states)
    for column, state, window, shown in zip(panels.T, states, windows, small):
        draw_column(result, column, state, scale, whole, window if shown else None, 72 * panel)
    label(result, panels, any(small))
    return figure


def draw_column(result, column, state, scale, whole, window, paper):
    white = numpy.ones((len(result.cells), 4))
    colours = scale.to_rgba(state.stress)
    plane.draw_body(column[0], result, state.worn, white, whole, paper)
    column[0].set_title(f"{state.time}\nundeformed")  # one line would be wider than a narrow panel
    for axes, frame, name in zip(column[1:], (whole, window), ("deformed", "contact")):
        if frame is None:
            axes.set_axis_off()
            continue
        plane.draw_body(axes, result, state.deformed, colours, frame, paper)
        counter.draw_line(axes, result, state.step, frame[1][0] - frame[0][0])
        axes.set_title(name)
    if window is not None:
        plane.mark(column[1], window)


def label(result, panels, zoomed):
    for axes in panels[:, 0]:
        axes.set_ylabel(f"${result.axes[1]}$ [mm]")
    for axes in panels[-1]:
        axes.set_xlabel(f"${result.axes[0]}$ [mm]")
    for axes in panels.flat:
        axes.xaxis.set_major_locator(MaxNLocator(4))
        axes.yaxis.set_major_locator(MaxNLocator(4))
    for column in panels.T:
        for axes in column[:1]:
            axes.tick_params(labelbottom=False)


def draw_space(result):
    view = space.View(result)
    states = [State(result, step) for step in [0, *result.some_steps(2)]]
    figure = style.figure(width=style.DOUBLE)
    panel = style.DOUBLE / len(states)
    panels = figure.subplots(2, len(states), sharex=True, sharey=True, squeeze=False)
    scale = stress_bar(figure, panels, states)
    for column, state in zip(panels.T, states):
        corners, _, light = view.polygons(state.worn)
        add_faces(column[0], corners, shaded(numpy.ones((len(corners), 4)), light), panel)
        corners, cells, light = view.polygons(state.deformed)
        add_faces(column[1], corners, shaded(scale.to_rgba(state.stress[cells]), light),
                  panel)
        counter.draw_patch(column[1], result, state.step, view, state.deformed)
        column[0].set_title(state.time)
    for axes in panels.flat:
        axes.set(xticks=[], yticks=[])
        axes.spines[:].set_visible(False)
    space.finish(panels[0, 0])
    for axes, what in zip(panels[:, 0], ("undeformed", "deformed")):
        space.add_arms(axes, view.screen)
        axes.set_ylabel(what)
    tall = 2 * 0.86 * panel * space.ratio(panels[0, 0]) + 0.9
    figure.set_figheight(min(tall, 2.4 * style.SINGLE))
    return figure


def shaded(colours, light):
    """Darker where a face is turned away, but not so much that colours could be confused."""
    colours = colours.copy()
    colours[:, :3] *= (0.75 + 0.25 * light)[:, None]
    return colours


def add_faces(axes, corners, colours, panel):
    """`panel`: its width [inch]."""
    scale = 72 * panel / numpy.ptp(corners[..., 0])
    space.add_faces(axes, corners, colours, scale, MANY_FACES)
    axes.set_aspect("equal")
