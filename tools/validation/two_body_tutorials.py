#!/usr/bin/env python3
"""Figures and hand calculations of three tutorials: pin on disc, cam and follower, hip.

python3 two_body_tutorials.py pin|hip RESULT.h5 FOLDER, or cam RESULT.h5 FOLDER SECOND.h5, draws those of results that
were made as the page says."""

import math
import pathlib
import sys
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "plot"))

import h5py
import numpy
from figures import style
from matplotlib.ticker import MaxNLocator
from program import SCENES, bisect, gnomon, rows_of


def history(result):
    return rows_of(gnomon("history", result))


def nodes(result, surface, time):
    """Contact nodes of a surface at a time, in the order of their first coordinate."""
    rows = rows_of(gnomon("contact", result, "--time", time))
    return sorted((row for row in rows if row["surface"] == surface), key=lambda row: row["X0"])


def stored_times(result):
    with h5py.File(result) as file:
        return [float(t) for t in file["gnomon/stored"]["t"]]


def save(figure, folder, name):
    figure.savefig(pathlib.Path(folder) / name, dpi=200)


# A pin with a round end on the track of a disc.

RADIUS, FORCE, SPEED, PATH = 20.0, 100.0, 100.0, 251.3
PIN, DISC = 1e-8, 1e-7


def chord(area):
    """Half width and height of the segment of a circle that has this area."""
    angle = bisect(lambda a: RADIUS**2 * (a - math.sin(a) * math.cos(a)) - area, 0, 1)
    return RADIUS * math.sin(angle), RADIUS * (1 - math.cos(angle))


def pin(result, folder):
    slid = FORCE * SPEED * 2000
    print(f"k F v t: pin {PIN * slid:.6g} mm^2, disc {DISC * slid:.6g} mm^2; depth of the disc "
          f"{1e3 * DISC * slid / PATH:.5f} um, of the pin {chord(PIN * slid)} mm")
    figure = style.figure(style.DOUBLE, 0.38 * style.DOUBLE)
    left, right = figure.subplots(1, 2)
    times = [t for t in (0, 100, 500, 2000) if t in stored_times(result)]
    for time, colour in zip(times, ("black", *style.sequence(3))):
        for surface in ("tip", "track"):
            rows = nodes(result, surface, time)
            left.plot([row["X"] for row in rows], [1e3 * row["Y"] for row in rows], color=colour,
                      linestyle=":" if time == 0 else "-",
                      label=f"{time:g} s" if surface == "tip" else None)
    left.set(xlabel="x [mm]", ylabel="worn surfaces, undeformed [µm]", xlim=(-2.5, 2.5))
    left.set_ylim(-25, 105)
    left.text(-2.4, 60, "pin")
    left.text(-2.4, -19, "disc")
    style.legend(left, columns=4)
    t = numpy.linspace(0, 2000, 201)
    right.plot(t, [1e3 * chord(PIN * FORCE * SPEED * s)[1] for s in t], color=style.COLOURS[0],
               label="pin, rigid: by hand")
    right.plot(t, 1e3 * DISC * FORCE * SPEED * t / PATH, color=style.COLOURS[1],
               label="disc: k F v t / path")
    for surface, colour, marker in (("tip", style.COLOURS[0], "o"), ("track", style.COLOURS[1], "s")):
        depths = [1e3 * max(row["wear_depth"] for row in nodes(result, surface, time))
                  for time in stored_times(result)]
        right.plot(stored_times(result), depths, marker, color=colour,
                   label={"tip": "pin, gnomon", "track": "disc, gnomon"}[surface])
        print(surface, list(zip(stored_times(result), depths)))
    right.set(xlabel="time [s]", ylabel="largest depth of wear [µm]", xlim=(0, 2060), ylim=(0, 90))
    style.legend(right, columns=2)
    save(figure, folder, "pin_on_disc.png")


# An eccentric cam under a flat follower.

DISC_RADIUS, ECCENTRICITY, LOAD = 10.0, 3.0, 50.0
CAM, FOLLOWER = 1e-9, 2e-9


def cam_depth(angle):
    """In a turn, at an angle from the direction of the eccentricity [mm]."""
    return CAM * LOAD * (1 + ECCENTRICITY / DISC_RADIUS * math.cos(angle))


def follower_depth(x):
    """In a turn [mm], where the contact passes."""
    return FOLLOWER * LOAD * 2 * DISC_RADIUS / math.sqrt(ECCENTRICITY**2 - x**2)


def outline(result, time):
    """The nodes of the cam's outline by their angle from the direction of the eccentricity."""
    rows = nodes(result, "outline", time)
    for row in rows:
        row["angle"] = math.atan2(row["X0"], row["Y0"] - ECCENTRICITY)
    return sorted(rows, key=lambda row: row["angle"])


def magnified(axes, rows, factor):
    """The outline, closed, with its wear made larger; dotted: as it was."""
    rows = [*rows, rows[0]]
    for scale, look in ((0, {"linestyle": ":", "color": "black"}), (factor, {"color": style.COLOURS[0]})):
        axes.plot(*([row[k + "0"] + scale * (row[k] - row[k + "0"]) for row in rows] for k in "XY"), **look)
    axes.plot(0, 0, "+", color="black")
    for place, text in (((0.6, -1.8), "axis"), ((-0.4, 10), "0"), ((5, 2.6), "90"), ((-8, 2.6), "−90")):
        axes.text(*place, text)
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]", title=f"cam, wear drawn {factor:,d} times")


def numbers_of(result, name):
    """Against the hand calculation."""
    end = history(result)[-1]
    turns, path = end["t"] / 0.1, 2 * math.pi * DISC_RADIUS
    for body, k in (("cam", CAM), ("follower", FOLLOWER)):
        volume = k * LOAD * path * turns
        print(f"{name}: {body} k F 2 pi R n {volume:.6g} mm^2, gnomon "
              f"{100 * (end['worn_volume_' + body] / volume - 1):+.3f} %")
    ratios = [row["wear_depth"] / (turns * cam_depth(row["angle"])) for row in outline(result, end["t"])]
    face = nodes(result, "face", end["t"])
    inner = [row["wear_depth"] / (turns * follower_depth(row["X0"])) for row in face if abs(row["X0"]) < 2.1]
    print(f"{name}: depth by that by hand: cam {min(ratios):.3f} to {max(ratios):.3f}, follower to 2.1 mm "
          f"{min(inner):.3f} to {max(inner):.3f}, largest {1e3 * max(row['wear_depth'] for row in face):.2f} um")
    return end["t"], turns


def cam(result, folder, second):
    """Of two runs, with one phase for each facet of the cam and with two."""
    figure = style.figure(style.DOUBLE, 0.38 * style.DOUBLE)
    left, middle, right = figure.subplots(1, 3)
    for one, name, colour, marker in ((second, "192 phases", style.COLOURS[4], "s"),
                                      (result, "96 phases", style.COLOURS[0], "o")):
        end, turns = numbers_of(one, name)
        look = {"color": colour, "marker": marker, "markersize": 2, "label": name}
        rows, face = outline(one, end), nodes(one, "face", end)
        middle.plot([math.degrees(row["angle"]) for row in rows], [1e3 * row["wear_depth"] for row in rows],
                    linestyle="", **look)
        right.plot([row["X0"] for row in face], [1e3 * row["wear_depth"] for row in face], linewidth=0.6, **look)
    magnified(left, outline(result, end), 1000)
    degrees, x = numpy.linspace(-180, 180, 361), numpy.linspace(-2.99, 2.99, 400)
    by_hand = {"color": style.COLOURS[1], "label": "by hand", "zorder": 3, "linewidth": 0.9}
    middle.plot(degrees, [1e3 * turns * cam_depth(math.radians(a)) for a in degrees], **by_hand)
    right.plot(x, [1e3 * turns * follower_depth(a) for a in x], **by_hand)
    middle.set(xlabel="angle on the cam [degrees]", ylabel="depth of wear of the cam [µm]", xlim=(-180, 180),
               xticks=(-180, -90, 0, 90, 180), ylim=(0, 0.8))
    right.set(xlabel="x on the follower [mm]", ylabel="depth of wear of the follower [µm]", xlim=(-6, 6), ylim=(0, 25))
    style.legend_above_all(figure, middle.get_legend_handles_labels()[0])
    save(figure, folder, "cam_and_follower.png")


# Half of a hip joint under walking.

HIP = SCENES / "hip.toml"
HEAD, CUP = 14.0, 1e-9


def force_times_path():
    """Of a step of the whole joint, on the radius of the head [N mm], and the mean force [N]."""
    tables = tomllib.loads(HIP.read_text())["tables"]
    force, angle = tables["walking"]["y"], [math.radians(a) for a in tables["flexion"]["y"]]
    pairs = list(zip(force, force[1:], angle, angle[1:]))
    return (HEAD * sum((f + g) / 2 * abs(b - a) for f, g, a, b in pairs),
            sum((f + g) / 2 for f, g, _, _ in pairs) / len(pairs))


def part(result, name):
    """The facets of a part, four nodes each."""
    with h5py.File(result) as file:
        names = [n.decode() for n in file["mesh/parts"].attrs["names"]]
        return file[f"mesh/parts/{names.index(name)}"][:].reshape(-1, 4)


def map_of(axes, result, surface, time, name, scale=1.0):
    """Seen along z, with the mirror image of the half."""
    rows = {int(row["node"]): row for row in nodes(result, surface, time)}
    number = {node: k for k, node in enumerate(rows)}
    triangles = [[number[int(f[i])] for i in corners] for f in part(result, surface)
                 for corners in ((0, 1, 2), (0, 2, 3))]
    x, y, z = (numpy.array([row[key] for row in rows.values()]) for key in ("X0", "Y0", name))
    levels = numpy.linspace(0, 1.0001 * scale * max(z), 15)
    for side in (-1, 1):
        shown = axes.tricontourf(x, side * y, triangles, scale * z, levels=levels, cmap=style.STRESS_MAP)
    axes.set(aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    return shown


def hip(result, folder):
    rows, (path, mean) = history(result), force_times_path()
    end = rows[-1]
    print(f"force times path {path:.1f} N mm a step, k times it {CUP * path:.5g} mm^3; mean force {mean:.1f} N")
    for row in (rows[0], end):
        print(f"{row['t']:g} steps: whole cup {2 * row['worn_volume_cup']:.3f} mm^3, per step "
              f"{2 * row['wear_flux_cup'] / (CUP * path):.4f} of k times force times path")
    print(f"by hand {CUP * path * end['t']:.2f} to {4 / math.pi * CUP * path * end['t']:.2f} mm^3")
    figure = style.figure(style.DOUBLE, 0.42 * style.DOUBLE)
    panels = figure.subplots(1, 3)
    for axes, (surface, name, scale, label) in zip(panels, (
            ("bearing", "wear_depth", 1, "depth of wear of the cup [mm]"),
            ("ball", "wear_depth", 1e3, "depth of wear of the head [µm]"),
            ("bearing", "pressure", 1, "mean pressure on the cup [MPa]"))):
        shown = map_of(axes, result, surface, end["t"], name, scale)
        bar = figure.colorbar(shown, ax=axes, orientation="horizontal", label=label)
        bar.locator = MaxNLocator(4)
        bar.update_ticks()
        most = max(nodes(result, surface, end["t"]), key=lambda row: row[name])
        print(f"{label}: largest {scale * most[name]:.4g} at ({most['X0']:.2f}, {most['Y0']:.2f}, {most['Z0']:.2f})")
    for axes in panels[1:]:
        axes.set_ylabel("")
    save(figure, folder, "hip_maps.png")


if __name__ == "__main__":
    style.apply()
    {"pin": pin, "cam": cam, "hip": hip}[sys.argv[1]](*sys.argv[2:])
