"""Geometry behind the figures of bodies in the plane, and of the drawing of meshes.

usage: check_plane.py FOLDER_OF_THE_PLOTS
"""

import sys
import types

import matplotlib
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
from figures import counter, curves, cycle, groups, mesh, plane, pressure, shape, style  # noqa: E402
from figures.complaints import Unsuitable  # noqa: E402
from figures.result import Clock, Item, Result, Surface  # noqa: E402

style.apply()
N = (16, 4)
HALF, DEPTH = 4.0, 2.0


def block():
    """A block of 8 x 2 below y = 0, twice as wide as tall and more."""
    x, y = (g.ravel(order="F") for g in np.meshgrid(np.linspace(-HALF, HALF, N[0] + 1),
                                                    np.linspace(-DEPTH, 0, N[1] + 1),
                                                    indexing="ij"))
    number = np.arange(len(x)).reshape([n + 1 for n in N], order="F")
    cells = [number[i:i + N[0], j:j + N[1]].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return np.stack([x, y, 0 * x], axis=1), np.stack(cells, axis=1), number[:, -1]


points, cells, top = block()


def table(width):
    """The pressure is positive on nodes within `width` of x = 0."""
    x, y, _ = points[top].T
    load = np.where(np.abs(x) <= width, 5.0, 0.0)
    columns = {"node": top, "X0": x, "Y0": y, "Z0": 0 * x, "x": x, "y": y, "pressure": load}
    return np.rec.fromarrays(list(columns.values()), names=list(columns))


sides = plane.outline(cells)
assert len(sides) == 2 * sum(N) and len(np.unique(sides)) == 2 * sum(N)

low, high = plane.window(table(1.0), points)
assert low[0] < -1.5 and high[0] > 1.5, "to the first open nodes"
assert np.isclose((high - low)[1] / (high - low)[0], plane.FLATNESS)
assert low[1] < 0 < high[1] and -low[1] > high[1], "more of the body than of what is above it"
assert np.isclose(low[0], -high[0])
assert plane.window(table(-1.0), points) is None, "without contact there is no window"

# A facet has the counter-body on its left: walking to -x below it, the band is below.
ends = np.array([[[1.0, 0.0], [-1.0, 0.0]]])
assert np.allclose(counter.band(ends, 0.3)[0, 2:, 1], -0.3)
assert np.allclose(counter.outside(np.array([[0, 0, 0], [5, 0, 0], [0, 1.6, 0]]), points),
                   [0, 0.125, 0.2])


def result(width=1.0, surface=None, stress=None):
    zero = np.zeros_like(points)
    fields = {"shape": zero, "displacement": zero,
              "equivalent_stress": np.arange(len(cells)) if stress is None else stress}
    return types.SimpleNamespace(has_pairs=False,
        points=points, cells=cells, dim=2, times=np.array([0.0, 100.0]), axes=("x", "y"),
        clock=Clock("s", 1.0),
        some_steps=lambda most: [1], contact=lambda _: table(width),
        field=lambda _, name: fields[name], counter_body=lambda _: surface)


def overlaps(figure):
    """Pairs of texts that cover each other."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    texts = [text for axes in figure.axes for text in
             [axes.title, axes.xaxis.label, axes.yaxis.label, *axes.texts] if text.get_text()]
    boxes = [text.get_window_extent(canvas.get_renderer()) for text in texts]
    return [(texts[i].get_text(), texts[j].get_text()) for i in range(len(boxes))
            for j in range(i) if boxes[i].overlaps(boxes[j])]


def outside(figure):
    """Texts that are not wholly in the picture."""
    figure.draw_without_rendering()
    whole = figure.bbox.padded(0.5)
    texts = [text for axes in figure.axes if axes.axison for text in
             [axes.title, axes.xaxis.label, axes.yaxis.label, *axes.texts]
             if text.get_text() and text.get_visible()]
    boxes = [text.get_window_extent() for text in texts + figure.legends]
    return [str(text) for text, box in zip(texts + figure.legends, boxes)
            if box.x0 < whole.x0 or box.y0 < whole.y0 or box.x1 > whole.x1 or box.y1 > whole.y1]


line = np.stack([np.linspace(5, -5, 50), np.full(50, -0.01), np.zeros(50)], axis=1)
floor = Surface(line, np.stack([np.arange(49), np.arange(1, 50)], axis=1))
wide = mesh.draw(result(surface=floor))
assert np.isclose(wide.get_figwidth(), style.DOUBLE), "a wide body gets a page's width"
assert not overlaps(wide), overlaps(wide)
panels = [axes for axes in wide.axes if "contact" in axes.get_title()]
assert len(panels) == 2 and all(np.ptp(axes.get_xlim()) < 5 for axes in panels)
whole = [axes for axes in wide.axes if axes.get_title().startswith("deformed")]
for axes in whole:
    assert axes.get_xlim()[0] <= -HALF and axes.get_xlim()[1] < 5, "the body sets the limits"
    assert len(axes.collections) == 5, "cells, lines, outline, counter-body and its band"
# Very flat, flat, square, tall, very tall; with a time of many digits.
for stretch in ([1, 0.002, 1], [1, 0.4, 1], [1, 4, 1], [0.1, 4, 1], [0.002, 1, 1]):
    extreme = result()
    extreme.points = points * stretch
    extreme.times = np.array([0.0, 12340.0])
    figure = mesh.draw(extreme)
    assert not overlaps(figure) and figure.get_figheight() < 11, stretch
    assert not outside(figure), (stretch, outside(figure))
plain = mesh.draw(result(width=10.0))
assert not [axes for axes in plain.axes if "contact" in axes.get_title()], "all is in contact"

# The coordinates of a body of revolution have their own names.
def result_of(table):
    made = Result.__new__(Result)
    made._read = lambda _: Item(f'problem = "worn_body"\n{table}'.encode(), {})
    return made


def axes_of(plane_key):
    return result_of(f'[model]\nplane = "{plane_key}"\n').axes


# Where the scene has a cycle, its cycles count the time.
assert result_of("[time]\nend = 3.0  # [s]\n").clock.text(100.0) == "100 s"
# Digits are enough for `gnomon contact --time`, which takes a time that rounds to the number.
assert result_of("[time]\nend = 3.0  # [s]\n").clock.text(11618.9986) == "11619 s"
counted = result_of("[time]\nend = 3.0\n\n[cycle]\nperiod = 2.5e-1  # [s] duration\n").clock
assert counted.text(100.0) == "400 cycles"

assert axes_of("strain")[:2] == ("x", "y") and axes_of("axisymmetric") == ("r", "z")
turned = result(surface=floor)
turned.axes = ("r", "z")
labels = {axes.get_ylabel() for axes in mesh.draw(turned).axes}
assert "$z$ [mm]" in labels and "$y$ [mm]" not in labels, labels

# Mesh lines only where they can be seen, in each direction: cells are 0.5 times 0.5, then 1 to 0.1.
def lines(stretch, scale):
    """Number and directions of the lines that are drawn."""
    axes = style.figure().add_subplot()
    plane.add_cells(axes, points[cells][:, :, :2] * stretch, np.ones((len(cells), 4)), scale)
    segments = np.array(axes.collections[1].get_segments()).reshape(-1, 2, 2)
    return len(segments), set(np.abs(np.diff(segments, axis=1)).argmax(axis=2).ravel())


assert lines([1, 1], 100) == (4 * len(cells), {0, 1})
assert lines([1, 1], 1) == (0, set())
assert lines([2, 0.2], 4) == (2 * len(cells), {1}), "those along x are too close to each other"

# Curves that can be read on one axis have it in common; the highest are above.
assert pressure.groups_of([130.0, 11.0, 9.0, 5.0]) == [[0], [1, 2, 3]]
assert pressure.groups_of([12.0, 11.0, 9.0, 5.0]) == [[0, 1, 2, 3]]
assert pressure.groups_of([130.0, 140.0, 0.0, 3.0, 20.0]) == [[0, 1], [4], [2, 3]]
assert pressure.groups_of([0.0]) == [[0]] and pressure.groups_of([5.0, 0.0]) == [[0, 1]]
assert len(pressure.groups_of([1e6, 1e4, 1e2, 1.0, 1e-2])) == pressure.MOST_ROWS
sharp = result()
loads = {0: (0.3, 26.0), 1: (3.0, 1.0)}  # half widths and factors: the start is far higher


def sharp_table(step):
    made = table(loads[step][0])
    made["pressure"] *= loads[step][1]
    return made


sharp.contact = sharp_table
figure = pressure.draw(sharp)
assert [axes.get_ylim() for axes in figure.axes] == [(0, 1.08 * 130), (0, 1.08 * 5)]
assert [len(axes.lines) for axes in figure.axes] == [1, 1]
assert [text.get_text() for text in figure.legends[0].get_texts()] == ["0 s", "100 s"]


# Wear that a deep surface would hide is drawn by its depth; rows that are not joined leave a gap.
def bore(depth, half=1.5):
    angle = np.linspace(-half, half, 41)
    x, y = 10 * np.sin(angle), -10 * np.cos(angle)
    deep = depth * np.maximum(np.cos(3 * angle), 0) * (np.abs(angle) < 0.6)
    node = np.arange(41)
    ring = np.stack([node[:-1], node[1:], node[1:] + 41, node[:-1] + 41], axis=1)
    columns = {"node": node, "X0": x, "Y0": y, "X": (1 + deep / 10) * x, "Y": (1 + deep / 10) * y,
               "wear_depth": deep}
    made = np.rec.fromarrays(list(columns.values()), names=list(columns))
    return types.SimpleNamespace(cells=ring[np.arange(40) != 5], dim=2, times=np.array([0.0, 9.0]),
                                 has_pairs=False, axes=("x", "y"), clock=Clock("s", 1.0), some_steps=lambda most: [1],
                                 contact=lambda step: made)


upper_panel, lower_panel = shape.draw(bore(0.01)).axes
assert np.isnan(upper_panel.lines[1].get_xdata()).sum() == 1, "no cell joins rows 5 and 6"
assert lower_panel.get_ylim() == (1.08 * 0.01, 0)
length = lower_panel.lines[0].get_xdata()
assert np.isclose(np.nanmax(length), 30, rtol=1e-3), "an arc of 3 rad with a radius of 10"
assert np.isclose(length[np.nanargmax(lower_panel.lines[0].get_ydata())], 15, rtol=1e-3)
assert len(shape.draw(bore(2.0)).axes) == 1, "deep wear is seen by itself"

# Surfaces of two bodies follow each other, each below its name.
two = bore(0.01)
two.has_pairs, two.bodies = True, np.repeat([0, 20], [20, 21])
two.names_of_bodies = {0: "ring", 20: "block"}
names = shape.draw(two).axes[1].texts
assert [name.get_text() for name in names] == ["ring", "block"]
assert names[0].xy[0] < 15 < names[1].xy[0]

# Colours mean the same at all times: where the highest stress falls to a half, the range does not.
fading = result()
fading.field = lambda step, name: result().field(step, name) * (0.5 if step else 1)
drawn = mesh.draw(fading).axes
whole = [axes.collections[0] for axes in drawn if axes.get_title().startswith("deformed")]
assert [tuple(cells_of.get_facecolor()[-1]) for cells_of in whole] == \
    [matplotlib.colormaps[style.STRESS_MAP](part) for part in (1.0, 0.5)]
assert [axes.get_xlabel() for axes in drawn].count("equivalent stress [MPa]") == 1

# The difference: of the same nodes, though they have moved; else between them.
first, second = (table(1.0) for _ in range(2))
second["x"] += 0.01
second["pressure"] += 0.25
where, difference = pressure.difference(first, second, "x")
assert np.allclose(difference, 0.25) and np.array_equal(where, first["x"])
coarse = second[::2]
coarse["x"] = coarse["X0"]
coarse["pressure"] = 2 * coarse["x"]
first["pressure"] = 2 * first["x"] - 1
where, difference = pressure.difference(first, coarse, "x")
assert np.allclose(difference, 1)

# Labels of groups lie outside of the body, which is to the left of their facets.
x = np.linspace(HALF, -HALF, 9)
ends = np.stack([np.stack([end, 0 * end], axis=1) for end in (x[:-1], x[1:])], axis=1)
place, outward = groups.anchor(ends)
assert np.allclose(outward, [0, 1]) and abs(place[0]) <= 0.5
body = groups.Part("body", points, cells)
upper = np.stack([top[1:], top[:-1]], axis=1)
figure = groups.draw(body, [groups.Part("upper side", points, upper),
                            groups.Part("one point", points[:1], np.zeros((1, 1), int))])
names = [text.get_text() for text in figure.legends[0].get_texts()]
assert names == ["upper side: 16 facets", "one point: points, 1"], names
assert {"upper side", "one point"} <= {text.get_text() for text in figure.axes[0].texts}
pieces = groups.chains(np.array([[0, 1], [1, 2], [7, 8], [8, 9], [9, 10]]))
assert [list(piece) for piece in pieces] == [[0, 1], [2, 3, 4]], "each gets the name"

# Names stay in the picture of a body of any shape, and leave it its place.
for stretch in ([1, 0.1, 1], [1, 4, 1], [0.02, 4, 1]):
    long = [groups.Part(f"{name} of the part that is worn", points * stretch, facets)
            for name, facets in (("upper side", upper[::-1]), ("wall", cells[N[0] - 1::N[0], [1, 2]]))]
    figure = groups.draw(groups.Part("body", points * stretch, cells), long)
    assert not outside(figure), (stretch, outside(figure))
    assert figure.axes[0].get_window_extent().height > 0.4 * figure.bbox.height, stretch

# A phase stands for the part of the cycle to the middles between it and its neighbours.
borders = cycle.parts_of_cycle(np.array([0.0, 0.5, 0.75]))
assert np.allclose(borders[3:7], [-0.125, 0.25, 0.625, 0.875]) and len(borders) == 10
assert (np.diff(borders) > 0).all() and borders[0] < 0 and borders[-1] > 1

# Over a cycle, the map of each time has the pressures of its phases on the initial surface.
steady = table(1.0)
cyclic = result()
cyclic.clock = Clock("cycles", 0.5)
cyclic.phases = np.array([0.25, 0.75])
cyclic.phase_pressure = lambda step: np.stack([steady["pressure"], 0 * steady["pressure"]])
cyclic_map = cycle.draw(cyclic)
assert not overlaps(cyclic_map) and not outside(cyclic_map)
assert {axes.get_title() for axes in cyclic_map.axes} >= {"$t$ = 0 cycles", "$t$ = 200 cycles"}
assert [axes.get_xlabel() for axes in cyclic_map.axes].count("pressure [MPa]") == 1
where, values = cycle.map_of(cyclic, curves.of(cyclic)[0], 1)
assert (np.diff(where) > 0).all() and values.shape == (2, len(where))
assert (values[0][np.abs(where) <= 1] == 5).all() and not values[1].any()
assert not cycle.goes_back(cyclic) and cycle.goes_back(bore(0.01, 2.5))


# The pressure in a full bore, which x does not order, is drawn along it and not cut in two where it begins.
def full_bore(count, of_top=0.0, begin=0, way=1):
    """Pressure around the lowest point, where rows begin or `begin` rows after it, and `of_top` at
    the highest one; `way`: the sense of the rows."""
    angle = 2 * np.pi * np.arange(begin, begin + count) / count
    x, y = -10 * way * np.sin(angle), -10 * np.cos(angle)
    load = np.maximum(np.cos(angle) - 0.5, 0) + np.where(angle == np.pi, of_top, 0)
    node = np.arange(count)
    ring = np.stack([node, np.roll(node, -1), np.roll(node, -1) + count, node + count], axis=1)
    columns = {"node": node, "X0": x, "Y0": y, "Z0": 0 * x, "x": x, "y": y, "pressure": load}
    made = np.rec.fromarrays(list(columns.values()), names=list(columns))
    return types.SimpleNamespace(cells=ring, dim=2, times=np.array([0.0, 9.0]), has_pairs=False,
                                 axes=("x", "y"), clock=Clock("s", 1.0), name="bore", history=[0, 1],
                                 some_steps=lambda most: [1], attribute=lambda _: "worn_body",
                                 contact=lambda step: made)


figure = pressure.draw(full_bore(80))
length, load = figure.axes[0].lines[1].get_data()
assert (np.diff(length) > 0).all() and len(length) == 81, "one turn"
assert np.allclose(length[load > 0], -length[load > 0][::-1]), "the contact is in one piece"
assert np.isclose(length[np.argmax(load)], 0) and np.sum(np.diff(load > 0) != 0) == 2
assert figure.axes[0].get_xlabel() == "length along the initial surface [mm]"
length = pressure.draw(full_bore(80, of_top=1.0)).axes[0].lines[1].get_xdata()
assert np.isclose(np.ptp(length), 160 * 10 * np.sin(np.pi / 80)), "also where it is touched opposite"

# Of two bodies that meet it is told whose pressure it is.
pair = full_bore(80)
pair.has_pairs, pair.bodies, pair.names_of_bodies = True, np.zeros(80, int), {0: "cam"}
assert pressure.draw(pair).axes[0].get_xlabel().endswith("   on cam")

# Two results are compared along it where their meshes begin at the same place.
figure = pressure.draw_two(full_bore(72), full_bore(120))
assert np.abs(figure.axes[-1].lines[1].get_ydata()).max() < 0.01

# At the start, too, in black; the dashes are not hidden by dots of nodes.
assert [text.get_text() for text in figure.legends[1].get_texts()] == ["0 s", "9 s"]
one, two = figure.axes[0].lines[:2]
assert one.get_color() == two.get_color() == "black" != figure.axes[0].lines[2].get_color()
assert one.get_linestyle() == "-" and two.get_linestyle() == "--"
assert one.get_marker() == two.get_marker() == ""
for other in (full_bore(120, begin=30), full_bore(80, way=-1)):
    try:
        pressure.draw_two(full_bore(80), other)
        raise AssertionError("lengths of other places")
    except Unsuitable:
        pass
