"""Reads what `gnomon mesh -o` has written of block_on_ring.geo: a block of 8 mm x 4 mm below y = 0.

usage: check_mesh_view.py FOLDER_OF_THE_PLOTS MESH.xdmf
"""

import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
from figures import groups  # noqa: E402

axes, body, parts = groups.read(sys.argv[2])
parts = {part.name: part for part in parts}
assert axes == ["x", "y"], axes
assert body.name == "body" and sorted(parts) == ["bottom", "surface"], parts
assert np.array_equal(np.unique(body.cells), np.arange(len(body.points)))
corner = body.points[body.cells][:, :, :2]
area = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1]) / 2
assert (area > 0).all() and np.isclose(area.sum(), 32)
for name, y, length, direction in (("bottom", -4, 8, 1), ("surface", 0, 3.2, -1)):
    part = parts[name]
    assert np.array_equal(np.unique(part.cells), np.arange(len(part.points))), "its own nodes alone"
    assert np.allclose(part.points[:, 1], y)
    along = part.points[part.cells[:, 1]] - part.points[part.cells[:, 0]]
    assert np.isclose(along[:, 0].sum(), direction * length), "the body is to the left"

# Labels of facets that are shorter than their names.
whole = parts["bottom"]
short = [groups.Part(f"a part with a long name, {k}", whole.points, whole.cells[k:k + 1]) for k in range(4)]
figure = groups.draw(body, short, ["r", "z"])
figure.draw_without_rendering()
assert [figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()] == ["$r$ [mm]", "$z$ [mm]"]
boxes = [label.get_window_extent() for label in figure.axes[0].texts]
assert len(boxes) == 4
assert not any(one.overlaps(other) for k, one in enumerate(boxes) for other in boxes[:k]), boxes
