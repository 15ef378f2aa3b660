#!/usr/bin/env python3
"""Makes cam_profile.csv, the profile of the cam of cam.toml: python3 cam_profile.py > cam_profile.csv

A flat follower that rests on a cam stands at the height h of the tangent above the axis. As a function of the angle psi
between this tangent's normal and the nose of the cam it is called the support function of the profile. Here

    h(psi) = base + lift ((1 + cos psi)/2)^2,

smooth, highest at the nose (psi = 0) and flat opposite to it. The point where the tangent touches is h n + h' t, n and t
normal and tangent; the radius of curvature there, h + h'', must be positive. The nose is up, along y.
"""
from math import cos, pi, sin

BASE, LIFT, POINTS = 12.0, 2.0, 180  # mm, mm


def height(psi):
    return BASE + LIFT * ((1 + cos(psi)) / 2) ** 2


def slope(psi):
    return -LIFT * (1 + cos(psi)) / 2 * sin(psi)


def point(psi):
    h, dh = height(psi), slope(psi)
    return -h * sin(psi) - dh * cos(psi), h * cos(psi) - dh * sin(psi)


print("# x, y [mm] of a cam with the nose along y, anticlockwise: made by cam_profile.py")
for i in range(POINTS):
    print("%.10f, %.10f" % point(2 * pi * i / POINTS))
