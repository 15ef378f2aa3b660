#!/usr/bin/env python3
"""Published tests with two deformable bodies: block on ring, fretting, a ring of half-round
section, a sphere on a disc (docs/notes/validation.md). Words of the command choose some of them."""

import csv
import math
import sys

import block_on_ring
import half_plane
import half_round_ring
import pin_on_disc
from program import SCENES, bisect, percent, run, table

COST = ["steps", "Newton iterations", "CPU [s]"]


def cost(done):
    return [done.steps, done.newton, f"{done.cpu:.1f}"]


def ring():
    """Elastic steel, with the closed form of the rigid ring on one body of the combined modulus;
    the ring turns, so that a^2/(10 R^2) more than k P s wears, from which depths are counted. A
    stiff ring on the same block has the closed form of the block's modulus."""
    rows = []
    combined = block_on_ring.COMPLIANCE
    for young, factors in ((210e3, (2, 1, 0.5)), (210e6, (1,))):
        q = combined / 2 * (1 + 210e3 / young)
        for factor in factors:
            done = run(SCENES / "block_on_elastic_ring.toml", f"mesh.factor={factor}",
                       f"body.2.young_modulus={young:g}")
            for time in block_on_ring.TIMES:
                area = block_on_ring.worn_area(time)
                a = block_on_ring.closed_form(area, q)[0]
                longer = 1 + a**2 / (10 * block_on_ring.RADIUS**2)
                a, depth = block_on_ring.closed_form(area * longer, q)
                at = done.at(time)
                found = max(n["wear_depth"] for n in done.contact(time))
                rows.append([f"{young:g}", factor, f"{time / 2:.0f}",
                             percent(at["worn_volume"] / area, 4), percent(longer, 4),
                             f"{1e3 * found:.3f}", percent(found / depth, 3),
                             percent(at["contact_half_width"] / a), *cost(done)])
    table(["E of the ring [MPa]", "`mesh.factor`", "s [m]", "area against k P s", "expected",
           "depth [um]", "of the closed form", "half width", *COST], rows)


def fretting():
    """k P 4 A N of either body, depths of two half-planes, and the published profiles of the
    flat."""
    load, amplitude = 18.5, 0.025
    times = (1000, 5000, 10000, 18000)
    depths = half_plane.fretting(times, radius=6.0, load=load, amplitude=amplitude,
                                 wear=(2.9e-8, 1.9e-8), modulus=100e3 / (1 - 0.3**2), step=10)
    rows, profiles = [], []
    for factor, phases in ((1, 4), (1, 8), (0.5, 8)):
        done = run(SCENES / "cylinder_and_flat.toml", f"mesh.factor={factor}",
                   f"cycle.phases={phases}", "output.budget=false")
        for cycles, expected in zip(times, depths):
            at, nodes = done.at(cycles), done.contact(cycles)
            per_k = load * 4 * amplitude * cycles
            flat = [(n["X"], 1e3 * n["Y"]) for n in nodes if n["surface"] == "face"]
            middle = 1e3 * max(n["wear_depth"] for n in nodes if n["surface"] == "round")
            rows.append([factor, phases, cycles,
                         percent(at["worn_volume_flat"] / (2.9e-8 * per_k), 4),
                         percent(at["worn_volume_cylinder"] / (1.9e-8 * per_k), 4),
                         f"{-interpolated(flat, 0):.4f}",
                         percent(-1e-3 * interpolated(flat, 0) / expected[0]), f"{middle:.4f}",
                         percent(1e-3 * middle / expected[1]), *cost(done)])
            for name in ("level_set", "mesh_motion"):
                profiles.append([factor, phases, cycles, name.replace("_", " "),
                                 *compared(flat, published(name, cycles), 2.9e-8 * per_k)])
    table(["`mesh.factor`", "phases", "cycles", "area of the flat against k P 4 A N",
           "of the cylinder", "depth of the flat [um]", "of the half-planes'",
           "of the cylinder [um]", "of the half-planes'", *COST], rows)
    table(["`mesh.factor`", "phases", "cycles", "published by", "its area against k P 4 A N",
           "its depth [um]", "gnomon's", "root mean square [um]", "largest [um]",
           "root mean square, of equal areas", "largest"], profiles)


def published(name, cycles):
    with open(SCENES / "mccoll" / f"{name}_mccoll.csv") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        return [(float(r["x_mm"]), float(r["y_um"])) for r in rows if float(r["cycles"]) == cycles]


def interpolated(points, x):
    """Straight between points in the order of x, 0 beyond."""
    for (a, f), (b, g) in zip(points, points[1:]):
        if a <= x <= b:
            return f + (g - f) * (x - a) / (b - a)
    return 0.0


def area_of(points):
    """mm^2, above points in um."""
    return -1e-3 * sum((b[0] - a[0]) * (a[1] + b[1]) / 2 for a, b in zip(points, points[1:]))


def compared(flat, other, area):
    """Differences of the published nodes, as they are, and made as large in area as exact."""
    share = area_of(other) / area
    result = [percent(share), f"{-min(y for _, y in other):.4f}", f"{-interpolated(flat, 0):.4f}"]
    for scale in (1, 1 / share):
        off = [interpolated(flat, x) - y * scale for x, y in other]
        result += [f"{math.sqrt(sum(d * d for d in off) / len(off)):.4f}",
                   f"{max(map(abs, off)):.4f}"]
    return result


def half_round():
    """Copper on steel, also twice as stiff, against the rigid plane."""
    mean, force = half_round_ring.MEAN, half_round_ring.FORCE
    rows = []

    def add(name, done, width=None, depth=None):
        end = done.history()[-1]
        nodes = [n for n in done.contact() if n["Y0"] > 0 or n["wear_depth"] > 0]
        middle = min(nodes, key=lambda n: (abs(n["X0"] - mean), -n["wear_depth"]))["wear_depth"]
        more = []
        for found, rigid in ((end["contact_half_width"], width), (middle, depth)):
            more += [f"{found:.4f}", percent(found / rigid, 3) if rigid else ""]
        rows.append([name, percent(end["worn_volume"] / half_round_ring.VOLUME, 4), *more,
                     f"{end['element_quality']:.2f}", *cost(done)])
        return end["contact_half_width"], middle

    for factor in (1, 0.5):
        rigid = run(SCENES / "half_round_ring.toml", f"mesh.factor={factor}",
                    "body.material=\"linear\"")
        base = add(f"rigid, {factor}", rigid)
        youngs = (210e3, 420e3) if factor == 1 else (210e3,)
        for young in youngs:
            done = run(SCENES / "half_round_ring_on_steel.toml", f"mesh.factor={factor}",
                       f"body.2.young_modulus={young:g}")
            add(f"{young:g}, {factor}", done, *base)
    table(["E of the steel [MPa], `mesh.factor`", "volume against k F s", "half width [mm]",
           "of the rigid plane's", "depth [mm]", "of the rigid plane's", "least quality", *COST],
          rows)


def sphere():
    """The sphere alone wears: rings on a half-space. Both wear alike: as the sphere alone after
    twice the distance, half of the depth each."""
    rings = dict(zip(pin_on_disc.TIMES, pin_on_disc.second_solution()))
    wear, force = pin_on_disc.WEAR, pin_on_disc.FORCE
    for factor in (2, 1, 0.5):
        rows = []
        for both in (False, True):
            on = '["surface", "face"]' if both else '["surface"]'
            times = [t for t in pin_on_disc.TIMES[1:] if not both or 2 * t in rings]
            done = run(SCENES / "sphere_on_disc.toml", f"mesh.factor={factor}", f"wear.on={on}",
                       f"output.times={times}", f"time.end={times[-1]}")
            for time in times:
                alone = time * (2 if both else 1)
                radius, depth = rings[alone]
                at, nodes = done.at(time), done.contact(time)
                depths = sorted((n["wear_depth"] for n in nodes if n["X0"] < 1e-9), reverse=True)
                volume = wear * force * time
                rows.append(["both" if both else "sphere", f"{time:.0f}",
                             percent(at["worn_volume_pin"] / volume, 5),
                             percent(at["worn_volume_disc"] / volume, 5) if both else "0",
                             f"{at['contact_half_width']:.5f}",
                             percent(at["contact_half_width"] / radius),
                             percent(at["contact_half_width"] / pin_on_disc.asymptotic(alone)),
                             *[f"{1e3 * d:.5f}" for d in depths],
                             percent(sum(depths) / depth), *cost(done)])
        print(f"mesh.factor={factor}: {done.unknowns} unknowns")
        table(["worn", "s [mm]", "volume of the sphere against k F s", "of the disc",
               "radius of contact [mm]", "of the rings'", "of Argatov's",
               "depth of the sphere [um]", "of the disc", "sum, of the rings'", *COST], rows)


CASES = {"ring": ring, "fretting": fretting, "half-round": half_round, "sphere": sphere}

if __name__ == "__main__":
    for name in sys.argv[1:] or CASES:
        CASES[name]()
