#!/usr/bin/env python3
"""Pin on disc (Argatov 2011) as a body of revolution, against three solutions
(docs/notes/validation.md)."""

import math

import half_space
from program import SCENES, percent, run, table

RADIUS, FORCE, WEAR, MODULUS = 50.0, 10.39, 1.33e-7, 105e3 / (1 - 0.3**2)
TIMES = (0.0, 20.0, 40.0, 80.0, 160.0, 320.0, 640.0)


def asymptotic(time):
    """a^4 = a0^4 + 4 k F s R / pi."""
    a0 = (3 * FORCE * RADIUS / (4 * MODULUS)) ** (1 / 3)
    return (a0**4 + 4 * WEAR * FORCE * time * RADIUS / math.pi) ** 0.25


def uniform(time):
    """Worn half-space that bends under the uniform pressure F/(pi a^2) on the contact: the
    volume of the cap, pi a^4/(4 R) = k F s + (4/3) F a / (pi E'). For contacts that have
    grown well beyond that at the start."""
    a = asymptotic(time)
    for _ in range(200):
        volume = WEAR * FORCE * time + 4 * FORCE * a / (3 * math.pi * MODULUS)
        a = (4 * RADIUS / math.pi * volume) ** 0.25
    return a


def second_solution():
    """Rings on a half-space; extrapolated in the step."""
    settings = dict(radius=RADIUS, force=FORCE, wear=WEAR, modulus=MODULUS, extent=0.55)
    coarse, fine = (half_space.worn_ball(list(TIMES), steps=n, **settings) for n in (400, 800))
    return [tuple(2 * b - a for a, b in zip(*pair)) for pair in zip(coarse, fine)]


def main():
    rings = second_solution()
    for factor in (2, 1, 0.5):
        done = run(SCENES / "pin_on_disc_axisymmetric.toml", f"mesh.factor={factor}")
        print(f"mesh.factor={factor}: {done.unknowns} unknowns, {done.steps} steps, "
              f"{done.newton} Newton iterations, {done.cpu:.1f} s")
        rows = []
        for time, (a, depth) in zip(TIMES, rings):
            at, centre = done.at(time), done.contact(time)[0]["Y"]
            found = at["contact_half_width"]
            row = [f"{time:.0f}", f"{found:.5f}", percent(found / a),
                   percent(found / asymptotic(time))]
            if time:
                row += [percent(found / uniform(time)), percent(centre / depth),
                        percent(at["worn_volume"] / (WEAR * FORCE * time), 7)]
            rows.append(row + [""] * (7 - len(row)))
        table(["s [mm]", "radius of contact [mm]", "of the rings' on a half-space",
               "of Argatov's", "of the one with uniform pressure", "depth of the rings'",
               "volume against k F s"], rows)


if __name__ == "__main__":
    main()
