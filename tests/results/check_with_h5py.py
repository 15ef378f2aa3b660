"""Reads a result of tests/results/readers_test.cpp with h5py and checks what synthetic.hpp put there.

usage: check_with_h5py.py RESULT.h5 TIME...
"""

import sys

import h5py
import numpy as np

path, times = sys.argv[1], [float(t) for t in sys.argv[2:]]
with h5py.File(path, "r") as file:
    root = file["gnomon"]
    assert root.attrs["format"] == b"gnomon result"
    assert root.attrs["problem"] == b"pin_on_flat"
    assert root.attrs["status"] == b"running or crashed"
    assert root["scene"].asstr()[()].startswith('problem = "pin_on_flat"')
    assert dict(root["versions"].attrs)["SUNDIALS"] == b"6.4.1"
    assert root["blocks"]["name"].tolist() == [b"displacement", b"shape"]
    assert root["blocks"]["size"].tolist() == [40, 38]

    history = root["history"]
    units = dict(zip(history.dtype.names, history.attrs["units"]))
    assert units["worn_volume"] == b"mm^2", units
    assert np.array_equal(history["t"], 0.25 * np.arange(5))
    assert np.array_equal(history["worn_volume"], 0.5 * np.arange(5))
    assert np.array_equal(history["linear_solves"], 6 * np.arange(5))
    assert np.array_equal(history["krylov_iterations"], 7 * np.arange(5))
    assert np.array_equal(history["preconditioner_setups"], 2 * np.arange(5))

    points = file["mesh/points"][:]
    cells = file["mesh/cells"][:]
    stored = root["stored"][:]
    assert np.array_equal(stored["t"], times), stored
    for t, path in stored:
        step = file[path.decode()]
        assert step.attrs["t"] == t
        displacement = step["displacement"][:]
        assert displacement.shape == points.shape
        assert np.all(displacement[:, 0] == t) and np.all(displacement[:, 2] == 0)
        assert np.array_equal(displacement[:, 1], np.arange(len(points)))
        assert np.array_equal(step["pressure"], np.arange(len(points)) + t)
        assert step["pressure"].attrs["unit"] == b"MPa"
        assert step["pressure"].attrs["on"] == b"nodes"
        assert np.array_equal(step["equivalent_stress"], np.arange(len(cells)) * t)
        contact = root["contact"][path.decode().removeprefix("steps/")][:]
        assert np.array_equal(contact["pressure"], 10 * np.arange(5) + t)
        assert np.array_equal(contact["X0"], np.arange(5)) and np.all(contact["Y"] == t)
        assert np.all(contact["y"] == t - 1) and contact["active"].tolist() == [1, 1, 1, 0, 0]
