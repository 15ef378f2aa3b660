#!/usr/bin/env python3
"""What elements cost: Hertz's cylinder with quadrilaterals, subdivided triangles and linear
triangles.

A small linear finite element code of its own (SciPy), because gnomon has no linear triangles. A
rigid cylinder presses a block as in problems/worn_body/hertz_cylinder.toml; contact at nodes,
each with the length around it, as in gnomon. The volume change of an element is that of each
point (plain) or the mean over a patch of elements (F-bar; for small strains both F-bar forms of
gnomon, and the patches of de Souza Neto, Andrade Pires and Owen, 2005, are this)."""

import math
import pathlib
import tempfile

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import splu

from program import SCENES, gnomon, percent, table

YOUNG, RADIUS, SIZE, ZONE = 210e3, 100.0, 10.0, 0.4


def lines(h, growth):
    """0 to SIZE: equal steps of about h in the zone, growing ones after it."""
    x = list(np.linspace(0, ZONE, round(ZONE / h) + 1))
    step = h
    while x[-1] + step < SIZE:
        step *= growth
        x.append(x[-1] + step)
    x[-1] = SIZE
    return np.array(x)


def grid(h, growth):
    """Nodes of a structured mesh and its quadrilaterals."""
    half = lines(h, growth)
    x, y = np.concatenate([-half[:0:-1], half]), -half[::-1]
    nodes = np.array([(a, b) for b in y for a in x])
    m = len(x)
    quads = np.array([(i + m * j, i + 1 + m * j, i + 1 + m * (j + 1), i + m * (j + 1))
                      for j in range(len(y) - 1) for i in range(m - 1)])
    return nodes, quads


def from_gmsh(fine, kind):
    """Nodes, and the "triangles" or "quadrilaterals", of the block of hertz_cylinder.geo with
    facets of this length."""
    text = (SCENES / "hertz_cylinder.geo").read_text()
    text = text.replace("fine = 0.02; coarse = 1.5;", f"fine = {fine}; coarse = {75 * fine};")
    if kind == "triangles":
        text = text.replace("Recombine Surface {1};", "")
    with tempfile.TemporaryDirectory() as folder:
        geometry, mesh = pathlib.Path(folder) / "block.geo", pathlib.Path(folder) / "block.msh"
        geometry.write_text(f'{text}\nMesh 2; Mesh.MshFileVersion = 2.2; Save "{mesh}";\n')
        gnomon("mesh", geometry)
        words = [line.split() for line in mesh.read_text().splitlines()]
    start = words.index(["$Nodes"])
    nodes = np.array(words[start + 2:start + 2 + int(words[start + 1][0])], float)[:, 1:3]
    cells = [tuple(int(word) - 1 for word in line[3 + int(line[2]):])
             for line in words[words.index(["$Elements"]) + 2:-1]
             if line[1] == ("2" if kind == "triangles" else "3")]
    cells = np.array(cells)
    a, b, c = (nodes[cells[:, k]] for k in range(3))
    turned = np.cross(b - a, c - a) < 0
    cells[turned] = cells[turned][:, ::-1]
    return nodes, cells


def subdivided(nodes, triangles):
    """Three quadrilaterals from each triangle."""
    points, middles, quads = list(nodes), {}, []

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            middles[key] = len(points)
            points.append((nodes[a] + nodes[b]) / 2)
        return middles[key]
    for t in triangles:
        centre = len(points)
        points.append(nodes[t].mean(axis=0))
        for k in range(3):
            quads.append((t[k], middle(t[k], t[(k + 1) % 3]), centre, middle(t[k], t[k - 1])))
    return np.array(points), np.array(quads)


def halves(quads):
    """Two triangles from each quadrilateral, their diagonals like a Union Jack; the patches are
    the quadrilaterals."""
    triangles = [((q[0], q[1], q[2]), (q[0], q[2], q[3])) if (e + e // 2) % 2 else
                 ((q[0], q[1], q[3]), (q[1], q[2], q[3])) for e, q in enumerate(quads)]
    return np.array(triangles).reshape(-1, 3), np.repeat(np.arange(len(quads)), 2)


def pairs(triangles):
    """Patches of two neighbours, greedily; what is left joins the patch of a neighbour."""
    owners = {}
    for e, t in enumerate(triangles):
        for k in range(3):
            owners.setdefault(frozenset((t[k], t[(k + 1) % 3])), []).append(e)
    neighbours = [[] for _ in triangles]
    for both in owners.values():
        if len(both) == 2:
            neighbours[both[0]].append(both[1])
            neighbours[both[1]].append(both[0])
    patch, count = np.full(len(triangles), -1), 0
    for e in sorted(range(len(triangles)), key=lambda e: len(neighbours[e])):
        if patch[e] >= 0:
            continue
        free = [n for n in neighbours[e] if patch[n] < 0]
        if free:
            patch[e] = patch[free[0]] = count
            count += 1
        else:
            patch[e] = patch[neighbours[e][0]]
    return patch


def gradients(x, xi):
    """Weight and gradients of the shape functions at a point of a cell with corners x."""
    if len(x) == 3:
        dN, weight = np.array([[-1, -1], [1, 0], [0, 1]]), 0.5
    else:
        a, b = xi
        dN = np.array([[b - 1, a - 1], [1 - b, -1 - a], [1 + b, 1 + a], [-1 - b, 1 - a]]) / 4
        weight = 1.0
    J = x.T @ dN
    return weight * np.linalg.det(J), dN @ np.linalg.inv(J)


POINTS = [(a / math.sqrt(3), b / math.sqrt(3)) for a in (-1, 1) for b in (-1, 1)]


def stiffness(nodes, cells, poisson, patch=None):
    """With `patch`, the number of each cell's patch, the volume change is the mean of the patch."""
    shear = YOUNG / (2 * (1 + poisson))
    bulk = YOUNG * poisson / ((1 + poisson) * (1 - 2 * poisson)) + 2 * shear / 3
    rows, columns, values, volumes = [], [], [], {}
    deviatoric = np.array([[4 / 3, -2 / 3, 0], [-2 / 3, 4 / 3, 0], [0, 0, 1]]) * shear
    for e, cell in enumerate(cells):
        at = (2 * cell[:, None] + [0, 1]).ravel()
        K = np.zeros((len(at), len(at)))
        for xi in POINTS if len(cell) == 4 else [(0, 0)]:
            w, g = gradients(nodes[cell], xi)
            B = np.zeros((3, len(at)))
            B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = g[:, 0], g[:, 1], g[:, 1], g[:, 0]
            K += w * B.T @ deviatoric @ B
            if patch is None:
                K += w * bulk * np.outer(g.ravel(), g.ravel())
            else:
                area, sums = volumes.setdefault(patch[e], [0, {}])
                volumes[patch[e]][0] = area + w
                for i, value in zip(at, w * g.ravel()):
                    sums[i] = sums.get(i, 0) + value
        rows.append(np.repeat(at, len(at)))
        columns.append(np.tile(at, len(at)))
        values.append(K.ravel())
    for area, sums in volumes.values():
        at, b = np.array(list(sums)), np.array(list(sums.values()))
        rows.append(np.repeat(at, len(at)))
        columns.append(np.tile(at, len(at)))
        values.append((bulk / area * np.outer(b, b)).ravel())
    size = 2 * len(nodes)
    places = (np.concatenate(rows), np.concatenate(columns))
    return sparse.csc_matrix((np.concatenate(values), places), (size, size))


class Surface:
    """The nodes on top that may touch, and how they move under forces on them."""

    def __init__(self, nodes, K):
        free = np.flatnonzero(np.repeat(nodes[:, 1] > -SIZE + 1e-9, 2))
        top = np.flatnonzero(np.abs(nodes[:, 1]) < 1e-9)
        top = top[np.argsort(nodes[top, 0])]
        near = np.abs(nodes[top, 0]) < ZONE + 1e-9
        self.x, self.length = nodes[top, 0][near], np.gradient(nodes[top, 0])[near]
        place = np.searchsorted(free, 2 * top[near] + 1)
        load = np.zeros((len(free), len(place)))
        load[place, np.arange(len(place))] = 1
        self.compliance = splu(K[free][:, free]).solve(load)[place]

    def contact(self, load):
        """Pressures at the nodes, and the approach."""
        x, active = self.x, np.abs(self.x) < ZONE / 2
        while True:
            on = np.flatnonzero(active)
            A = np.zeros((len(on) + 1, len(on) + 1))
            A[:-1, :-1], A[:-1, -1], A[-1, :-1] = self.compliance[np.ix_(on, on)], -1, 1
            solution = np.linalg.solve(A, np.append(-x[on] ** 2 / (2 * RADIUS), load))
            force = np.zeros(len(x))
            force[on] = solution[:-1]
            gap = x**2 / (2 * RADIUS) + self.compliance @ force - solution[-1]
            settled = np.where(active, force > 0, gap < 0)
            if (settled == active).all():
                return force / self.length, solution[-1]
            active = settled


def mean_square(values):
    return math.sqrt(np.mean(np.square(values)))


def errors(nodes, K, poisson):
    """Root mean squares over contacts that end at eight places within a facet or two: of the
    pressure, all and inside of 0.8 a, over p0; of the half width by the second moment. And
    the approach at a = 0.25 mm."""
    surface, found = Surface(nodes, K), []
    modulus = YOUNG / (1 - poisson**2)
    x, length = surface.x, surface.length
    for a in np.linspace(0.23, 0.27, 8, endpoint=False) + 0.0025:
        load = math.pi * modulus * a * a / (4 * RADIUS)
        p0 = 2 * load / (math.pi * a)
        p, _ = surface.contact(load)
        wrong = (p / p0 - np.sqrt(np.maximum(0, 1 - (x / a) ** 2))) ** 2 * length
        zones = (np.abs(x) < 1.2 * a, np.abs(x) < 0.8 * a)
        rms = [math.sqrt(wrong[at].sum() / length[at].sum()) for at in zones]
        found.append([*rms, math.sqrt(4 * np.sum(length * p * x**2) / np.sum(length * p)) / a - 1])
    approach = surface.contact(math.pi * modulus * 0.25**2 / (4 * RADIUS))[1]
    return [*map(mean_square, np.array(found).T), approach]


def variants(h, growth):
    """(name, nodes, cells, patch) of about as many nodes, structured ones and those of Gmsh."""
    nodes, quads = grid(h, growth)
    yield "structured quadrilaterals, F-bar", nodes, quads, np.arange(len(quads))
    triangles, patch = halves(quads)
    yield "their halves, plain", nodes, triangles, None
    yield "their halves, F-bar patches of 2", nodes, triangles, patch
    nodes, quads = from_gmsh(h / 2, "quadrilaterals")
    yield "Gmsh's quadrilaterals, F-bar", nodes, quads, np.arange(len(quads))
    nodes, quads = subdivided(*from_gmsh(1.35 * h, "triangles"))  # six nodes for each one before
    yield "Gmsh's triangles, subdivided, F-bar", nodes, quads, np.arange(len(quads))
    nodes, triangles = from_gmsh(h / 2, "triangles")
    yield "Gmsh's triangles, plain", nodes, triangles, None
    yield "Gmsh's triangles, F-bar patches of 2", nodes, triangles, pairs(triangles)


def main():
    for poisson in (0.3, 0.45, 0.499):
        fine, quads = grid(0.01, 1.08)
        exact = errors(fine, stiffness(fine, quads, poisson, np.arange(len(quads))), poisson)[-1]
        print(f"nu = {poisson}\n")
        rows = []
        for h, growth in ((0.04, 1.3), (0.02, 1.15)):
            for name, nodes, cells, patch in variants(h, growth):
                *rms, approach = errors(nodes, stiffness(nodes, cells, poisson, patch), poisson)
                rows.append([name, len(nodes), *(f"{100 * r:.2f} %" for r in rms),
                             percent(approach / exact)])
        table(["element", "nodes", "pressure", "inside of 0.8 a", "half width", "approach"], rows)


if __name__ == "__main__":
    main()
