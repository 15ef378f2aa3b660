"""Geometry behind the figures of bodies in space, on a distorted block with known area and volume.

usage: check_space.py FOLDER_OF_THE_PLOTS
"""

import sys
import types

import numpy as np

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
from figures import curves, space  # noqa: E402

N = (4, 3, 2)


def block():
    """Hexahedra of [-1, 1] x [0, 1] x [-1, 0], distorted inside and along the faces."""
    axes = [np.linspace(low, low + size, n + 1) for n, low, size in zip(N, (-1, 0, -1), (2, 1, 1))]
    x, y, z = (grid.ravel(order="F") for grid in np.meshgrid(*axes, indexing="ij"))
    swell = np.sin(np.pi * x) * np.sin(np.pi * y)
    x = x + 0.1 * np.sin(np.pi * x) * np.cos(3 * y)
    y = y + 0.1 * np.sin(np.pi * y) * np.cos(3 * z)
    z = z + 0.1 * np.sin(np.pi * z) * swell
    number = np.arange(len(x)).reshape([n + 1 for n in N], order="F")
    corner = [number[i:i + N[0], j:j + N[1], k:k + N[2]].ravel(order="F")
              for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return np.stack([x, y, z], axis=1), np.stack(corner, axis=1), number[:, :, -1].ravel()


def result(points, cells, top, field=None, bodies=None):
    """As much of a result as the functions want; the pressure is linear. `bodies`: by node, of
    two that meet, where the second has other pressures."""
    x, y, z = points[top].T
    columns = {"node": top, "x": x, "y": y, "z": z, "pressure": 2 * x + 3 * y + 1}
    if bodies is not None:
        columns["pressure"] = np.where(bodies[top] == 0, columns["pressure"], 1e3)
    table = np.rec.fromarrays(list(columns.values()), names=list(columns))
    zero = np.zeros_like(points)
    return types.SimpleNamespace(points=points, cells=cells, dim=3, times=np.zeros(1),
                                 contact=lambda _: table, has_pairs=bodies is not None,
                                 bodies=bodies, names_of_bodies={0: "block", len(points) // 2: "lid"},
                                 field=lambda _, name: (field or {}).get(name, zero))


points, cells, top = block()
body = result(points, cells, top)

faces, owners = space.boundary_faces(cells)
assert len(faces) == 2 * (N[0] * N[1] + N[1] * N[2] + N[2] * N[0])
assert all(set(face) <= set(cells[owner]) for face, owner in zip(faces, owners))
corners = points[faces]
areas = space.normals(corners) / 2
assert np.allclose(areas.sum(axis=0), 0), "the boundary is closed"
outer = corners.mean(axis=1) - [0, 0.5, -0.5]
assert (np.einsum("ij,ij->i", outer, areas) > 0).all(), "normals point outwards"

on_top = space.contact_faces(body)
assert len(on_top) == N[0] * N[1] and (points[top[on_top], 2] == 0).all()

view = space.View(body)
assert np.allclose(view.screen.T @ view.screen, np.eye(2))
assert np.allclose(view.eye @ view.screen, 0)
assert view.eye[2] > 0 and view.screen[0, 0] > 0 and view.screen[2, 1] > 0
seen, cells_seen, light = view.polygons(points)
turn = seen - seen.mean(axis=1, keepdims=True)
after = np.roll(turn, -1, axis=1)
winding = (turn[..., 0] * after[..., 1] - turn[..., 1] * after[..., 0]).sum(axis=1)
assert (winding > 0).all() and (light > 0).all() and (light <= 1).all()
assert len(seen) == len(cells_seen) == len(faces) // 2, "three of six sides are seen"

flipped = result(points * [1, 1, -1], cells[:, [4, 5, 6, 7, 0, 1, 2, 3]], top)
assert space.View(flipped).eye[2] < 0, "a surface that faces down is seen from below"

assert space.is_half(body)
for y in (0.1, -0.5):
    assert not space.is_half(result(points + [0, y, 0], cells, top)), "not at the plane"
for name in ("shape", "displacement"):
    assert not space.is_half(result(points, cells, top, {name: np.full_like(points, 0.1)}))

for shift in (0.0, 0.07):  # the plane x = 0 through nodes, and between them
    for curve, across in zip(curves.of(result(points + [shift, 0, 0], cells, top)), "yx"):
        line = curve.at(0)
        assert np.abs(line[across]).max() < 1e-12
        assert (np.diff(line[curve.axis]) > 0).all()
        assert np.allclose(line["pressure"], 2 * line["x"] + 3 * line["y"] + 1), "linear is exact"
        assert np.ptp(line[curve.axis]) > 0.99 * (2 if curve.axis == "x" else 1)

# Of two bodies that meet, one surface is cut and mapped.
second = len(points)
pair = result(np.concatenate([points, points * [1, 1, -1]]),
              np.concatenate([cells, second + cells[:, [4, 5, 6, 7, 0, 1, 2, 3]]]),
              np.concatenate([top, second + top]), bodies=np.repeat([0, second], second))
assert (space.contact_faces(pair) == on_top).all()
assert (space.contact_faces(pair, second) == len(top) + space.contact_faces(flipped)).all()
for curve, single in zip(curves.of(pair), curves.of(body)):
    assert np.allclose(curve.at(0)["pressure"], single.at(0)["pressure"])
    assert curve.where.endswith(", on block"), curve.where
