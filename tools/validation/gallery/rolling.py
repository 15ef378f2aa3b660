"""Two bodies that roll on each other in space, beside a half-space program."""

import wheel_on_rail
from program import SCENES, percent, run

from gallery.entry import Drawn, Entry


def wheel(_full):
    done = run(SCENES / "wheel_on_rail.toml", "output.times=[1e5, 2e5]")
    y, profiles, states = wheel_on_rail.worn(0.3, 30, [wheel_on_rail.CREEPAGE, 0])
    rows = []
    for t, pressure, _, _, power, _, _, depth, volume in states:
        found = done.at(t)
        row = [f"{t:,.0f}", f"{found['max_pressure']:.1f}", percent(found["max_pressure"] / pressure, 1),
               f"{found['friction_power']:,.0f}", percent(found["friction_power"] / power, 1)]
        if t:
            row += [f"{1e3 * found['wear_depth']:.2f}", percent(1e3 * found["wear_depth"] / depth, 1),
                    f"{found['worn_volume']:.1f}", percent(found["worn_volume"] / volume, 1)]
        rows.append(row + [""] * (9 - len(row)))
    return Drawn([wheel_on_rail.figure(done.contact, y, profiles)], ["Depth of wear and pressure across the rail"],
                 ["t [s]", "largest pressure [MPa]", "difference", "power of friction [N mm/s]", "difference",
                  "depth [um]", "difference", "worn volume [mm^3]", "difference"], rows,
                 f"{done.steps} steps, {done.cpu:.0f} s of processor time. Differences upwind take power on this coarse "
                 "mesh, and with it wear. [Tutorial](tutorials/wheel_on_rail.md), with other meshes.")


ENTRIES = [
    Entry("wheel-on-rail", "Wheel on rail, in space", """
A wheel drives on a rail with a creepage of 0.001, and the head of the rail wears; both deform. Left: depths of wear,
dots by gnomon, lines by a program of uniform tractions on squares of two half-spaces, which freezes the profile for
a thirtieth of the time. Right: gnomon's pressures. Depth and volume are too small by 4 to 6 % on this mesh.""", wheel),
]
