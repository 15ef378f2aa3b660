#!/usr/bin/python3
"""The worn pin by CalculiX (Debian: calculix-ccx): one run of ccx for each contact solve, as loops of
wear around a program without wear are written.

    calculix_pin.py MESH.npz [--steps N] [-o RESULT.npz]

Without --steps: one contact solve of the initial shape. Plane strain is one layer of hexahedra, 1 mm
thick, that cannot move across; contact is node to face with a stiff linear overclosure."""

import pathlib
import re
import subprocess
import tempfile

import numpy as np

from pin import Pin, Surface, command_line, wear_loop

STIFFNESS = 1e5  # MPa/mm, of the contact: 3e-4 mm of overlap at 30 MPa
FIRST_OVERLAP = 1e-3  # mm, of the highest node that was in contact last


class Contact:
    def __init__(self, pin, folder):
        self.pin, self.folder = pin, pathlib.Path(folder)
        self.count = len(pin.points)
        lowest = np.argsort(pin.points[pin.contact, 1])[:3]
        self.touching = pin.contact[lowest]  # those of the last solve, or a guess
        self.deck = self.elements() + self.model()

    def nodes(self, points):
        """Two layers and, 8 nodes, the counter-body. The body begins with some overlap, because
        without contact nothing holds it. ccx reads no more than 20 characters of a number."""
        lines = ["*NODE, NSET=ALL"]
        for layer in (0, 1):
            lines += [f"{i},{x:.14f},{y:.14f},{layer}" for i, (x, y) in
                      enumerate(points, 1 + layer * self.count)]
        top = points[self.touching, 1].max() + FIRST_OVERLAP
        corners = [(-20, -1), (20, -1), (20, 2), (-20, 2)]
        for k, y in enumerate((top - 1, top)):
            lines += [f"{2 * self.count + 1 + 4 * k + i},{x},{y:.14f},{z}" for i, (x, z) in
                      enumerate(corners[::-1])]
        return "\n".join(lines) + "\n"

    def elements(self):
        lines = ["*ELEMENT, TYPE=C3D8, ELSET=PIN"]
        for i, cell in enumerate(self.pin.cells + 1, 1):
            lines.append(",".join(map(str, [i, *cell, *(cell + self.count)])))
        lines += ["*ELEMENT, TYPE=C3D8, ELSET=FLAT",
                  ",".join(map(str, [len(self.pin.cells) + 1, *self.flat_nodes()]))]
        return "\n".join(lines) + "\n"

    def flat_nodes(self):
        return [2 * self.count + 1 + i for i in range(8)]

    def both(self, nodes):
        return [str(n) for n in np.concatenate([nodes + 1, nodes + 1 + self.count])]

    def model(self):
        pin, count = self.pin, self.count
        mu = pin.lame()[1]
        bulk = pin.modulus / (3 * (1 - 2 * pin.poisson))
        at_bottom = np.isin(pin.cells, pin.contact)
        faces = []
        for cell in np.flatnonzero(at_bottom.sum(1) == 2):
            corner = next(k for k in range(4) if at_bottom[cell, k] and at_bottom[cell, (k + 1) % 4])
            faces.append(f"{cell + 1}, S{3 + corner}")
        weight = np.ones(len(pin.top))
        ends = np.isin(pin.top, np.concatenate([pin.left, pin.right]))
        weight[ends] = 0.5
        load = pin.force / 2 * weight / weight.sum()
        loads = [f"{n + 1 + layer * count},2,{-value:.15g}" for layer in (0, 1)
                 for n, value in zip(pin.top, load)]
        return "\n".join([
            "*NSET, NSET=SIDES", *self.both(np.union1d(pin.left, pin.right)),
            "*NSET, NSET=FIXED", *map(str, self.flat_nodes()),
            "*NSET, NSET=CONTACT", *map(str, pin.contact + 1),
            "*BOUNDARY", "ALL,3,3", "SIDES,1,1", "FIXED,1,3",
            "*SURFACE, NAME=BOTTOM, TYPE=ELEMENT", *faces,
            "*SURFACE, NAME=PLANE, TYPE=ELEMENT", f"{len(pin.cells) + 1}, S2",
            "*MATERIAL, NAME=ELASTIC", "*HYPERELASTIC, NEO HOOKE", f"{mu / 2:.15g},{2 / bulk:.15g}",
            "*SOLID SECTION, ELSET=PIN, MATERIAL=ELASTIC",
            "*SOLID SECTION, ELSET=FLAT, MATERIAL=ELASTIC",
            "*SURFACE INTERACTION, NAME=HARD",
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{STIFFNESS}",
            "*CONTACT PAIR, INTERACTION=HARD, TYPE=NODE TO SURFACE", "BOTTOM, PLANE",
            "*STEP, NLGEOM, INC=100", "*STATIC", "1.,1.",
            "*CLOAD", *loads,
            "*CONTACT PRINT", "CSTR",
            "*NODE PRINT, NSET=CONTACT", "U",
            "*END STEP"]) + "\n"

    def solve(self, points):
        """Forces on the contact nodes, upwards, N per mm of thickness, for a worn shape."""
        (self.folder / "pin.inp").write_text(self.nodes(points) + self.deck)
        done = subprocess.run(["ccx", "pin"], cwd=self.folder, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(done.stdout[-2000:])
        self.iterations = done.stdout.count(" iteration ")
        tables = tables_of((self.folder / "pin.dat").read_text())
        pressure, moved = np.zeros(len(points)), points.copy()
        for node, value, *_ in tables["contact stress"]:
            if node <= self.count:  # the first layer
                pressure[int(node) - 1] = max(value, 0)
        for node, x, y, _ in tables["displacements"]:
            moved[int(node) - 1] += x, y
        pressure = pressure[self.pin.contact]
        self.touching = self.pin.contact[pressure > 0]
        return pressure * Surface(self.pin).areas(moved)  # the pressure acts on the deformed surface


def tables_of(text):
    """{first words of the head: rows of numbers} of what ccx prints."""
    result = {}
    for line in text.splitlines():
        if head := re.match(r" *([a-z][a-z ]*[a-z])", line):
            rows = result.setdefault(head[1], [])
        elif line.strip():
            rows.append([float(word) for word in line.split()])
    return result


def main():
    options = command_line(__doc__)
    pin = Pin.load(options.mesh)
    with tempfile.TemporaryDirectory() as folder:
        contact = Contact(pin, folder)
        if options.steps:
            result = {"worn": wear_loop(pin, contact.solve, options.steps)[pin.contact]}
        else:
            pressure = contact.solve(pin.points) / Surface(pin).areas(pin.points)
            result = {"pressure": pressure}
    if options.output:
        np.savez(options.output, **result)


if __name__ == "__main__":
    main()
