#!/usr/bin/env python3
"""The ball joint under the load of walking: the tables of docs/notes/ball_joint.md and the figure
of worn volumes, written into the folder that is named (python3 ball_joint.py docs/tutorials)."""

import math
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "plot"))

import h5py
import numpy
from cycle_tables import compare
from figures import style
from matplotlib.ticker import MaxNLocator
from program import SCENES, percent, run, table

SCENE = SCENES / "ball_joint.toml"
RADIUS, COEFFICIENT = 14.0, 1e-9
COARSE = "mesh.factor=2"


def force_times_path():
    """Of a step, and the mean of the force over it [N mm, N]: the sum over the straight pieces of the tables."""
    tables = tomllib.loads(SCENE.read_text())["tables"]
    force, angle = tables["walking"]["y"], [math.radians(a) for a in tables["flexion"]["y"]]
    pairs = list(zip(force, force[1:], angle, angle[1:]))
    return (RADIUS * sum((f + g) / 2 * abs(b - a) for f, g, a, b in pairs),
            sum((f + g) / 2 for f, g, _, _ in pairs) / len(pairs))


def facets_of(result):
    """The bearing's, four nodes each."""
    with h5py.File(result) as file:
        names = [name.decode() for name in file["mesh/parts"].attrs["names"]]
        return file[f"mesh/parts/{names.index('bearing')}"][:].reshape(-1, 4)


def nodal_areas(result):
    """Of the bearing, a quarter of each of its facets [mm^2]."""
    with h5py.File(result) as file:
        points = file["mesh/points"][:]
    areas = {}
    for facet in facets_of(result):
        a, b = points[facet[2]] - points[facet[0]], points[facet[3]] - points[facet[1]]
        area = math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]) / 2
        for node in facet:
            areas[int(node)] = areas.get(int(node), 0) + area / 4
    return areas


def check_flux():
    """With constant speed the mean pressure that is stored says how fast the cup wears: the sum of k p v A."""
    done = run(SCENE, COARSE, 'cycle.rotation="0.3753 * (1 - 4 * abs(tau - 0.5))"')
    rows = []
    areas = nodal_areas(done.result)
    for time in (0, 1e6, 3e6, 5e6):
        flux = sum(COEFFICIENT * row["pressure"] * 4 * 0.3753 * math.hypot(row["X"], row["Z"])
                   * areas[int(row["node"])] for row in done.contact(time))
        printed = done.at(time)["wear_flux"]
        rows.append([f"{time:g}", f"{flux:.5g}", f"{printed:.5g}", percent(flux / printed)])
    table(["steps", "sum of k p v A [mm^3 per step]", "`wear_flux`", "difference"], rows)


def volumes(done):
    """Of the whole cup over millions of steps, and what is worn per step, by k times force times path."""
    rows = done.history()
    per_step = COEFFICIENT * force_times_path()[0]
    return ([row["t"] / 1e6 for row in rows], [4 * row["worn_volume"] for row in rows],
            [4 * row["wear_flux"] / per_step for row in rows])


def drawn(runs):
    figure = style.figure(style.DOUBLE, 0.4 * style.DOUBLE)
    left, right = figure.subplots(1, 2)
    for (label, done), colour, marker in zip(runs.items(), style.COLOURS, style.MARKERS):
        million, volume, ratio = volumes(done)
        left.plot(million, volume, marker=marker, color=colour, label=label)
        right.plot(million, ratio, marker=marker, color=colour, label=label)
    per_step = COEFFICIENT * force_times_path()[0]
    left.plot((0, 5), (0, 5e6 * per_step), "--", color=style.GREY, label="k times force times path")
    right.axhline(1, linestyle="--", color=style.GREY)
    right.axhline(4 / math.pi, linestyle=":", color=style.GREY, label="4/π: contact over the whole hemisphere")
    left.set(xlabel="million steps", ylabel="worn volume [mm³]")
    right.set(xlabel="million steps", ylabel="wear per step, of k times force times path", ylim=(0.98, 1.3))
    handles = left.get_legend_handles_labels()[0] + right.get_legend_handles_labels()[0][-1:]
    style.legend_above_all(figure, handles)
    return figure


def map_of(axes, facets, rows, name):
    """From above; the quarter and its three mirror images."""
    values = {int(row["node"]): row for row in rows}
    nodes = sorted(values)
    number = {node: k for k, node in enumerate(nodes)}
    triangles = [[number[int(f[i])] for i in corners] for f in facets for corners in ((0, 1, 2), (0, 2, 3))]
    x, y, z = ([values[node][key] for node in nodes] for key in ("X0", "Y0", name))
    levels = numpy.linspace(0, 1.0001 * max(z), 15)
    for i in (-1, 1):
        for j in (-1, 1):
            shown = axes.tricontourf([i * a for a in x], [j * b for b in y], triangles, z, levels=levels,
                                     cmap=style.STRESS_MAP)
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    return shown


def maps(result, contact):
    figure = style.figure(style.DOUBLE, 0.4 * style.DOUBLE)
    panels = figure.subplots(1, 3, sharey=True)
    what = ((0, "pressure", "mean pressure, new cup [MPa]"), (5e6, "pressure", "after 5 million steps [MPa]"),
            (5e6, "wear_depth", "wear depth [mm]"))
    for axes, (time, name, label) in zip(panels, what):
        shown = map_of(axes, facets_of(result), contact(time), name)
        bar = figure.colorbar(shown, ax=axes, orientation="horizontal", label=label)
        bar.locator = MaxNLocator(4)
        bar.update_ticks()
    for axes in panels[1:]:
        axes.set_ylabel("")
    return figure


def worn_in(done):
    """Pressure of the worn-in cup at x = 0 and at y = 0 by that at the pole: 1 and cos(phi)."""
    rows = done.contact(5e6)
    pole = next(row["pressure"] for row in rows if abs(row["X0"]) + abs(row["Y0"]) < 1e-6)
    force = force_times_path()[1]
    print(f"pressure at the pole {pole:.3f} MPa, of a whole hemisphere {4 * force / (math.pi * RADIUS) ** 2:.3f} MPa\n")
    for axis in "XY":
        print(f"along {axis}:", ", ".join(
            f"{math.degrees(math.atan2(row[axis], -row['Z'])):.0f} deg {row['pressure'] / pole:.3f}"
            + (f" (cos {-row['Z'] / math.hypot(row['X'], row['Z']):.3f})" if axis == "X" else "")
            for row in sorted(rows, key=lambda row: row[axis])
            if abs(row["Y0" if axis == "X" else "X0"]) < 1e-6 and row["pressure"] > 0))


def main():
    style.apply()
    path, mean = force_times_path()
    print(f"force times path {path:.1f} N mm per step, mean force {mean:.0f} N\n")
    check_flux()
    meshes = {}
    for factor, label in ((2, "4 elements per block"), (1, "8 elements per block")):
        meshes[label] = done = run(SCENE, f"mesh.factor={factor:g}")
        end = done.history()[-1]
        print(f"{label}: {done.unknowns} unknowns, {done.steps} steps, {done.newton} Newton iterations, "
              f"{done.cpu:.1f} s; {4 * end['worn_volume']:.3f} mm^3, depth "
              f"{max(row['wear_depth'] for row in done.contact()):.4f} mm, flux by force times path "
              f"{volumes(done)[2][0]:.4f} to {volumes(done)[2][-1]:.4f}")
    worn_in(meshes["8 elements per block"])
    compare(SCENE, "cycle.phases", (4, 8, 16, 32), 64, COARSE)
    compare(SCENE, "integrator.rtol", ("1e-1", "1e-2", "1e-3", "1e-4"), "1e-6", COARSE)
    if len(sys.argv) > 1:
        usual = meshes["8 elements per block"]
        maps(usual.result, usual.contact).savefig(pathlib.Path(sys.argv[1]) / "ball_joint_maps.png", dpi=200)
        drawn(meshes).savefig(pathlib.Path(sys.argv[1]) / "ball_joint_volume.png", dpi=200)


if __name__ == "__main__":
    main()
