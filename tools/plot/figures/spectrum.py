"""Eigenvalues times a step in the stability regions of explicit methods."""

import numpy
from matplotlib.lines import Line2D

from . import style, tables
from .complaints import BadInput

# R(z) of an explicit method of p <= 4 stages and order p: the first p + 1 terms of exp(z).
METHODS = {"forward Euler": 1, "RK2": 2, "RK3": 3, "RK4": 4}
MOST_TIMES = 4
LEFT, RIGHT, TOP = -3.2, 0.9, 3.2


def read(folder):
    """Eigenvalues by time."""
    path = folder / "spectrum.csv"
    found = {}
    for row in tables.read(path, ("time", "real", "imag")):
        t, real, imag = (tables.number(path, row, name) for name in ("time", "real", "imag"))
        if not numpy.isfinite([t, real, imag]).all():
            raise BadInput(f"{path} holds a row without time, real or imag")
        found.setdefault(t, []).append(complex(real, imag))
    return {t: numpy.array(found[t]) for t in sorted(found)}


def draw(spectra):
    """One step for all times, the largest at which forward Euler is stable at all of them."""
    step = critical_step(numpy.concatenate(list(spectra.values())))
    figure = style.figure(height=1.12 * style.SINGLE)
    axes = figure.add_subplot()
    axes.axhline(0, color=style.GREY, linewidth=0.5)
    axes.axvline(0, color=style.GREY, linewidth=0.5)
    handles = [draw_region(axes, name, stages, style.COLOURS[i])
               for i, (name, stages) in enumerate(METHODS.items())]
    handles += draw_eigenvalues(axes, spectra, step)
    axes.set_aspect("equal")
    axes.set_xlabel("Re $h\\lambda$")
    axes.set_ylabel("Im $h\\lambda$")
    axes.set_title(f"$h$ = {step:.3g} s")
    style.legend_above_all(figure, handles)
    return figure


def critical_step(eigenvalues):
    """|1 + h lambda| <= 1 for all eigenvalues that decay; those at rest set no limit."""
    decaying = eigenvalues[eigenvalues.real < -1e-12 * numpy.abs(eigenvalues).max()]
    if not len(decaying):
        raise BadInput("no eigenvalue of the spectrum has a negative real part")
    return (-2 * decaying.real / numpy.abs(decaying) ** 2).min()


def amplification(z, stages):
    term, total = numpy.ones_like(z), numpy.ones_like(z)
    for k in range(1, stages + 1):
        term = term * z / k
        total = total + term
    return numpy.abs(total)


def draw_region(axes, name, stages, colour):
    x, y = numpy.meshgrid(numpy.linspace(LEFT, RIGHT, 400), numpy.linspace(-TOP, TOP, 600))
    axes.contour(x, y, amplification(x + 1j * y, stages), levels=[1], colors=[colour],
                 linewidths=1.0)
    return Line2D([], [], color=colour, linewidth=1.0, label=name)


def draw_eigenvalues(axes, spectra, step):
    """Mostly real: later times a little higher up in the drawing order, smaller on top."""
    times = list(spectra)
    if len(times) > MOST_TIMES:
        times = [times[i] for i in numpy.linspace(0, len(times) - 1, MOST_TIMES).round().astype(int)]
    handles = []
    for i, (t, colour) in enumerate(zip(times, style.sequence(len(times)))):
        z = step * spectra[t]
        look = {"linestyle": "", "marker": style.MARKERS[i], "markersize": 4.5 - 0.7 * i,
                "markerfacecolor": "none", "color": colour, "markeredgewidth": 0.8}
        axes.plot(z.real, z.imag, zorder=3, **look)
        handles.append(Line2D([], [], label=f"$t$ = {style.number(t)} s", **look))
    return handles
