"""Published tests: block on ring, pin on disc, ring of half-round section."""

import block_on_ring
import block_on_ring_figure
import half_round_ring
import numpy
import pin_on_disc
from figures import style
from program import SCENES, percent, run

from gallery.entry import Drawn, Entry, column, panels


def ring(_full):
    done = run(SCENES / "block_on_ring.toml")
    end = done.contact(block_on_ring_figure.END)
    rows = [block_on_ring.row("", done, time)[1:] for time in block_on_ring.TIMES]
    return Drawn([block_on_ring_figure.drawn(end)], ["Worn block, measured and computed"], block_on_ring.HEAD, rows,
                 f"{done.steps} steps, {done.cpu:.1f} s of processor time. Of the area, the two published "
                 f"programs lose "
                 "1.25 % (mesh motion, 45,000 increments) and gain 0.74 % (level set). "
                 "[Details](validation.md#block-on-ring), [tutorial](tutorials/block_on_ring.md).")


def disc(_full):
    done = run(SCENES / "pin_on_disc_axisymmetric.toml")
    rings = pin_on_disc.second_solution()
    figure, (left, right) = panels(2, 0.38)
    s = numpy.linspace(1, 640, 301)
    history = [row for row in done.history() if row["t"] > 0]
    def difference(a, time):
        return 100 * (a / pin_on_disc.asymptotic(time) - 1)
    for axes, scaled in ((left, lambda a, _: a), (right, difference)):
        axes.plot(s, [scaled(pin_on_disc.asymptotic(x), x) for x in s], color=style.GREY, label="Argatov (2011)")
        axes.plot(s, [scaled(pin_on_disc.uniform(x), x) for x in s], color=style.COLOURS[1], label="uniform pressure")
        axes.plot(pin_on_disc.TIMES[1:], [scaled(a, x) for x, (a, _) in list(zip(pin_on_disc.TIMES, rings))[1:]], "s",
                  color=style.COLOURS[2], label="rings on a half-space")
        axes.plot(column(history, "t"), [scaled(row["contact_half_width"], row["t"]) for row in history], "o",
                  markersize=2.5, color=style.COLOURS[0], label="gnomon")
        axes.set(xlabel="sliding distance [mm]")
    left.set_ylabel("radius of contact [mm]")
    right.set(ylabel="radius, difference from Argatov's [%]", ylim=(-1, 4))
    style.legend_above_all(figure, left.get_legend_handles_labels()[0])
    rows = []
    for time, (a, depth) in zip(pin_on_disc.TIMES, rings):
        found = done.at(time)["contact_half_width"]
        row = [f"{time:.0f}", f"{found:.4f}", percent(found / a), percent(found / pin_on_disc.asymptotic(time))]
        if time:
            worn = done.at(time)["worn_volume"] / (pin_on_disc.WEAR * pin_on_disc.FORCE * time)
            row += [percent(found / pin_on_disc.uniform(time)), percent(done.contact(time)[0]["Y"] / depth),
                    percent(worn, 5)]
        rows.append(row + [""] * (7 - len(row)))
    return Drawn([figure], ["Radius of contact over the sliding distance, and its difference from Argatov's formula"],
                 ["s [mm]", "radius of contact [mm]", "of the rings'", "of Argatov's", "of uniform pressure",
                  "depth, of the rings'", "volume against k F s"], rows,
                 "The two independent solutions agree with each other and with gnomon; the asymptotic formula "
                 "is the one that "
                 "differs. [Details](validation.md#pin-on-disc), [in space](validation.md#pin-on-disc-in-space).")


def half_round(_full):
    figure, (left, right) = panels(2, 0.38)
    rows = []
    for young, colour in zip((130e3, 130e4, 130e5), style.COLOURS):
        done = run(SCENES / "half_round_ring.toml", f"body.young_modulus={young:g}")
        half_width, depth = half_round_ring.chord(young)
        end, nodes = done.history()[-1], done.contact()
        middle = min(nodes, key=lambda node: abs(node["X0"] - half_round_ring.MEAN))
        width = end["contact_half_width"]
        rows.append([f"{young / 1000:g}", percent(end["worn_volume"] / half_round_ring.VOLUME, 4), f"{width:.3f}",
                     percent(width / half_width), f"{middle['wear_depth']:.4f}", percent(middle["wear_depth"] / depth),
                     f"{end['element_quality']:.2f}", done.steps])
        near = [node for node in nodes if abs(node["X0"] - half_round_ring.MEAN) < 18]
        left.plot(column(near, "X"), column(near, "Y"), color=colour, label=f"E = {young / 1000:g} GPa")
        right.plot(column(near, "X"), [node["pressure"] / 1000 for node in near], color=colour)
    left.plot(column(near, "X0"), column(near, "Y0"), ":", color=style.GREY, label="unworn")
    left.set(xlabel="r [mm]", ylabel="z [mm]")
    right.set(xlabel="r [mm]", ylabel="pressure [GPa]")
    style.legend_above_all(figure, left.get_legend_handles_labels()[0])
    return Drawn([figure], ["Worn section and pressure at the end, for three stiffnesses"],
                 ["E [GPa]", "volume against k F s", "half width [mm]", "of the chord's", "depth [mm]",
                  "of the chord's",
                  "least element quality", "steps"], rows,
                 "No remeshing: elements of 1 mm lose 2.7 mm. What is left for copper, 130 GPa, is what the "
                 "closed form for "
                 "half-planes leaves out. [Details](validation.md#ring-of-half-round-section).")


ENTRIES = [
    Entry("block-on-ring", "Block on ring: measurements and two programs", """
A steel ring turns on a steel block for 3600 m (A. Cruzado and others, Revista de Metalurgia 46 (2010) 106).
Left: the measured grooves of three tests and gnomon's. Right: differences of computed profiles from the closed
form. The closed form is a groove of the ring's radius and the area k P s, corrected for the elasticity of the
half-plane.""", ring),
    Entry("pin-on-disc", "Pin on disc: the spherical end of a pin", """
A ball of 50 mm radius wears on a flat (I. Argatov, Wear 271 (2011) 1147), against three solutions: Argatov's
a^4 = a0^4 + 4 k F s R/pi, a worn half-space under uniform pressure, and rings of pressure on a half-space, by a
program of its own.""", disc),
    Entry("half-round-ring", "Ring of half-round section", """
After Ansys' technology demonstration td-043: a copper ring of half-round section is pressed on a flat ring and
wears. No numbers are published; the worn section is a chord, whose width and depth follow from the volume k F s
(Pappus) and the elasticity of a half-plane.""", half_round),
]
