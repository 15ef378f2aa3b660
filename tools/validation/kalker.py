#!/usr/bin/env python3
"""Kalker's creepage coefficients of a circular contact of like bodies (J. J. Kalker, Three-Dimensional Elastic Bodies in
Rolling Contact, 1990, app. E) from half-spaces under uniform tractions on squares, as in wheel_on_rail.py, with nothing of
gnomon in it: vanishing creepage, all sticks, tractions vanish where material enters. With G the shear modulus, and c
the radius,

    F_x = -C11 G c^2 xi_x,   F_y = -C22 G c^2 xi_y,   M_z = C23 G c^3 xi_y

Squares are those whose centre lies within the circle; c is that of their area. Errors are of first order: values are
extrapolated from two meshes.

python3 kalker.py [NU ...]"""

import sys

import numpy as np
import wheel_on_rail


def coefficients(nu, cells):
    """`cells` on the radius."""
    wheel_on_rail.NU, wheel_on_rail.E = nu, 2 * (1 + nu)  # G = 1
    h = 1 / cells
    places = h * np.arange(-cells - 1, cells + 2)
    x, y = (q.ravel() for q in np.meshgrid(places, places, indexing="ij"))
    inside = np.hypot(x, y) < 1
    x, y = x[inside], y[inside]
    here, before, two = (wheel_on_rail.displacements(x[:, None] - x - m * h, y[:, None] - y, h)[1:] for m in range(3))
    xx, yy, xy = (1.5 * here - 2 * before + 0.5 * two) / h
    T = np.linalg.solve(np.block([[xx, xy], [xy, yy]]), -np.kron(np.eye(2), np.ones((len(x), 1))))
    (along, _), (_, across) = (part.sum(axis=0) for part in np.split(T, 2))
    moment = x @ T[len(x):, 1] - y @ T[:len(x), 1]
    area = h * h * len(x) / np.pi
    return h * h * np.array([-along / area, -across / area, np.abs(moment) / area**1.5])


def main():
    print("nu, cells on the radius, C11, C22, C23; last: extrapolated")
    for nu in map(float, sys.argv[1:] or (0, 0.25, 0.3, 0.5)):
        coarse, fine = coefficients(nu, 12), coefficients(nu, 24)
        for name, values in ((12, coarse), (24, fine), ("all", 2 * fine - coarse)):
            print(f"{nu:5} {name:>4}  " + " ".join(f"{value:.3f}" for value in values))


if __name__ == "__main__":
    main()
