#!/usr/bin/env python3
"""Steady rolling of two unlike cylinders in plane strain by another program, with nothing of gnomon in it: the problem of
R. H. Bentall and K. L. Johnson, Int. J. Mech. Sci. 9 (1967) 389-404 (K. L. Johnson, Contact Mechanics, sec. 8.2).

Half-planes under uniform pressure p and traction q on equal cells (Contact Mechanics, eq. 2.25); q acts along x on the
first body and against it on the second one, material enters at -x. With 1/E* the sum of (1 - nu^2)/E, k the difference
of (1 - 2 nu)(1 + nu)/E = 2 beta/E*, and the creepage xi of the first body against the second one,

    gap of the surfaces   g = x^2/(2R) - approach + u,   du/dx = -2/(pi E*) int p/(x - s) ds + k q
    slip per length       s = xi - k p - 2/(pi E*) int q/(x - s) ds
    g >= 0, p >= 0, g p = 0;   |q| <= f p, and q = -f p sign(s) where s is not zero

are solved together by Newton's method, for a given creepage or a given force Q along x on the first body. Lengths are
in half widths a of Hertz, tractions in its p0, so that creepages are in a/R: gap and slip depend on beta and f alone.

python3 unlike_rollers.py            tables and checks
python3 unlike_rollers.py --beta B --friction F [--force Q/(fP) | --creepage XI*R/a] [--cells N] [--uncoupled]"""

import argparse

import numpy as np


class Rolling:
    """`beta` of Dundurs is positive where the first body is the more compliant one. `uncoupled` leaves q out of the gap."""

    def __init__(self, beta, friction, cells=400, half=1.25, uncoupled=False):
        self.beta, self.f, self.h = beta, friction, 2 * half / cells
        self.x = x = self.h * (np.arange(cells) - (cells - 1) / 2)
        d = x[:, None] - x
        ends = [np.where(t == 0, 0, t * np.log(np.abs(t) + (t == 0)) - t) for t in (d + self.h / 2, d - self.h / 2)]
        # p0/E* = a/(2R): displacements in a^2/R, slopes and slip in a/R.
        self.A = -(ends[0] - ends[1]) / np.pi
        before = self.h * (np.tri(cells, k=-1) + np.eye(cells) / 2)  # integral from the left up to x
        self.B = beta * before
        self.of_friction = np.zeros_like(self.B) if uncoupled else self.B
        upwind = (1.5 * np.eye(cells) - 2 * np.eye(cells, k=-1) + 0.5 * np.eye(cells, k=-2)) / self.h
        self.slip_of_q, self.slip_of_p = upwind @ self.A, -upwind @ self.B
        self.P, self.state = np.pi / 2, None

    def solve(self, force=None, creepage=0.0):
        """`force`: Q/(f P), which determines the creepage. Newton's method begins where the last call ended."""
        n, h, f, rho = len(self.x), self.h, self.f, 0.5 * self.h
        p = np.sqrt(np.maximum(1 - self.x**2, 0))
        p, q, approach, xi = self.state or (p, np.zeros(n), (self.A @ p + self.x**2 / 2)[n // 2], creepage)
        identity, ones, zero = np.eye(n), np.ones((n, 1)), np.zeros((n, 1))
        for _ in range(200):
            g = self.x**2 / 2 - approach + self.A @ p + self.of_friction @ q
            s = xi + self.slip_of_p @ p + self.slip_of_q @ q
            on = (p - g / rho > 0)[:, None]
            T = q - rho * s
            limit = f * np.maximum(p, 0)
            slips = (np.abs(T) > limit) & on[:, 0]
            sign = np.where(slips, np.sign(T), 0)[:, None]
            sticks = (on[:, 0] & ~slips)[:, None]
            F = np.concatenate([np.where(on[:, 0], g, p),
                                np.where(slips, q - sign[:, 0] * f * p, np.where(sticks[:, 0], s, q)),
                                [h * p.sum() - self.P, h * q.sum() - force * f * self.P if force is not None
                                 else xi - creepage]])
            J = np.block([
                [np.where(on, self.A, identity), on * self.of_friction, -ones * on, zero],
                [np.where(sticks, self.slip_of_p, -sign * f * identity),
                 np.where(sticks, self.slip_of_q, identity), zero, ones * sticks],
                [h * ones.T, zero.T, np.zeros((1, 2))],
                [zero.T, h * ones.T if force is not None else zero.T, 0 * np.eye(1), float(force is None) * np.eye(1)]])
            if np.abs(F).max() < 1e-11:
                break
            if force is not None and not sticks.any():
                J[-1, -1] += 1e-6
            step = np.linalg.solve(J, F)
            p, q, approach, xi = p - step[:n], q - step[n:2 * n], approach - step[-2], xi - step[-1]
        else:
            raise SystemExit("no tractions were found")
        self.state = p, q, approach, xi
        self.p, self.q, self.xi, self.s = p, q, xi, np.where(on[:, 0], s, 0)
        self.slips, self.on = slips, on[:, 0]
        return self

    def force(self):
        return self.q.sum() * self.h / (self.f * self.P)

    def power(self):
        """Friction's power by f P V a/R."""
        return -(self.q * self.s).sum() * self.h / (self.f * self.P)

    def balance(self):
        """The same, from the creepage and the lever arm of the pressure."""
        return -(self.xi * self.q.sum() + (self.p * self.x).sum()) * self.h / (self.f * self.P)

    def zones(self):
        """(from, to, sign of the slip; 0: stick) in a, in the order of passing."""
        kind = np.where(self.slips, np.sign(self.s), 0)[self.on]
        x = self.x[self.on]
        cuts = [0, *(np.flatnonzero(np.diff(kind)) + 1), len(kind)]
        return [(x[i] - self.h / 2, x[j - 1] + self.h / 2, int(kind[i])) for i, j in zip(cuts, cuts[1:])]

    def stick(self):
        return (self.on & ~self.slips).sum() * self.h / 2


def bisect(function, low=0.0, high=1.0):
    """Zero of an ascending function."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return low


def words_of(zones):
    return ", ".join(f"{'-0+'[sign + 1]} to {end:.3f}" for _, end, sign in zones)


def tables():
    print("Carter: Q/(fP), creepage and width of stick by his, power by Q times creepage")
    for ratio in (0.2, 0.5, 0.8):
        r = Rolling(0, 0.1).solve(-ratio)
        b = np.sqrt(1 - ratio)
        print(f"  {ratio}  {r.xi / (0.1 * (1 - b)):.4f}  {r.stick() / b:.4f}  {r.power() / (ratio * r.xi):.4f}")
    print("All sticks, q without influence on p: creepage of free rolling by 2 beta a / (pi R)")
    for cells in (100, 200, 400, 800):
        r = Rolling(0.2, 100, cells, uncoupled=True).solve(0)
        print(f"  {cells}  {r.xi / (0.4 / np.pi):.4f}")
    r = Rolling(0.2, 0.001).solve(0)
    at = bisect(lambda x: x * np.sqrt(1 - x * x) + np.arcsin(x) - np.pi / 4)
    print(f"Hardly any friction: creepage of free rolling by the one at which half of the load is slower "
          f"{r.xi / (0.2 * np.sqrt(1 - at**2)):.4f}")
    print("Free rolling: beta, f/beta, creepage by beta a/R, power by f P V a/R, the same by the balance, width of stick, "
          "zones")
    for beta in (0.1, 0.2, 0.3):
        for ratio in (0.1, 0.2, 0.3, 0.5, 1, 2, 5, 20):
            r = Rolling(beta, ratio * beta).solve(0)
            print(f"  {beta} {ratio:5}  {r.xi / beta:.4f}  {r.power():.3e} {r.balance():.3e}  {r.stick():.3f}  "
                  f"{words_of(r.zones())}")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    words.add_argument("--beta", type=float)
    words.add_argument("--friction", type=float)
    words.add_argument("--force", type=float, default=0)
    words.add_argument("--creepage", type=float)
    words.add_argument("--cells", type=int, default=400)
    words.add_argument("--uncoupled", action="store_true")
    given = words.parse_args()
    if given.beta is None:
        return tables()
    rolling = Rolling(given.beta, given.friction, given.cells, uncoupled=given.uncoupled)
    r = rolling.solve(given.force)
    if given.creepage is not None:
        r = rolling.solve(None, given.creepage)
    print(f"creepage {r.xi:.5g} a/R, force {r.force():.5g} f P, power {r.power():.5g} f P V a/R (by the balance "
          f"{r.balance():.5g}), stick {r.stick():.4f} of the width, zones {words_of(r.zones())}")


if __name__ == "__main__":
    main()
