"""Contact without wear: Hertz in the plane, of revolution and in space."""

import math

import hertz
import numpy
from figures import style
from program import SCENES, arc_lengths, percent, run
from scipy import optimize, special

from gallery.entry import Drawn, Entry, column, panels

NAMES = {"hertz_cylinder": "cylinder on a flat", "hertz_ball_axisymmetric": "ball on a flat",
         "ball_in_seat_axisymmetric": "ball in a conical seat", "ring_in_groove_axisymmetric": "ring in a groove"}


def profile(axes, done, kind, a, p0):
    nodes = done.contact()
    s = numpy.array(arc_lengths(nodes))
    p = numpy.array(column(nodes, "pressure"))
    middle = 0 if kind == "point" else (s * p).sum() / p.sum()
    x = numpy.linspace(-1, 1, 401) if kind != "point" else numpy.linspace(0, 1, 401)
    axes.plot(x, numpy.sqrt(1 - x**2), color=style.GREY, label="Hertz")
    shown = abs(s - middle) < 1.3 * a
    axes.plot((s[shown] - middle) / a, p[shown] / p0, "o", markersize=2, color=style.COLOURS[0], label="gnomon")


def plane(_full):
    figure, axes = panels(4, 0.3)
    rows = []
    for panel, (name, (kind, (a, p0))) in zip(axes, hertz.CASES.items()):
        for factor in (2, 1, 0.5):
            done = run(SCENES / f"{name}.toml", f"mesh.factor={factor}")
            nodes = done.contact()
            width, error = hertz.measures(nodes, kind, a, p0)
            largest = max(node["pressure"] for node in nodes)
            rows.append([NAMES[name] if factor == 2 else "", done.unknowns,
                         int(sum(node["active"] for node in nodes)), percent(largest / p0), percent(width / a),
                         f"{100 * error:.1f} %"])
            if factor == 1:
                profile(panel, done, kind, a, p0)
        panel.set(xlabel="position / a", title=NAMES[name])
    axes[0].set_ylabel("pressure / $p_0$")
    style.legend_above_all(figure, axes[0].get_legend_handles_labels()[0])
    return Drawn([figure], ["Contact pressures and Hertz's"],
                 ["contact", "unknowns", "nodes in contact", "largest pressure", "half width", "pressure, rms"], rows)


def ellipse(force, A, B, modulus):
    """Half axes and largest pressure where the gap is A x^2 + B y^2, A <= B (Johnson, sec. 4.2)."""
    def ratio(k):  # b/a = k: A/B from the complete elliptic integrals
        m = 1 - k**2
        K, E = special.ellipk(m), special.ellipe(m)
        return (K - E) / (E / k**2 - K) - A / B
    k = optimize.brentq(ratio, 1e-3, 1 - 1e-9)
    m = 1 - k**2
    K, E = special.ellipk(m), special.ellipe(m)
    # A = p0 (K - E) / (E* a m) * k, p0 = 3 F / (2 pi a b)
    a = (1.5 * force * (K - E) / (math.pi * modulus * m * A)) ** (1 / 3)
    return a, k * a, 1.5 * force / (math.pi * a * k * a)


def groove_radius():
    a, b, p0 = ellipse(100, (1 / 5 - 1 / 6) / 2, (1 / 5 - 1 / 21) / 2, hertz.MODULUS)
    return p0, lambda node: math.hypot(node["Y0"] / a, node["X0"] / b)


def seat_radius():
    radius, ring = 5.0, 5.0 / math.sqrt(2)
    half_width, p0 = hertz.line(4 * 1000 / (2 * math.pi * ring / math.sqrt(2)), radius)
    return p0, lambda node: (math.hypot(node["X0"], node["Y0"], node["Z0"]) - radius) / half_width


SPACE = {"ball_in_groove": ("ball in the groove of a ring", groove_radius),
         "ball_in_seat": ("ball in a conical seat", seat_radius)}


def space(_full):
    figure, axes = panels(2, 0.35)
    rows = []
    for panel, (scene, (name, closed_form)) in zip(axes, SPACE.items()):
        p0, position = closed_form()
        for factor in (2, 1):
            done = run(SCENES / f"{scene}.toml", f"mesh.factor={factor}")
            nodes = done.contact()
            s = numpy.array([position(node) for node in nodes])
            p = numpy.array(column(nodes, "pressure"))
            expected = p0 * numpy.sqrt(numpy.maximum(0, 1 - s**2))
            rows.append([name if factor == 2 else "", done.unknowns, int((p > 0).sum()), percent(p.max() / p0),
                         f"{abs(p - expected).sum() / expected.sum():.3f}"])
        near = abs(s) < 1.3
        panel.plot(s[near], p[near] / p0, "o", markersize=2, color=style.COLOURS[0], label="gnomon", zorder=3)
        x = numpy.linspace(min(0, s[near].min()), 1, 401).clip(-1)
        panel.plot(x, numpy.sqrt(1 - x**2), color=style.GREY, label="Hertz")
        panel.set(xlabel="position / half axis", title=name)
    axes[0].set_ylabel("pressure / $p_0$")
    style.legend_above_all(figure, axes[0].get_legend_handles_labels()[0])
    return Drawn([figure], ["Contact pressures of bodies in space and Hertz's"],
                 ["contact", "unknowns", "nodes in contact", "largest pressure", "sum of differences / sum"], rows)


ENTRIES = [
    Entry("hertz", "Hertz, in the plane and of revolution", """
Contact without wear (`wear.coefficient = 0`). Dots are nodes, the lines are Hertz's theory with the half width
a and the largest pressure p0. [Details](validation.md#hertz).""", plane),
    Entry("hertz-space", "Hertz, in space", """
A ball in the groove of an outer bearing ring touches it in an ellipse; nodes are drawn over sqrt((x/a)^2 +
(y/b)^2). A ball in a conical seat touches it along a ring; nodes are drawn over the distance from the ring.
[Details](validation.md#hertz-in-space).""", space),
]
