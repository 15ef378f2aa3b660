"""A worn ball on an elastic half-space by rings of uniform pressure: a second solution for pin
on disc, with nothing of gnomon in it. Implicit Euler; the active set of rings is iterated in
each step."""

import numpy as np


def elliptic(m):
    """Complete integrals K and E of the parameter m < 1, by the arithmetic-geometric mean."""
    a, b, c, power = np.ones_like(m), np.sqrt(1 - m), np.sqrt(m), 1.0
    rest = 1 - c**2 / 2
    for _ in range(30):
        a, b, c = (a + b) / 2, np.sqrt(a * b), (a - b) / 2
        rest -= power * c**2
        power *= 2
    K = np.pi / (2 * a)
    return K, K * rest


def of_disc(r, a):
    """Displacement at r by unit pressure on a disc of radius a, times E/(1 - nu^2): Johnson,
    Contact Mechanics, 3.4."""
    r, u = np.asarray(r, float), np.zeros(len(r))
    if a == 0:
        return u
    inside = r <= a
    u[inside] = 4 * a / np.pi * elliptic((r[inside] / a) ** 2)[1]
    m = (a / r[~inside]) ** 2
    K, E = elliptic(m)
    u[~inside] = 4 * r[~inside] / np.pi * (E - (1 - m) * K)
    return u


def worn_ball(times, *, radius, force, wear, modulus, extent, rings=400, steps=600):
    """(radius of contact, depth at the centre) at the times, where k v = `wear` and E/(1 - nu^2)
    = `modulus`."""
    edges = np.linspace(0, extent, rings + 1)
    r, area = (edges[1:] + edges[:-1]) / 2, np.pi * (edges[1:] ** 2 - edges[:-1] ** 2)
    discs = np.array([of_disc(r, a) for a in edges]).T / modulus
    influence = discs[:, 1:] - discs[:, :-1]
    h, active, now, found = np.zeros(rings), r < extent / 4, 0.0, []
    for t in np.union1d(times[-1] * np.linspace(0, 1, steps + 1) ** 3, times):
        rate, now = wear * (t - now), t
        start = r**2 / (2 * radius) + h
        while True:
            on = np.flatnonzero(active)
            A = np.zeros((len(on) + 1, len(on) + 1))
            A[:-1, :-1] = influence[np.ix_(on, on)] + rate * np.eye(len(on))
            A[:-1, -1], A[-1, :-1] = -1, area[on]
            *pressure, approach = np.linalg.solve(A, np.append(-start[on], force))
            p = np.zeros(rings)
            p[on] = pressure
            gap = start + influence @ p + rate * p - approach
            settled = np.where(active, p > 0, gap < 0)
            if (settled == active).all():
                break
            active = settled
        h += rate * p
        if t in times:
            i = on[-1] + 1  # open: its gap falls to zero at the edge
            edge = r[i] - gap[i] * (r[i + 1] - r[i]) / (gap[i + 1] - gap[i])
            found.append((edge, h[0]))
    return found
