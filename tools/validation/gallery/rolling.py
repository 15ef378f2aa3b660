"""Two bodies that roll on each other in space, beside a half-space program."""

import wheel_on_rail
from program import SCENES, percent, run

from gallery.entry import Drawn, Entry


def wheel(_full):
    done = run(SCENES / "wheel_on_rail.toml", "output.times=[3e4, 6e4]")
    y, profiles, states = wheel_on_rail.worn(0.3, 30, [wheel_on_rail.CREEPAGE, 0])
    rows = []
    for t, pressure, _, _, power, _, _, on_rail, on_wheel, *volumes in states:
        found, contact = done.at(t), done.contact(t)
        row = [f"{t:,.0f}", f"{found['max_pressure']:.1f}", percent(found["max_pressure"] / pressure, 1),
               f"{found['friction_power']:,.0f}", percent(found["friction_power"] / power, 1)]
        if t:
            for surface, depth in (("head", on_rail), ("tread", on_wheel)):
                own = 1e3 * max(node["wear_depth"] for node in contact if node["surface"] == surface)
                row += [f"{own:.2f}", percent(own / depth, 1)]
            row += [f"{found['worn_volume']:.1f}", percent(found["worn_volume"] / sum(volumes), 1)]
        rows.append(row + [""] * (11 - len(row)))
    return Drawn([wheel_on_rail.figure(done.contact, y, profiles)], ["Depths of wear and pressure across the rail"],
                 ["t [s]", "largest pressure [MPa]", "difference", "power of friction [N mm/s]", "difference",
                  "depth of the rail [um]", "difference", "of the wheel [um]", "difference",
                  "worn volume of both [mm^3]", "difference"], rows,
                 f"{done.steps} steps, {done.cpu:.0f} s of processor time. Differences upwind take power on this coarse "
                 "mesh, and with it wear. [Tutorial](tutorials/wheel_on_rail.md), with other meshes.")


ENTRIES = [
    Entry("wheel-on-rail", "Wheel on rail, in space", """
A wheel drives on a rail with a creepage of 0.001; both deform, and both wear. Left: depths of wear, dots of the wheel
and squares of the rail by gnomon, lines by a program of two half-spaces. Right: gnomon's pressures. At the end depths
and volume are 4 to 7 % too small on this mesh.""", wheel),
]
