#!/usr/bin/env python3
"""A ball that passes over a block as the positions of a cycle, against the built-in groove that is uniform along its
path: the tables of docs/notes/validation.md and their figure, written into the folder that is named
(python3 groove_cycle.py docs)."""

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "plot"))

from figures import style
from program import percent, run, table

RADIUS, FORCE, YOUNG, WEAR, PASSES = 5.0, 100.0, 1e5, 1e-7, 200
SECTION = WEAR * FORCE * PASSES  # k F for each pass [mm^2]
HERTZ = (3 * FORCE * RADIUS / (4 * YOUNG / (1 - 0.3**2))) ** (1 / 3)
ACROSS, DOWN = 9, 4  # elements of 0.1 mm and 0.2 mm
REST = 0.7  # mm, the block beyond the ends of the path

BODY = f"""body = {{ young_modulus = {YOUNG}, poisson_ratio = 0.3, material = "linear" }}
wear.coefficient = {WEAR}
wear.rate = "k * p * v"
time.end = {PASSES}
integrator = {{ name = "esdirk-3", rtol = 1e-4 }}
output.every = 0
"""

BLOCK = """Point(1) = {{{begin}, 0, -0.8}};
Point(2) = {{{begin}, 0.9, -0.8}};
Point(3) = {{{begin}, 0.9, 0}};
Point(4) = {{{begin}, 0, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = {across} + 1;
Transfinite Curve {{2, 4}} = {down} + 1;
Transfinite Surface {{1}};
Recombine Surface {{1}};
part[] = Extrude {{{length}, 0, 0}} {{ Surface{{1}}; Layers{{{along}}}; Recombine; }};
Physical Surface("ends") = {{1, part[0]}};
Physical Surface("bottom") = {{part[2]}};
Physical Surface("side") = {{part[3]}};
Physical Surface("top") = {{part[4]}};
Physical Surface("symmetry") = {{part[5]}};
Physical Volume("block") = {{part[1]}};
"""

CYCLE = """problem = "worn_body"
mesh.file = "block.geo"
support = [ {{ on = "bottom" }}, {{ on = "ends" }}, {{ on = "side" }}, {{ on = "symmetry", directions = ["y"] }} ]
wear.on = ["top"]
[counter_body]
shape = "ball"
radius = {radius}
center = [0.0, 0.0, {radius}]
press = {{ direction = [0.0, 0.0, -1.0], force = {force} }}
[cycle]
period = 1.0
phases = [{phases}]
x = "{path} * (tau - 0.5)"
"""

GROOVE = """problem = "ball_on_half_space"
ball.radius = {radius}
block = {{ length = 1.4, half_width = 0.9, depth = 0.8 }}
path.length = 1.0
mesh = {{ elements = [{along}, {across}, {down}], size = [{element}, 0.1, 0.2], fine = [0.0, 0.0, 0.0] }}
load.force = {force}
friction.coefficient = 0.0
wear.velocity = 1.0
"""


def scene(text):
    folder = tempfile.TemporaryDirectory()
    path = pathlib.Path(folder.name) / "scene.toml"
    path.write_text(BODY + text)
    return folder, path


def built_in(element):
    along = round(1.4 / element)
    folder, path = scene(GROOVE.format(radius=RADIUS, force=FORCE, along=along, across=ACROSS, down=DOWN,
                                       element=element))
    with folder:
        return run(path)


def passing(positions, distance, element):
    """`distance` between two positions, a multiple of the elements along the path."""
    along = round((positions - 1) * distance / element) + 2 * round(REST / element)
    phases = ", ".join(f"{(p + 0.5) / positions:.15f}" for p in range(positions))
    folder, path = scene(CYCLE.format(radius=RADIUS, force=FORCE / 2, phases=phases, path=positions * distance))
    with folder:
        (path.parent / "block.geo").write_text(BLOCK.format(
            begin=-along * element / 2, length=along * element, along=along, across=ACROSS, down=DOWN))
        return run(path)


def section(done, x=0.0):
    """(y, z) of the nodes that were at x, from the plane of symmetry outwards."""
    return sorted((row["Y"], row["Z"]) for row in done.contact() if abs(row["X0"] - x) < 1e-6)


def area(points):
    return sum((b[0] - a[0]) * -(a[1] + b[1]) for a, b in zip(points, points[1:]))


def along_path(done, end):
    """(x, worn section there) up to `end`."""
    places = sorted({round(row["X0"], 6) for row in done.contact()})
    return [(x, area(section(done, x))) for x in places if abs(x) <= end + 1e-6]


def difference(done, reference):
    depth = -reference[0][1]
    return max(abs(a[1] - b[1]) for a, b in zip(section(done), reference)) / depth


def lengths_of_path(axes):
    """The ends of the path: phases at every node."""
    element = 0.1
    reference = section(built_in(element))
    axes[0].plot([y for y, _ in reference], [1e3 * z for _, z in reference], "o", markerfacecolor="none",
                 color="black", label="built-in groove")
    rows = []
    for positions, colour in zip((5, 9, 13, 17), style.sequence(4)):
        done = passing(positions, element, element)
        half = (positions - 1) / 2 * element
        points = section(done)
        volume = done.history()[-1]["worn_volume"] / (SECTION / 2 * positions * element)
        rows.append([positions, f"{half:.1f}", f"{half / HERTZ:.1f}", percent(area(points) / SECTION),
                     f"{100 * difference(done, reference):.2g} %", percent(volume, 5), f"{done.cpu:.0f}"])
        axes[0].plot([y for y, _ in points], [1e3 * z for _, z in points], color=colour,
                     label=f"path of ±{half:.1f} mm")
    axes[0].set(xlabel="y [mm]", ylabel="section at the middle of the path [µm]", xlim=(0, 0.5))
    print(f"Elements of {element} mm, Hertz's radius {HERTZ:.3f} mm; built-in section "
          f"{percent(area(reference) / SECTION)} of k F N\n")
    table(["phases", "half of the path [mm]", "by Hertz's radius", "section in the middle against k F N",
           "shape, of the built-in groove", "worn volume against k F path N", "CPU [s]"], rows)


def distances(axes):
    """The distance of phases: fewer than nodes."""
    element = 0.05
    reference = section(built_in(element))
    rows = []
    for step, colour in zip((1, 2, 3, 4, 6), style.sequence(5)):
        distance = step * element
        positions = 2 * round(0.6 / distance) + 1
        done = passing(positions, distance, element)
        x, areas = zip(*along_path(done, max(distance, 0.1)))
        middle = [a for place, a in along_path(done, distance / 2)]
        ripple = (max(middle) - min(middle)) / SECTION
        rows.append([positions, f"{distance:.2f}", f"{distance / HERTZ:.2f}", f"{100 * ripple:.2f} %",
                     percent(area(section(done)) / SECTION),
                     f"{100 * difference(done, reference):.2g} %", f"{done.cpu:.0f}"])
        x, areas = zip(*along_path(done, 0.4))
        axes[1].plot(x, [a / SECTION for a in areas], color=colour, label=f"phases {distance:.2f} mm apart")
    axes[1].set(xlabel="x, along the path [mm]", ylabel="worn section / k F N")
    print(f"Elements of {element} mm along the path, path of about ±0.6 mm\n")
    table(["phases", "distance [mm]", "by Hertz's radius", "ripple along the path",
           "section in the middle against k F N", "shape, of the built-in groove", "CPU [s]"], rows)


def main():
    style.apply()
    figure = style.figure(style.DOUBLE, 0.45 * style.DOUBLE)
    axes = figure.subplots(1, 2)
    lengths_of_path(axes)
    distances(axes)
    for panel in axes:
        style.legend(panel, columns=2)
    if len(sys.argv) > 1:
        figure.savefig(pathlib.Path(sys.argv[1]) / "groove_cycle.png", dpi=200)


if __name__ == "__main__":
    main()
