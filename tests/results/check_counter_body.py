"""Follows the references of a sidecar of tests/results/readers_test.cpp to the counter-body.

usage: check_counter_body.py RESULT.xdmf TIME...
"""

import sys
import xml.etree.ElementTree as tree
from pathlib import Path

import h5py
import numpy as np

path, times = Path(sys.argv[1]), [float(t) for t in sys.argv[2:]]


def data(item):
    name, where = item.text.strip().split(":")
    with h5py.File(path.with_name(name)) as file:
        array = file[where][()]
    assert item.get("Dimensions") == " ".join(str(n) for n in array.shape), where
    return where, array


collections = tree.parse(path).getroot().findall("./Domain/Grid")
assert [grid.get("Name") for grid in collections] == ["counter_body", "steps"], collections
counter, body = (list(collection) for collection in collections)
assert len(counter) == len(body) == len(times)
places = []
for grid, beside, t in zip(counter, body, times):
    assert float(grid.find("Time").get("Value")) == t
    assert grid.find("Time").attrib == beside.find("Time").attrib
    topology = grid.find("Topology")
    assert topology.get("TopologyType") == "Polyline" and topology.get("NodesPerElement") == "2"
    _, facets = data(topology.find("DataItem"))
    place, points = data(grid.find("Geometry/DataItem"))
    assert int(topology.get("NumberOfElements")) == len(facets) == 2
    assert np.array_equal(facets, [[0, 1], [1, 2]])
    assert np.array_equal(points[:, 1], np.full(3, -np.floor(t))), points
    places.append(place)
assert places[0] == places[1] != places[2], "only what has moved is stored again"
