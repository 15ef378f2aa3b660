"""Opens the sidecar of a result of tests/results/readers_test.cpp as ParaView's File > Open does,
warps it, and checks times, fields and shapes.

usage: pvpython check_with_paraview.py RESULT.xdmf TIME...
"""

import sys

import numpy as np
from paraview import simple
from paraview.servermanager import Fetch
from vtk.util.numpy_support import vtk_to_numpy


def leaves(data):
    if not data.IsA("vtkMultiBlockDataSet"):
        return [data]
    blocks = [data.GetBlock(k) for k in range(data.GetNumberOfBlocks())]
    return [leaf for block in blocks if block is not None for leaf in leaves(block)]


def grids_of(source, t):
    """The body, which has fields, and the counter-body beside it, which has none."""
    source.UpdatePipeline(t)
    found = leaves(Fetch(source))
    assert len(found) == 2, len(found)
    return sorted(found, key=lambda grid: -grid.GetPointData().GetNumberOfArrays())


def grid_of(source, t):
    return grids_of(source, t)[0]


def points_of(source, t):
    return vtk_to_numpy(grid_of(source, t).GetPoints().GetData())


path, times = sys.argv[1], [float(t) for t in sys.argv[2:]]
for make in (simple.XDMFReader, simple.Xdmf3ReaderS, simple.Xdmf3ReaderT):
    try:
        reader = make(FileNames=[path])
    except AttributeError:
        reader = make(FileName=[path])
    reader.UpdatePipelineInformation()
    found = reader.TimestepValues
    found = [found] if isinstance(found, float) else list(found)
    assert found == times, (make, found)
    for t in times:
        grid = grid_of(reader, t)
        nodes, cells = grid.GetNumberOfPoints(), grid.GetNumberOfCells()
        pressure = vtk_to_numpy(grid.GetPointData().GetArray("pressure"))
        assert np.array_equal(pressure, np.arange(nodes) + t), make
        stress = vtk_to_numpy(grid.GetCellData().GetArray("equivalent_stress"))
        assert np.array_equal(stress, np.arange(cells) * t), make
        initial = points_of(reader, t)
        counter = vtk_to_numpy(grids_of(reader, t)[1].GetPoints().GetData())
        assert np.allclose(counter[:, 1], -np.floor(t)), make
        worn = simple.WarpByVector(Input=reader, Vectors=["POINTS", "shape"])
        rise = points_of(worn, t) - initial
        wear = t * np.maximum(0, 1 - (initial[:, 0] / 5) ** 2)
        assert np.allclose(rise[:, 1], wear, atol=1e-5), make  # ParaView's points are single
        deformed = simple.WarpByVector(Input=worn, Vectors=["POINTS", "displacement"])
        shift = points_of(deformed, t) - points_of(worn, t)
        assert np.allclose(shift[:, 0], t, atol=1e-5), make
        assert np.allclose(shift[:, 1], np.arange(nodes), atol=1e-4), make
    print(make.__name__ if hasattr(make, "__name__") else make, "agrees")
