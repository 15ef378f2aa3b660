#!/usr/bin/python3
"""The pin's contact at the initial shape by GetFEM (docs/notes/validation.md): nodal pressures and
displacements of another program, on the same mesh with the same bilinear elements and material.

Debian: python3-getfem python3-h5py python3-scipy"""

import pathlib
import sys
import tempfile

import h5py
import numpy as np

from program import ROOT, gnomon, table

sys.path.insert(0, str(ROOT / "benchmarks" / "peers"))
from getfem_pin import Contact  # noqa: E402
from pin import SCENE, Pin, Surface  # noqa: E402


def start(elements, result):
    """Of gnomon: the pin, nodal pressures in the order of x, and displacements at t = 0."""
    settings = [f"mesh.elements=[{elements}, {elements}]", "body.element=plain",
                "integrator.name=backward-euler", "integrator.step=1e-6", "time.end=1e-6"]
    words = [word for setting in settings for word in ("--set", setting)]
    gnomon("run", SCENE, *words, "-o", result)
    with h5py.File(result) as file:
        path = file["gnomon/stored"][0]["path"].decode()
        rows = np.sort(file["gnomon/contact"][path.removeprefix("steps/")][:], order="X0")
        displacement = file[path]["displacement"][:, :2]
        return Pin(file["mesh/points"][:, :2], file["mesh/cells"][:]), rows["pressure"], displacement


def main():
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for elements in (10, 20, 40, 80):
            pin, pressure, displacement = start(elements, pathlib.Path(folder, f"{elements}.h5"))
            contact = Contact(pin, tolerance=1e-11)
            other = contact.solve(pin.points) / Surface(pin).areas(pin.points)
            of_u = np.abs(contact.displacement() - displacement).max() / np.abs(displacement).max()
            of_p = np.abs(other - pressure).max() / pressure.max()
            rows.append([f"{elements}x{elements}", int((pressure > 0).sum()),
                         f"{pressure.max():.10f}", f"{of_p:.0e}", f"{of_u:.0e}"])
    table(["elements", "nodes in contact", "largest pressure [MPa]", "pressures", "displacements"],
          rows)


if __name__ == "__main__":
    main()
