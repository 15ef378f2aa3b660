#!/usr/bin/env python3
"""A press fit under reversed bending: Lame's pressure, the depth of wear by Archard's law, and the figure of the
tutorial.

python3 press_fit_bending.py RESULT.h5 [FIGURE.png]"""

import sys

import h5py
import numpy as np

E, NU, FRICTION, K = 210e3, 0.3, 0.3, 1e-8
RADIUS, INTERFERENCE, OUTER, INNER, CYCLES = 10.0, 0.01, 20.0, 3.0, 1e4


def lame():
    """The pressure of a hollow shaft in a long hub."""
    hub = (OUTER**2 + RADIUS**2) / (OUTER**2 - RADIUS**2) + NU
    shaft = (RADIUS**2 + INNER**2) / (RADIUS**2 - INNER**2) - NU
    return INTERFERENCE * E / RADIUS / (hub + shaft)


def along_the_top(file):
    """Nodes of the shaft where it bends most: z, pressures, axial tractions and slips by phase, depth at the end."""
    contact = file["gnomon/contact/0000"]
    start, end = (contact[name][:] for name in (min(contact), max(contact)))
    at = np.abs(start["X0"] - RADIUS - INTERFERENCE) < 1e-6
    at = np.flatnonzero(at)[np.argsort(start["Z0"][at])]
    first = {name: file[f"gnomon/phase_{name}/0000"][min(contact)][:] for name in ("pressure", "traction", "slip")}
    return (start["Z0"][at], first["pressure"][:, at], first["traction"][:, at, 2], first["slip"][:, at, 2],
            end["wear_depth"][at])


def draw(path, z, pressure, traction, slip):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    for phase, colour, name in ((0, "C0", "bent to one side"), (2, "C3", "bent to the other")):
        left.plot(z, traction[phase], colour, marker=".", label=name)
        for sign in (1, -1):
            left.plot(z, sign * FRICTION * pressure[phase], colour, linestyle=":", linewidth=1)
        right.plot(z, 1e3 * slip[phase], colour, marker=".", label=name)
    left.set(xlabel="z [mm]", ylabel="traction of friction [MPa]", ylim=(-60, 60))
    right.set(xlabel="z [mm]", ylabel="slip since the phase before [um]", xlim=(0, 12))
    left.legend(frameon=False)
    for axes in (left, right):
        axes.grid(alpha=0.3)
    figure.savefig(path, dpi=120)


def main():
    with h5py.File(sys.argv[1]) as file:
        z, pressure, traction, slip, depth = along_the_top(file)
    middle = np.argmin(np.abs(z))
    print(f"Lame: {lame():.1f} MPa, run: {pressure.mean(axis=0)[middle]:.1f} MPa in the middle")
    print("  z       pressures              axial tractions        slip of a cycle   depth    k p |slip| N")
    for i in np.flatnonzero(z > 0):
        mean = (pressure[:, i] + np.roll(pressure[:, i], 1)) / 2
        wear = K * CYCLES * (mean * np.abs(slip[:, i])).sum()
        print(f"{z[i]:6.2f}  {pressure[0, i]:6.1f} {pressure[2, i]:6.1f} MPa   {traction[0, i]:6.1f} "
              f"{traction[2, i]:6.1f} MPa   {1e3 * np.abs(slip[:, i]).sum():6.2f} um   {1e3 * depth[i]:7.4f} um"
              f"  {1e3 * wear:7.4f} um")
    if len(sys.argv) > 2:
        draw(sys.argv[2], z, pressure, traction, slip)


if __name__ == "__main__":
    main()
