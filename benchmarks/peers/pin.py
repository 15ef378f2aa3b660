"""What the peers of gnomon share: the pin's scene, its mesh, the wear of its surface by forward Euler
and the motion of the mesh behind it. No finite element program is needed here."""

import argparse
import pathlib
import tomllib

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = ROOT / "problems" / "pin_on_flat" / "small_deformation.toml"


class Pin:
    """Scene and mesh: points (N x 2, mm), cells (M x 4, anticlockwise), contact (nodes in the order
    of x), left, right and top (nodes)."""

    def __init__(self, points, cells):
        self.points, self.cells = points, cells
        scene = tomllib.loads(SCENE.read_text())
        self.modulus = scene["body"]["young_modulus"]
        self.poisson = scene["body"]["poisson_ratio"]
        self.force = scene["load"]["force"]
        self.width, self.height = scene["pin"]["width"], scene["pin"]["height"]
        self.wear = scene["wear"]["coefficient"] * scene["wear"]["velocity"]  # mm/(s MPa)
        self.end = scene["time"]["end"]
        x, y = points.T
        bottom = x**2 / (2 * scene["pin"]["radius"])
        self.left, self.right, self.top, self.contact = (
            np.flatnonzero(np.abs(distance) < 1e-9) for distance in
            (x + self.width / 2, x - self.width / 2, y - self.height, y - bottom))
        self.contact = self.contact[np.argsort(x[self.contact])]

    @classmethod
    def load(cls, file):
        """From what save_mesh has written."""
        data = np.load(file)
        return cls(data["points"], data["cells"])

    def lame(self):
        """lambda and mu, MPa."""
        mu = self.modulus / (2 * (1 + self.poisson))
        return 2 * mu * self.poisson / (1 - 2 * self.poisson), mu

    def facets(self, points):
        """Halves of the facets turned outwards (S of docs/equations.md), one row a facet."""
        edges = np.diff(points[self.contact], axis=0)
        return 0.5 * np.column_stack([edges[:, 1], -edges[:, 0]])


def save_mesh(file, points, cells):
    np.savez(file, points=points, cells=cells)


def of_both_ends(facets):
    """Sums of facet values at the nodes, first and last node included."""
    zero = np.zeros_like(facets[:1])
    return np.concatenate([facets, zero]) + np.concatenate([zero, facets])


class Surface:
    """Areas and normals of the contact nodes as gnomon has them: eq. (35) of the paper."""

    def __init__(self, pin):
        self.pin = pin
        self.initial = np.linalg.norm(pin.facets(pin.points), axis=1)

    def areas(self, points):
        return of_both_ends(np.linalg.norm(self.pin.facets(points), axis=1))

    def normals(self, points):
        halves = self.pin.facets(points)
        unit = halves / np.linalg.norm(halves, axis=1)[:, None]
        return of_both_ends(unit * self.initial[:, None]) / of_both_ends(self.initial)[:, None]


class MeshMotion:
    """Displacement of all nodes for that of the contact nodes: a linear elastic body of the initial
    shape, factorized once. The top is held, the sides slide."""

    def __init__(self, pin):
        count = len(pin.points)
        stiffness = plane_strain_stiffness(pin)
        self.given = np.concatenate([2 * pin.contact, 2 * pin.contact + 1])
        held = [2 * pin.left, 2 * pin.right, 2 * pin.top, 2 * pin.top + 1]
        fixed = np.union1d(np.concatenate(held), self.given)
        self.free = np.setdiff1d(np.arange(2 * count), fixed)
        self.coupling = stiffness[self.free][:, self.given]
        self.factors = sparse.linalg.splu(stiffness[self.free][:, self.free].tocsc())
        self.shape = (count, 2)

    def __call__(self, surface):
        """surface: displacement of the contact nodes, n x 2; returns that of all nodes."""
        result = np.zeros(self.shape[0] * 2)
        result[self.given] = surface.T.ravel()
        result[self.free] = -self.factors.solve(self.coupling @ result[self.given])
        return result.reshape(self.shape)


def plane_strain_stiffness(pin):
    """Bilinear elements with 2 x 2 Gauss points, E = 1, as a sparse matrix of 2N rows."""
    nu = pin.poisson
    mu = 1 / (2 * (1 + nu))
    lame = 2 * mu * nu / (1 - 2 * nu)
    corners = pin.points[pin.cells]  # M x 4 x 2
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    blocks = np.zeros((len(pin.cells), 4, 2, 4, 2))
    for xi in np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / np.sqrt(3):
        slopes = 0.25 * signs * (1 + signs[:, ::-1] * xi[::-1])  # dN_a/dxi_k
        jacobian = np.einsum("mai,ak->mik", corners, slopes)
        n = np.einsum("ak,mki->mai", slopes, np.linalg.inv(jacobian))
        weight = np.linalg.det(jacobian)
        same = np.eye(2)
        blocks += mu * np.einsum("m,mak,mbk,ij->maibj", weight, n, n, same, optimize=True)
        blocks += lame * np.einsum("m,mai,mbj->maibj", weight, n, n)
        blocks += mu * np.einsum("m,maj,mbi->maibj", weight, n, n)
    unknowns = (2 * pin.cells[:, :, None] + np.arange(2)).reshape(-1, 8)
    rows = np.repeat(unknowns, 8, axis=1).ravel()
    columns = np.tile(unknowns, (1, 8)).ravel()
    size = 2 * len(pin.points)
    return sparse.coo_matrix((blocks.ravel(), (rows, columns)), (size, size)).tocsr()


def command_line(doc):
    """MESH.npz [--steps N] [-o RESULT.npz], of the programs that solve the contact."""
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("mesh")
    parser.add_argument("--steps", type=int, default=0)
    parser.add_argument("-o", "--output")
    return parser.parse_args()


def wear_loop(pin, solve, steps):
    """Worn positions of all nodes (mm) at the end: forward Euler with equal steps. solve(points)
    returns the forces on the contact nodes, N per mm of thickness."""
    surface, motion = Surface(pin), MeshMotion(pin)
    worn, points = np.zeros((len(pin.contact), 2)), pin.points
    for _ in range(steps):
        pressure = solve(points) / surface.areas(points)
        worn -= pin.end / steps * pin.wear * pressure[:, None] * surface.normals(points)
        worn[[0, -1], 0] = 0  # the ends slide along the sides
        points = pin.points + motion(worn)
    return points
