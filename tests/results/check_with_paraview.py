"""Opens the sidecar of a result of tests/results/readers_test.cpp as ParaView's File > Open does,
warps it, and checks times, fields and shapes.

usage: pvpython check_with_paraview.py RESULT.xdmf TIME...
"""

import sys

import numpy as np
from paraview import simple
from paraview.servermanager import Fetch
from vtk.util.numpy_support import vtk_to_numpy


def grid_of(source, t):
    source.UpdatePipeline(t)
    data = Fetch(source)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return data


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
        worn = simple.WarpByVector(Input=reader, Vectors=["POINTS", "shape"])
        rise = points_of(worn, t) - initial
        wear = t * np.maximum(0, 1 - (initial[:, 0] / 5) ** 2)
        assert np.allclose(rise[:, 1], wear, atol=1e-5), make  # ParaView's points are single
        deformed = simple.WarpByVector(Input=worn, Vectors=["POINTS", "displacement"])
        shift = points_of(deformed, t) - points_of(worn, t)
        assert np.allclose(shift[:, 0], t, atol=1e-5), make
        assert np.allclose(shift[:, 1], np.arange(nodes), atol=1e-4), make
    print(make.__name__ if hasattr(make, "__name__") else make, "agrees")
