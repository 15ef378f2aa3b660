"""Integrators on equations with closed forms, and the critical step of forward Euler."""

import math
import re

from figures import style
from program import ROOT, gnomon, run

from gallery.entry import Drawn, Entry, panels

PROBLEMS = ROOT / "problems"
SCENE = PROBLEMS / "dahlquist/nonlinear.toml"
ORDERS = {"forward-euler": 1, "backward-euler": 1, "theta": 2, "sdirk-2": 2, "erk-3": 3, "esdirk-3": 3, "esdirk-4": 4,
          "esdirk-5": 5}
STEPS = (0.4, 0.2, 0.1, 0.05)


def orders(_full):
    figure, (axes, right) = panels(2, 0.42)
    rows = []
    for (name, order), colour, marker in zip(ORDERS.items(), style.COLOURS, style.MARKERS):
        errors = []
        for step in STEPS:
            done = run(SCENE, f"integrator.name={name}", f"integrator.step={step}", "output.every=0")
            errors.append(done.history()[-1]["error"])
        axes.loglog(STEPS, errors, marker=marker, color=colour, label=name)
        slopes = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
        rows.append([f"`{name}`", order, *(f"{slope:.2f}" for slope in slopes), f"{errors[-1]:.1e}"])
    axes.set(xlabel="step [s]", ylabel="error at the end")
    style.log_ticks(axes.xaxis)
    handles = axes.get_legend_handles_labels()[0]
    tolerances, found = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7), {}
    for name, colour, marker in (("esdirk-3", *pair("esdirk-3")), ("esdirk-4", *pair("esdirk-4")),
                                 ("bdf", style.GREY, "x")):
        found[name] = [run(SCENE, f"integrator.name={name}", f"integrator.rtol={tolerance}",
                           "output.every=0").history()[-1]["error"] for tolerance in tolerances]
        line, = right.loglog(tolerances, found[name], marker=marker, color=colour, label=name)
        handles += [line] if name == "bdf" else []
    right.loglog(tolerances, tolerances, ":", color=style.GREY)
    right.set(xlabel="rtol")
    style.legend_above_all(figure, handles)
    return Drawn([figure], ["Error against the step, and against the tolerance (dotted: equal)"],
                 ["method", "order", *(f"slope {a:g} to {b:g} s" for a, b in zip(STEPS, STEPS[1:])),
                  f"error at {STEPS[-1]:g} s"], rows)


def pair(name):
    place = list(ORDERS).index(name)
    return style.COLOURS[place], style.MARKERS[place]


def critical_step(*settings):
    """Critical step and onset of forward Euler at 200 s."""
    words = [word for setting in settings for word in ("--set", setting)]
    text = gnomon("stability", PROBLEMS / "pin_on_flat/small_deformation.toml", "--time", 200, "--integrator",
                  "forward-euler", *words)
    return critical_step_in(text)


def critical_step_in(text):
    found = re.search(r"^\s*200\s.*$", text, re.MULTILINE)
    numbers = [float(word) for word in found[0].split() if re.fullmatch(r"-?[\d.]+(e-?\d+)?", word)]
    return numbers[-2], numbers[-1]


def stability(_full):
    figure, (axes,) = panels(1, 0.4)
    rows = []
    for elements, colour in zip((20, 40), style.COLOURS):
        stiffness = (10, 40, 160, 640)
        found = [critical_step(f"body.young_modulus={young}", f"mesh.elements=[{elements}, {elements}]")
                 for young in stiffness]
        axes.loglog(stiffness, [pair[0] for pair in found], "-", color=colour,
                    label=f"{elements} x {elements}, from the spectrum")
        axes.loglog(stiffness, [pair[1] for pair in found], "o", markerfacecolor="none", color=colour,
                    label=f"{elements} x {elements}, onset in steps")
        for young, (critical, onset) in zip(stiffness, found):
            scaled = critical * young / (1 - 0.3**2) * 1e-4 / (10 / elements)
            rows.append([f"{elements} x {elements}", young, f"{critical:.4g}", f"{onset:.4g}", f"{scaled:.3f}"])
    axes.set(xlabel="E [MPa]", ylabel="critical step [s]")
    style.log_ticks(axes.xaxis)
    style.legend(axes, columns=2)
    return Drawn([figure], ["Critical step of forward Euler against Young's modulus, on two meshes"],
                 ["elements", "E [MPa]", "critical step [s]", "onset [s]", "critical step x k v E*/h"], rows)


ENTRIES = [
    Entry("orders", "Orders of the methods", """
A nonlinear equation with a solution in closed form (`problems/dahlquist/nonlinear.toml`). Each halving of the
step divides the error by 2 to the power of the order.""", orders),
    Entry("critical-step", "The critical step of forward Euler (eq. 17)", """
The largest stable step at t = 200 s, from the spectrum of the linearized equations, and the step above which a
perturbation grows in actual steps. Eq. (17) says that it is proportional to h/E
([theory](theory.md#why-explicit-methods-need-small-steps)). [More](stability.md).""",
          stability),
]
