"""Cycles: the fretting test of McColl, Ding and Leen, in gross sliding."""

from figures import style
from program import SCENES, percent, run

from gallery.entry import Drawn, Entry, column, panels

PATH = 4 * 0.025  # mm per cycle
FORCE = 18.5  # N/mm
COEFFICIENT = 2.9e-8  # 1/MPa, of the flat
OTHER = 1.9e-8  # of the cylinder
# Of two published models in which both wear: depth of the flat at x = 0 [um] and its worn area against k P 4 A N [%],
# level set and mesh motion (Llavori's LevelSetWear).
PUBLISHED = {1000: (0.3784, 0.3727, -3.0, -3.6), 5000: (1.1311, 1.1249, -2.9, -3.1),
             10000: (1.8146, 1.8079, -2.9, -2.7), 18000: (2.7130, 2.7055, -2.9, -3.0)}


def deepest(nodes):
    """In um."""
    return 1e3 * max(node["wear_depth"] for node in nodes)


def fretting(_full):
    done = run(SCENES / "cylinder_on_flat.toml")
    both = run(SCENES / "cylinder_on_flat.toml", f"wear.coefficient={COEFFICIENT + OTHER}")
    figure, (left, right) = panels(2, 0.38)
    rows = []
    for cycles, colour in zip(PUBLISHED, style.sequence(len(PUBLISHED))):
        nodes = done.contact(cycles)
        left.plot(column(nodes, "X0"), [1e3 * (node["Y"] - node["Y0"]) for node in nodes], color=colour,
                  label=f"{cycles} cycles")
        depth = deepest(nodes)
        shared = deepest(both.contact(cycles)) * COEFFICIENT / (COEFFICIENT + OTHER)
        area = done.at(cycles)["worn_volume"] / (COEFFICIENT * FORCE * PATH * cycles)
        level_set, mesh_motion, *areas = PUBLISHED[cycles]
        rows.append([cycles, f"{depth:.4f}", percent(area, 5), f"{shared:.4f}", f"{level_set:.4f} / {mesh_motion:.4f}",
                     " / ".join(f"{value:+.1f} %" for value in areas)])
    left.set(xlabel="x [mm]", ylabel="worn surface [um]", xlim=(-0.27, 0.27))
    history = [row for row in done.history() if row["t"] > 0]
    right.plot(column(history, "t"), column(history, "step"), "o-", color=style.COLOURS[0], label="gnomon, accepted")
    right.axhline(100, color=style.GREY, label="published models, by hand")
    right.set(xlabel="cycles", ylabel="jump [cycles]", yscale="log")
    style.legend(left, columns=2)
    style.legend(right)
    return Drawn([figure], ["Worn flat, and accepted jumps over cycles"],
                 ["cycles", "depth, the flat alone wears [um]", "area against k P 4 A N",
                  "its part of the sum [um]", "published depth, both wear [um]", "published area"], rows,
                 f"{done.steps} steps with {done.newton} Newton iterations, each for "
                 "16 phases, where the published models take 180 fixed jumps with 40 increments each. gnomon has one "
                 "wearing body: a flat that wears alone is deeper and narrower, at the same worn area. Where the flat "
                 "wears by the sum of both coefficients, its part of the depth is 4 to 6 % above that of the flat beside a "
                 "cylinder that wears; 2 % of it are the 3 % of the area that the published models lose, probably by "
                 "elastic slip. At stored times two short jumps settle the pressures. [More methods and tolerances, and the wear of "
                 "the cylinder alone](cycles.md#reciprocating-cylinder-on-a-flat).")


ENTRIES = [
    Entry("fretting", "Fretting in gross sliding, 18,000 cycles", """
A cylinder slides to and fro on a flat (McColl, Ding, Leen, Wear 256, 2004; 18.5 N/mm, amplitude 25 um). The tolerance
chooses the jumps over [cycles](cycles.md).""", fretting),
]
