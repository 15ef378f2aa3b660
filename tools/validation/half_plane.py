"""A cylinder that slides to and fro on a flat, both half-planes that wear: cells of uniform
pressure, unilateral contact in each of the places of a stroke, forward Euler. It shares nothing
with gnomon."""

import numpy as np


def influence(x, cell, modulus):
    """Displacement at x under the unit pressure on a cell, up to a constant; 1/E* is the sum of
    (1 - nu^2)/E of the bodies (K. L. Johnson, Contact Mechanics, eq. 2.25)."""
    def primitive(t):
        return t * np.log(np.abs(t)) - t
    d = x[:, None] - x[None, :]
    return -2 / (np.pi * modulus) * (primitive(d + cell / 2) - primitive(d - cell / 2))


def pressures(A, gap, load, cell, touching):
    """gap + A p = approach where p > 0; `touching` is where the search begins."""
    while True:
        on = np.flatnonzero(touching)
        K = np.zeros((on.size + 1, on.size + 1))
        K[:-1, :-1] = A[np.ix_(on, on)]
        K[:-1, -1] = -1
        K[-1, :-1] = cell
        solution = np.linalg.solve(K, np.append(-gap[on], load))
        p = np.zeros(gap.size)
        p[on] = solution[:-1]
        now = np.where(touching, p > 0, gap + A @ p < solution[-1])
        if (now == touching).all():
            return p, now
        touching = now


def fretting(cycles, radius, load, amplitude, wear, modulus, step, places=9, half=0.3):
    """Depths [mm] in the middle of the flat and of the cylinder after the numbers of `cycles`;
    `wear` of the flat and of the cylinder, `step` in cycles."""
    cell = 2 * amplitude / (places - 1)
    count = round(half / cell)
    x = cell * np.arange(-count, count + 1)
    A = influence(x, cell, modulus)
    shifts = np.arange(places) - places // 2
    weights = np.full(places, 1 / (places - 1))
    weights[[0, -1]] /= 2
    touching = [np.abs(x - s * cell) < 0.05 for s in shifts]
    flat, cylinder, found = np.zeros(x.size), np.zeros(x.size), []
    for done in range(step, max(cycles) + 1, step):
        on_flat, on_cylinder = np.zeros(x.size), np.zeros(x.size)
        for k, s in enumerate(shifts):
            gap = (x - s * cell) ** 2 / (2 * radius) + flat + np.roll(cylinder, s)
            p, touching[k] = pressures(A, gap, load, cell, touching[k])
            on_flat += weights[k] * p
            on_cylinder += weights[k] * np.roll(p, -s)
        flat += wear[0] * 4 * amplitude * step * on_flat
        cylinder += wear[1] * 4 * amplitude * step * on_cylinder
        if done in cycles:
            found.append((flat[count], cylinder[count]))
    return found
