#!/usr/bin/env python3
"""A wheel on a rail by another program, with nothing of gnomon in it, and the figure of the tutorial.

Two like half-spaces under uniform tractions on rectangles (J. Boussinesq, V. Cerruti); steady rolling with differences
upwind of second order; the profile is frozen for one of many equal intervals of time, as contact programs are used.

python3 wheel_on_rail.py [RESULT.h5 FOLDER] [--size MM] [--steps N] [--creepage C] [--lateral CREEPAGE]"""

import argparse
import pathlib
import sys

import numpy as np

E, NU, FRICTION, FORCE = 210e3, 0.3, 0.3, 20e3
RADIUS, CROWN, SPEED, CREEPAGE = 460.0, 300.0, 20e3, 1e-3
WEAR, END = 1e-8, 9e4
PATHS = np.array([5000.0, 2890.0])  # of the rail, of the wheel


def displacements(x, y, h):
    """At (x, y) from a square of width h under unit traction, of both bodies together: normal by
    normal, along x by x, y by y, and x by y."""
    sums = np.zeros((4, *np.shape(x)))
    for i in (1, -1):
        for j in (1, -1):
            X, Y = x + i * h / 2, y + j * h / 2
            r = np.hypot(X, Y)
            a, b = Y * np.log(X + r), X * np.log(Y + r)
            sums += i * j * np.array([(1 - NU) * (a + b), (1 - NU) * (a + b) + NU * a,
                                      (1 - NU) * (a + b) + NU * b, -NU * r])
    return 2 * (1 + NU) / (np.pi * E) * sums


class Contact:
    def __init__(self, length, width, h):
        self.h = h
        self.x, self.y = (h * (np.arange(n) - (n - 1) / 2) for n in (round(length / h), round(width / h)))
        self.X, self.Y = (q.ravel() for q in np.meshgrid(self.x, self.y, indexing="ij"))
        self.normal = displacements(self.X[:, None] - self.X, self.Y[:, None] - self.Y, h)[0]
        self.pressed = None

    def press(self, gap):
        """Pressures under the force, by an active set."""
        on = self.pressed if self.pressed is not None else gap < np.sort(gap)[len(gap) // 3]
        for _ in range(100):
            k = np.flatnonzero(on)
            A = np.ones((len(k) + 1, len(k) + 1))
            A[:-1, :-1], A[-1, -1] = self.normal[np.ix_(k, k)], 0
            *p, approach = np.linalg.solve(A, np.append(-gap[k], FORCE / self.h**2))
            pressure = np.zeros(len(gap))
            pressure[k] = p
            settled = np.where(on, pressure > 0, gap + self.normal @ pressure + approach < 0)
            if (settled == on).all():
                self.pressed = on
                return pressure
            on = settled
        raise SystemExit("no contact was found")

    def roll(self, pressure, creepage):
        """Tractions on the wheel and slip per length that has passed, by Newton's method on
        T = projection of T - rho slip on the disc of radius f p; material comes from -x."""
        k = np.flatnonzero(pressure > 0)
        n, limit = len(k), FRICTION * pressure[k]
        x, y = self.X[k][:, None] - self.X[k], self.Y[k][:, None] - self.Y[k]
        here, before, two = (displacements(x - m * self.h, y, self.h) for m in range(3))
        _, xx, yy, xy = (1.5 * here - 2 * before + 0.5 * two) / self.h
        A, rigid = np.block([[xx, xy], [xy, yy]]), np.repeat(creepage, n)
        rho, T = 1 / np.diag(A).mean(), np.zeros(2 * n)
        for _ in range(100):
            Q = T - rho * (rigid + A @ T)
            size = np.maximum(np.hypot(Q[:n], Q[n:]), 1e-300)
            slips = size > limit
            factor = np.where(slips, limit / size, 1)
            rest = T - np.tile(factor, 2) * Q
            if np.abs(rest).max() < 1e-9 * limit.max():
                break
            ex, ey = Q[:n] / size, Q[n:] / size
            px, pc, py = (np.where(slips, factor * d, s) for d, s in ((1 - ex**2, 1), (-ex * ey, 0), (1 - ey**2, 1)))
            dQ = np.eye(2 * n) - rho * A
            J = np.eye(2 * n) - np.vstack([px[:, None] * dQ[:n] + pc[:, None] * dQ[n:],
                                           pc[:, None] * dQ[:n] + py[:, None] * dQ[n:]])
            T -= np.linalg.solve(J, rest)
        else:
            raise SystemExit("no tractions were found")
        slip = np.zeros(len(pressure))
        S = rigid + A @ T
        slip[k] = np.hypot(S[:n], S[n:])
        return T.reshape(2, n).sum(axis=1) * self.h**2, slip, n - slips.sum()


HEAD = ["t [s]", "largest pressure [MPa]", "forces along, across [N]", "power of friction [N mm/s]", "area [mm^2]",
        "stick [mm^2]", "depths of rail, wheel [um]", "volumes [mm^3]"]
TIMES = [0, 3e4, 6e4, 9e4]


def worn(h, steps, creepage):
    """(y, depths of rail and wheel by time, rows of the table above) at the times; without steps, at the start."""
    contact, profiles, rows = Contact(12, 18, h), {}, []
    depths, volumes, dt = np.zeros((2, len(contact.y))), np.zeros(2), END / max(steps, 1)
    for i in range(steps + 1):
        profile = np.tile(depths.sum(axis=0), len(contact.x))
        p = contact.press(contact.X**2 / (2 * RADIUS) + contact.Y**2 / (2 * CROWN) + profile)
        force, slip, stick = contact.roll(p, creepage)
        losses = (p * slip).reshape(len(contact.x), -1).sum(axis=0)  # [N/mm^2] along each line
        power = FRICTION * losses.sum() * h**2 * SPEED
        if any(abs(i * dt - t) < 0.5 * dt for t in TIMES):
            profiles[i * dt] = 1e3 * depths
            rows.append([i * dt, p.max(), *-force, power, (p > 0).sum() * h**2, stick * h**2,
                         *1e3 * depths.max(axis=1), *volumes])
        rates = WEAR * SPEED * losses * h / PATHS[:, None] * dt
        depths, volumes = depths + rates, volumes + rates.sum(axis=1) * h * PATHS
    return contact.y, profiles, rows


def figure(contact, y, profiles):
    """`contact`: rows of contact nodes at a time."""
    sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "plot"))
    from figures import style

    style.apply()
    page = style.figure(style.DOUBLE, 0.38 * style.DOUBLE)
    left, right = page.subplots(1, 2)
    for t, colour in zip(sorted(profiles), ("black", *style.sequence(3))):
        for name, of_other, mark in (("head", profiles[t][0], "s"), ("tread", profiles[t][1], "o")):
            middle = sorted((row for row in contact(t) if row["surface"] == name and abs(row["X0"]) < 1e-6),
                            key=lambda row: row["Y0"])
            Y = [row["Y0"] for row in middle]
            if t:
                left.plot(Y, [1e3 * row["wear_depth"] for row in middle], mark, color=colour, markersize=3)
                left.plot(y, of_other, color=colour, label=f"{t:,.0f} s" if mark == "o" else None)
        right.plot(Y, [row["pressure"] for row in middle], "o-", color=colour, label=f"{t:,.0f} s")
    left.set(xlabel="y, across the rail [mm]", ylabel="depth of wear [µm]", xlim=(-7.5, 7.5))
    right.set(xlabel="y, across the rail [mm]", ylabel="pressure at x = 0 [MPa]", xlim=(-7.5, 7.5))
    style.legend(left, columns=3)
    style.legend(right, columns=2)
    return page


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    words.add_argument("result", nargs="?")
    words.add_argument("folder", nargs="?")
    words.add_argument("--size", type=float, default=0.3)
    words.add_argument("--steps", type=int, default=30)
    words.add_argument("--creepage", type=float, default=CREEPAGE)
    words.add_argument("--lateral", type=float, default=0)
    given = words.parse_args()
    y, profiles, rows = worn(given.size, given.steps, [given.creepage, given.lateral])
    print(", ".join(HEAD))
    for row in rows:
        print(" ".join(f"{value:.6g}" for value in row))
    if given.result:
        from program import gnomon, rows_of

        page = figure(lambda t: rows_of(gnomon("contact", given.result, "--time", t)), y, profiles)
        page.savefig(pathlib.Path(given.folder) / "wheel_on_rail.png", dpi=200)


if __name__ == "__main__":
    main()
