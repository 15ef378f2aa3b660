#!/usr/bin/env python3
"""Block on ring (Cruzado et al. 2010) against the rigid limit with its elastic correction
(docs/notes/validation.md)."""

import math
import pathlib
import tempfile

from program import SCENES, bisect, percent, run, table

FORCE, WEAR, RADIUS, SPEED = 10.8333, 2e-9, 20.0, 500.0
COMPLIANCE = FORCE * (1 - 0.3**2) / (math.pi * 105e3)  # mm, P (1 - nu^2)/(pi E)
TIMES = (1600, 3200, 4800, 7200)


def worn_area(time):
    return WEAR * FORCE * SPEED * time


def parabola(area):
    """Half width and depth of the rigid limit as published: a^3 = 1.5 R area, a^2/(2 R)."""
    a = (1.5 * RADIUS * area) ** (1 / 3)
    return a, a * a / (2 * RADIUS)


def closed_form(area, compliance=COMPLIANCE):
    """Half width and depth where the ring is a circle and the block a half-plane that bends
    under the uniform pressure P/(2a): segment(a) - 2 a q = area, depth = height(a) - 2 ln 2
    q."""
    def excess(angle):
        segment = RADIUS**2 * (angle - math.sin(angle) * math.cos(angle))
        return segment - 2 * RADIUS * math.sin(angle) * compliance - area
    angle = bisect(excess, 0, 1)
    return RADIUS * math.sin(angle), RADIUS * (1 - math.cos(angle)) - 2 * math.log(2) * compliance


def deepest(nodes):
    return max(-node["Y"] for node in nodes)


def structured(scale):
    """Rectangles: equal ones under the contact, growing ones around it."""
    n, m = round(80 / scale), max(2, round(12 / scale**0.5))
    return f"""
half = 1.6; width = 4; depth = 4; zone = 1.6;
x[] = {{-width, -half, half, width}}; y[] = {{-depth, -zone, 0}};
For j In {{0:2}}
  For i In {{0:3}}
    Point(1 + i + 4 * j) = {{x[i], y[j], 0}};
  EndFor
EndFor
For j In {{0:2}}
  For i In {{0:2}}
    Line(1 + i + 3 * j) = {{1 + i + 4 * j, 2 + i + 4 * j}};
  EndFor
  Transfinite Curve {{1 + 3 * j}} = {m + 1} Using Progression 1 / 1.2;
  Transfinite Curve {{2 + 3 * j}} = {n + 1};
  Transfinite Curve {{3 + 3 * j}} = {m + 1} Using Progression 1.2;
EndFor
For j In {{0:1}}
  For i In {{0:3}}
    Line(10 + i + 4 * j) = {{1 + i + 4 * j, 5 + i + 4 * j}};
    If (j == 0)
      Transfinite Curve {{10 + i}} = {m // 2 + 1} Using Progression 1 / 1.2;
    Else
      Transfinite Curve {{14 + i}} = {round(n / 4) + 1} Using Progression 1 / 1.1;
    EndIf
  EndFor
EndFor
For j In {{0:1}}
  For i In {{0:2}}
    below = 1 + i + 3 * j; left = 10 + i + 4 * j;
    Curve Loop(below) = {{below, left + 1, -(below + 3), -left}};
    Plane Surface(1 + i + 3 * j) = {{1 + i + 3 * j}};
    Transfinite Surface {{1 + i + 3 * j}};
    Recombine Surface {{1 + i + 3 * j}};
  EndFor
EndFor
Physical Curve("bottom") = {{1, 2, 3}};
Physical Curve("surface") = {{8}};
Physical Surface("block") = {{1, 2, 3, 4, 5, 6}};
"""


def row(name, done, time):
    area = worn_area(time)
    a, depth = closed_form(area)
    rigid = parabola(area)[1]
    at = done.at(time)
    found = deepest(done.contact(time))
    return [name, f"{time / 2:.0f}", percent(at["worn_volume"] / area, 5), f"{1e3 * found:.3f}",
            percent(found / rigid, 3), percent(found / depth, 3),
            percent(at["contact_half_width"] / a)]


HEAD = ["s [m]", "area against k P s", "depth [um]", "of the rigid limit",
        "with its elastic correction", "half width"]


def distances():
    """The shipped scene, and the ring that turns."""
    scene = SCENES / "block_on_ring.toml"
    turning = ["counter_body.motion.velocity=[0.0, 0.0]", "counter_body.motion.rotation=25.0"]
    for name, settings in (("sliding", []), ("turning", turning)):
        done = run(scene, *settings)
        print(f"{name}: {done.steps} steps, {done.cpu:.1f} s")
        table(HEAD, [row(name, done, time)[1:] for time in TIMES])
        if name == "turning":
            for time in TIMES:
                a = closed_form(worn_area(time))[0]
                print(f"expected: {percent(1 + a**2 / (10 * RADIUS**2), 5)}")


def meshes():
    """Rows of quadrilaterals of three kinds, coarse to fine, at 3600 m."""
    scene, rows = SCENES / "block_on_ring.toml", []
    triangles = (SCENES / "block_on_ring_triangles.geo").read_text()
    with tempfile.TemporaryDirectory() as folder:
        for scale in (2, 1, 0.5):
            files = {"structured": structured(scale), "triangles": f"scale = {scale};\n{triangles}"}
            for name in ("structured", "quadrilaterals", "triangles"):
                settings = [f"mesh.factor={scale}"]
                if name in files:
                    file = pathlib.Path(folder) / f"{name}{scale}.geo"
                    file.write_text(files[name])
                    settings = [f'mesh.file="{file}"']
                done = run(scene, *settings)
                cost = [done.steps, done.newton, f"{done.cpu:.1f}"]
                rows.append([f"{0.04 * scale:g}", name, done.unknowns,
                             *row(name, done, 7200)[2:], *cost])
    cost = ["steps", "Newton iterations", "CPU [s]"]
    table(["facet [mm]", "mesh", "unknowns", *HEAD[1:], *cost], rows)


if __name__ == "__main__":
    distances()
    meshes()
