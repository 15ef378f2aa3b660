#!/usr/bin/env python3
"""Worn ring of half-round section: volume, and width and depth against the chord of a circle
(docs/notes/validation.md).

The chord is parallel to the flat and symmetric about the mean radius, so that by Pappus the worn
volume is its segment times 2 pi mean. With elasticity the flat is pressed by P = F/(2 pi mean)
per length, and the section bends under the uniform pressure P/(2a) like a half-plane: segment(a)
- 2 a q = area, depth = height(a) - 2 ln 2 q, q = P (1 - nu^2)/(pi E)."""

import math

from program import SCENES, bisect, percent, run, table

RADIUS, MEAN, FORCE = 30.0, 100.0, 150796320.0
VOLUME = 1e-12 * 2 * math.pi * 1e5 * 100 * 2.995 * FORCE


def chord(young):
    q = FORCE / (2 * math.pi * MEAN) * (1 - 0.3**2) / (math.pi * young)
    area = VOLUME / (2 * math.pi * MEAN)

    def excess(angle):
        segment = RADIUS**2 * (angle - math.sin(angle) * math.cos(angle))
        return segment - 2 * RADIUS * math.sin(angle) * q - area
    angle = bisect(excess, 0.3, 1.0)
    return RADIUS * math.sin(angle), RADIUS * (1 - math.cos(angle)) - 2 * math.log(2) * q


def main():
    rows = []
    for young in (130e3, 130e4, 130e5):
        half_width, depth = chord(young)
        for factor in (2, 1, 0.5):
            done = run(SCENES / "half_round_ring.toml", f"mesh.factor={factor}",
                       f"body.young_modulus={young:g}")
            end, nodes = done.history()[-1], done.contact()
            middle = min(nodes, key=lambda node: abs(node["X0"] - MEAN))
            width = end["contact_half_width"]
            rows.append([f"{young:g}", factor, done.unknowns,
                         percent(end["worn_volume"] / VOLUME, 4), f"{width:.3f}",
                         percent(width / half_width), f"{middle['wear_depth']:.4f}",
                         percent(middle["wear_depth"] / depth), f"{end['element_quality']:.2f}",
                         done.steps, f"{done.cpu:.1f}"])
    table(["E [MPa]", "`mesh.factor`", "unknowns", "volume against k F s", "half width [mm]",
           "of the chord", "depth [mm]", "of the chord's", "least quality", "steps", "CPU [s]"],
          rows)


if __name__ == "__main__":
    main()
