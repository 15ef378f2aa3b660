"""Reads the sidecar of a result of tests/results/readers_test.cpp with meshio.

usage: check_with_meshio.py RESULT.xdmf CELL_TYPE TIME...
"""

import sys

import meshio
import numpy as np

path, cell_type, times = sys.argv[1], sys.argv[2], [float(t) for t in sys.argv[3:]]
with meshio.xdmf.TimeSeriesReader(path) as reader:
    assert reader.num_steps == len(times), reader.num_steps
    points, cells = reader.read_points_cells() if times else (None, None)
    for index, expected in enumerate(times):
        assert points.shape[1] == 3 and [block.type for block in cells] == [cell_type]
        t, point_data, cell_data = reader.read_data(index)
        assert t == expected, t
        assert sorted(point_data) == ["displacement", "pressure", "shape"]
        assert sorted(cell_data) == ["element_quality", "equivalent_stress"]
        nodes = np.arange(len(points))
        displacement = np.stack([np.full(len(points), t), nodes, 0 * nodes], axis=1)
        assert np.array_equal(point_data["displacement"], displacement)
        assert np.array_equal(point_data["pressure"], nodes + t)
        wear = t * np.maximum(0, 1 - (points[:, 0] / 5) ** 2)
        assert np.allclose(point_data["shape"][:, 1], wear, rtol=1e-14, atol=0)
        stress = cell_data["equivalent_stress"][0]
        assert np.array_equal(stress, np.arange(len(cells[0].data)) * t)
        assert np.all(cell_data["element_quality"][0] == 1)
