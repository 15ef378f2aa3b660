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
    """One step for all times: the largest at which forward Euler is stable at all of them."""
    step = critical_step(numpy.concatenate(list(spectra.values())))
    spectra = some_times(spectra)
    figure = style.figure(height=1.2 * style.SINGLE)
    plane, line = figure.subplots(2, 1, sharex=True, height_ratios=[3.1, 1])
    regions = [draw_region(plane, line, name, stages, style.COLOURS[i])
               for i, (name, stages) in enumerate(METHODS.items())]
    times = draw_eigenvalues(plane, line, spectra, step)
    plane.axvline(0, color=style.GREY, linewidth=0.5)
    plane.set_aspect("equal", adjustable="box")
    plane.set_xlim(LEFT, RIGHT)
    plane.set_ylim(-0.15, TOP)
    plane.set_ylabel("|Im $h\\lambda$|")
    plane.set_title(f"$h$ = {step:.3g} s: critical for forward Euler")
    line.set_xlabel("Re $h\\lambda$")
    style.legend_above_all(figure, regions, times)
    return figure


def some_times(spectra):
    times = list(spectra)
    if len(times) > MOST_TIMES:
        chosen = numpy.linspace(0, len(times) - 1, MOST_TIMES).round().astype(int)
        times = [times[i] for i in chosen]
    return {t: spectra[t] for t in times}


def critical_step(eigenvalues):
    """|1 + h lambda| <= 1 for all eigenvalues that decay; those that are zero set no limit."""
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


def draw_region(plane, line, name, stages, colour):
    """Its boundary |R(z)| = 1, and the intersection with the real axis."""
    x, y = numpy.meshgrid(numpy.linspace(LEFT, RIGHT, 160), numpy.linspace(-0.15, TOP, 160))
    plane.contour(x, y, amplification(x + 1j * y, stages), levels=[1], colors=[colour],
                  linewidths=1.0)
    real = numpy.linspace(LEFT, -1, 4000)
    line.axvline(real[amplification(real, stages) <= 1].min(), color=colour, linewidth=1.0,
                 linestyle=style.DASHES if stages == 2 else "-")
    return Line2D([], [], color=colour, linewidth=1.0, label=name)


def draw_eigenvalues(plane, line, spectra, step):
    """In the complex plane, and their real parts again, one row per time."""
    handles = []
    for i, ((t, values), colour) in enumerate(zip(spectra.items(), style.sequence(len(spectra)))):
        z = step * values
        look = {"linestyle": "", "marker": style.MARKERS[i], "markersize": 3.2,
                "markerfacecolor": "none", "color": colour, "markeredgewidth": 0.7}
        plane.plot(z.real, numpy.abs(z.imag), zorder=3, clip_on=True, **look)
        line.plot(z.real, numpy.full(len(z), -i), zorder=3,
                  **(look | {"marker": "|", "markersize": 6}))
        handles.append(Line2D([], [], label=f"{style.number(t)} s", **look))
    line.set_ylim(-len(spectra) + 0.4, 0.6)
    line.set_yticks([-i for i in range(len(spectra))], [style.number(t) for t in spectra])
    line.tick_params(axis="y", length=0)
    line.set_ylabel("time [s]")
    return handles
