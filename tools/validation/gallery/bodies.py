"""Bodies of several materials, and partners that move as they do: a lining, a coating, a journal, a bore."""

import math

import numpy
from figures import style
from program import SCENES, bisect, percent, run
from scipy.optimize import brentq

from gallery.entry import Drawn, Entry, column, panels


def confined(young, poisson):
    """Modulus of a layer that cannot move sideways."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def beam(pressure, piston, spring, bending):
    """A plate on springs that do not pull, pushed in the middle: the half length that touches, and its pressure."""
    roots = (spring / (4 * bending)) ** 0.25 * numpy.array([1 + 1j, 1 - 1j, -1 + 1j, -1 - 1j])

    def deflection(x, end):
        at = roots**numpy.arange(4)[:, None]
        inner, outer, none = numpy.exp(roots * piston), numpy.exp(roots * end), numpy.zeros((2, 4))
        rows = numpy.block([[at[[1, 3]], none], [at * inner, -at * inner], [none, at[[2, 3]] * outer]])
        right = numpy.zeros(8)
        right[2] = -pressure / spring
        factors = numpy.linalg.solve(rows, right)
        terms = numpy.exp(roots * numpy.asarray(x, dtype=float)[..., None])
        return numpy.where(x < piston, pressure / spring + (terms @ factors[:4]).real, (terms @ factors[4:]).real)

    end = brentq(lambda a: deflection(a, a), 1.1 * piston, 4 * piston)
    return end, lambda x: spring * deflection(x, end)


def lining(axes, rows):
    done = run(SCENES / "lining.toml")
    for colour, time in zip(style.COLOURS, (0, 100, 500, 2000, 10000)):
        nodes = done.contact(time)
        axes.plot(column(nodes, "X0"), column(nodes, "pressure"), color=colour, label=f"{time} s")
        if time == 0:
            start = nodes
    end, pressure = beam(4, 15, confined(1000, 0.25) / 8, 210e3 * 5**3 / 12 / (1 - 0.3**2))
    x = numpy.linspace(0, end, 100)
    axes.plot(x, pressure(x), color=style.GREY, linestyle=style.DASHES, label="plate on springs")
    axes.set(xlabel="position [mm]", ylabel="pressure [MPa]", title="lining", xlim=(0, 60), ylim=(0, None))
    axes.legend()
    rows.append(["lining, at the start", "pressure in the middle [MPa]", f"{start[0]['pressure']:.3f}",
                 f"{pressure(0):.3f}", percent(start[0]["pressure"] / pressure(0))])
    worn = done.history()[-1]["worn_volume"]
    law = 5e-9 * 4 * 15 * 1e4 * 1e4
    rows.append(["lining, 10,000 s", "worn area [mm^2]", f"{worn:.3f}", f"{law:.3f}", percent(worn / law)])


def coating(axes, rows):
    done = run(SCENES / "coating.toml")
    history = done.history()
    left = numpy.array([0.5 - row["wear_depth"] for row in history])
    elastic = numpy.array([row["approach"] - row["wear_depth"] for row in history])
    compliance = 20 * (left / confined(1500, 0.4) + 10 / confined(70e3, 0.33))
    axes.plot(left, 1e3 * compliance, color=style.GREY, label="$p\\,(h_1/M_1 + h_2/M_2)$")
    axes.plot(left, 1e3 * elastic, "o", color=style.COLOURS[0], label="gnomon")
    axes.set(xlabel="thickness of the coating [mm]", ylabel="elastic approach [µm]", title="coating", ylim=(0, None))
    axes.invert_xaxis()
    axes.legend()
    for row in (0, -1):
        rows.append([f"coating, {history[row]['t']:.0f} s", "elastic approach [mm]", f"{elastic[row]:.7f}",
                     f"{compliance[row]:.7f}", percent(elastic[row] / compliance[row], 4)])


def bodies(_full):
    figure, axes = panels(2, 0.36)
    rows = []
    lining(axes[0], rows)
    coating(axes[1], rows)
    return Drawn([figure], ["Pressures on the face of a lining, and the elastic approach of a coating that gets thinner"],
                 ["scene", "quantity", "gnomon", "by hand", "difference"], rows)


CLEARANCE, RADIUS, WALL, FORCE = 0.05, 10.0, 2.95, 100.0
RATE = 1e-8 * 100 * RADIUS  # k v


def half_angle(t, friction):
    """Of the arc that touches, by springs of the wall's stiffness: R c (a / cos a - sin a) = N (1/K + k v t)."""
    normal = FORCE / math.hypot(1, friction)
    right = normal * (WALL / confined(3000, 0.35) + RATE * t) / (RADIUS * CLEARANCE)
    return bisect(lambda a: a / math.cos(a) - math.sin(a) - right, 1e-6, math.pi / 2 - 1e-6)


def around(nodes):
    """Angles from the bottom of the bore and pressures, in order."""
    return zip(*sorted((math.degrees(math.atan2(node["X0"], -node["Y0"])), node["pressure"]) for node in nodes))


def partners(_full):
    figure, axes = panels(2, 0.36)
    rows = []
    for colour, (name, scene, settings, friction, leaning) in zip(style.COLOURS, (
            ("bore, no friction", "bore", (), 0.0, 0.0),
            ("guided, friction 0.3", "bore", ("friction.coefficient=0.3",), 0.3, 0.0),
            ("journal, friction 0.3", "journal", (), 0.3, math.atan(0.3)))):
        done = run(SCENES / f"{scene}.toml", *settings)
        angles, pressures = around(done.contact(0))
        axes[0].plot(angles, pressures, color=colour, label=name,
                     linestyle=style.DASHES if name.startswith("guided") else "-")
        middle = numpy.dot(angles, pressures) / sum(pressures)
        rows.append([name, "0", "middle of the pressures [degrees]", f"{abs(middle):.2f}",
                     f"{math.degrees(leaning):.2f}"])
        history = done.history()
        rows.append([name, "0", "force of the guide [N/mm]", f"{abs(history[0]['guide_x']):.3f}",
                     f"{FORCE * friction if not leaning else 0:.0f}"])
        if name.startswith("guided"):
            continue
        t = numpy.linspace(0, 1000, 50)
        shift = [CLEARANCE / math.cos(half_angle(at, friction)) for at in t]
        found = [math.hypot(row["approach"], row.get("approach_2", 0)) for row in history]
        axes[1].plot(t, shift, color=colour)
        axes[1].plot(column(history, "t"), found, "o", color=colour, label=name)
        for row in (0, -1):
            by_hand = CLEARANCE / math.cos(half_angle(history[row]["t"], friction))
            rows.append([name, f"{history[row]['t']:.0f}", "shift of the shaft [mm]", f"{found[row]:.5f}",
                         f"{by_hand:.5f}"])
    axes[0].set(xlabel="angle from the bottom of the bore [degrees]", ylabel="pressure at the start [MPa]",
                xlim=(-60, 60), ylim=(0, None))
    axes[1].set(xlabel="time [s]", ylabel="shift of the shaft [mm]", ylim=(0.05, None))
    for panel in axes:
        panel.legend()
    return Drawn([figure], ["Pressures around a bore, and the way of its shaft (lines: by hand)"],
                 ["scene", "time [s]", "quantity", "gnomon", "by hand"], rows)


ENTRIES = [
    Entry("bodies", "Several materials: a lining and a coating", """
A friction lining on a steel back plate, dashed: a plate on springs that do not pull; and a coating that gets thinner
while its substrate does not. [The scenes and the calculation](bodies.md).""", bodies),
    Entry("partners", "A shaft in its bore", """
A shaft that turns in the full ring of a bush. With friction 0.3 it rolls up the bore by arctan 0.3 = 16.7 degrees; a
guide would hold it in the middle. [The scenes and the calculation](partners.md).""", partners),
]
