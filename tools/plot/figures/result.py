"""Reads a result file of gnomon: the layout is that of docs/results.md."""

import re
from contextlib import contextmanager
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import h5py
import numpy

from . import style
from .complaints import BadInput, Unsuitable, reason_of


class Surface(NamedTuple):
    """Of the counter-body: points, P x 3, and facets, F x 2 in the plane and F x 4 in space."""

    points: object
    facets: object


class Clock(NamedTuple):
    """How figures count time: in seconds, or in cycles where the scene has one."""

    unit: str
    seconds: float

    def text(self, t):
        return f"{style.number(t / self.seconds)} {self.unit}"


class Item(NamedTuple):
    """The object at a path of the file; a group has no data."""

    data: object
    attributes: dict


class Result:
    """One result; arrays are read when they are needed."""

    def __init__(self, path):
        self.path = Path(path)
        self.name = self.path.stem
        if not h5py.is_hdf5(self.path):
            raise BadInput(not_a_result(self.path))
        with self._reading("the file"):
            self._file = h5py.File(self.path, "r")
        self._check()
        stored = self._table("gnomon/stored", "nothing is stored")
        self.times = stored["t"]
        if not (numpy.isfinite(self.times).all() and (numpy.diff(self.times) >= 0).all()):
            raise self._bad("gnomon/stored", "its times do not ascend")
        self._groups = [self._group(_text(path)) for path in stored["path"]]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()

    @contextmanager
    def _reading(self, where):
        """The exception of h5py depends on the damaged bytes: all exceptions mean bad input."""
        try:
            yield
        except Exception as error:
            raise self._bad(where, reason_of(error)) from error

    def _bad(self, where, what):
        return BadInput(f"cannot read {self.path}: {where}: {what}; expected an undamaged result "
                        "of gnomon")

    def _read(self, where):
        """None if there is nothing. All access to the file is here, because h5py's own get() treats
        damaged objects as absent."""
        with self._reading(where):
            if where not in self._file:
                return None
            item = self._file[where]
            data = item[()] if isinstance(item, h5py.Dataset) else None
            return Item(data, dict(item.attrs))

    def _check(self):
        group = self._read("gnomon")
        version = _text(group.attributes.get("format_version", "")) if group else ""
        complaint = None
        if not version:
            complaint = "is not a result of gnomon"
        elif version != "1":
            complaint = f"has format {version}; these figures read format 1"
        elif self._read("gnomon/stored") is None:
            complaint = "has nothing to draw: its run did not get past the start, or did not yet"
        elif self._read("gnomon/history") is None:
            complaint = "has no history"
        if complaint:
            self._file.close()
            raise BadInput(f"{self.path} {complaint}")

    def _group(self, path):
        """Of a stored step, below steps and gnomon/contact."""
        if self._read(path) is None:
            raise self._bad("gnomon/stored", f"it names {path!r}, which is not there")
        return path.removeprefix("steps/")

    def _array(self, where, absent):
        """If an optional object is absent, only the figure is unsuitable."""
        item = self._read(where)
        if item is None:
            raise Unsuitable(absent)
        if not isinstance(item.data, numpy.ndarray):
            raise self._bad(where, "it is not an array")
        return item.data

    def _table(self, where, absent):
        data = self._array(where, absent)
        if data.dtype.names is None:
            raise self._bad(where, "it is not a table")
        return data

    def attribute(self, name):
        return _text(self._read("gnomon").attributes.get(name, ""))

    @property
    def history(self):
        """Columns by name, the row of the start included."""
        return self._table("gnomon/history", "no history is stored")

    @property
    def history_units(self):
        units = self._read("gnomon/history").attributes.get("units", [])
        return dict(zip(self.history.dtype.names, (_text(unit) for unit in units)))

    @property
    def dim(self):
        if not self._groups:
            raise Unsuitable("nothing is stored")
        self.contact(0)  # its message says why there is none
        return int(self._read(f"gnomon/contact/{self._groups[0]}").attributes.get("dim", 2))

    def contact(self, step):
        """The contact surface at a stored step, one row per node."""
        where = f"gnomon/contact/{self._groups[step]}"
        table = self._table(where, "no contact surface is stored")
        self._check_nodes(where, table["node"])
        return table

    def field(self, step, name):
        return self._array(f"steps/{self._groups[step]}/{name}", f"{name} is not stored")

    def counter_body(self, step):
        """Its surface near the body at a stored step; None if the result has none."""
        names = self._read(f"steps/{self._groups[step]}").attributes
        if "counter_points" not in names:
            return None
        points, facets = (self._array(_text(names[name]), "it is not there")
                          for name in ("counter_points", "counter_facets"))
        if facets.min(initial=0) < 0 or facets.max(initial=0) >= len(points):
            raise self._bad("counter_body", "a facet has points that it does not have")
        return Surface(points, facets)

    @property
    def has_phases(self):
        return self._read("gnomon/phase_pressure") is not None and not self.rolls

    @property
    def rolls(self):
        """Steady rolling: one state, with traction and slip."""
        return self._read("gnomon/phase_slip") is not None and not self.has_path

    @cached_property
    def phases(self):
        """Positions in the cycle of the phases at which pressures are stored."""
        return self._array("gnomon/phase_pressure/position", "it has no phases of a cycle")

    def phase_pressure(self, step):
        """At a stored step: one row per phase, one column per node of the contact surface."""
        where = f"gnomon/phase_pressure/{self._groups[step]}"
        values = self._array(where, "no pressures of phases are stored")
        if values.shape != (len(self.phases), len(self.contact(step))):
            raise self._bad(where, "its size is not that of phases and contact surface")
        return values

    @property
    def has_contact(self):
        """Whether a partner presses on the surface."""
        return "max_pressure" in self.history.dtype.names

    @property
    def has_path(self):
        """Whether friction may stick, so that phases are a path."""
        return self._read("gnomon/phase_loop") is not None

    def phase_loop(self, step):
        """At a stored step: one row per phase, place of the counter-body and force that moves it."""
        return self._of_phases("phase_loop", step)

    @property
    def turns(self):
        """Whether the counter-body turns on its path."""
        return self._read("gnomon/phase_turn") is not None

    def phase_turn(self, step):
        """At a stored step: one row per phase, angle of the counter-body and moment about its axis."""
        return self._of_phases("phase_turn", step)

    def phase_traction(self, step):
        """Of friction on the body, as phase_slip()."""
        return self._of_phases("phase_traction", step)

    def phase_slip(self, step):
        """At a stored step: phases, nodes of the contact surface, components."""
        return self._of_phases("phase_slip", step)

    def _of_phases(self, name, step):
        where = f"gnomon/{name}/{self._groups[step]}"
        values = self._array(where, f"no {name} is stored")
        if len(values) != len(self.phases):
            raise self._bad(where, "its size is not that of the phases")
        return values

    @cached_property
    def _scene(self):
        scene = self._read("gnomon/scene")
        return "" if scene is None else _text(scene.data)

    @cached_property
    def clock(self):
        period = re.search(r"\n\[cycle\]\nperiod = ([0-9.e+-]+)", self._scene)
        return Clock("cycles", float(period[1])) if period else Clock("s", 1.0)

    @cached_property
    def axes(self):
        """Names of the coordinates."""
        turned = '\nplane = "axisymmetric"' in self._scene
        return ("r", "z") if turned else ("x", "y", "z")

    @cached_property
    def points(self):
        return self._array("mesh/points", "no mesh is stored")

    @cached_property
    def cells(self):
        cells = self._array("mesh/cells", "no mesh is stored")
        self._check_nodes("mesh/cells", cells)
        return cells

    @property
    def has_pairs(self):
        return "\n[pair." in self._scene

    @cached_property
    def bodies(self):
        """By node: the first node of the connected body that it belongs to."""
        first = numpy.arange(self.cells.max() + 1)
        while True:
            least = first[self.cells].min(axis=1)
            now = first.copy()
            numpy.minimum.at(now, self.cells, least[:, None])
            if (now == first).all():
                return first
            first = now

    @cached_property
    def names_of_bodies(self):
        """Of bodies that are groups of cells, by the first node of the connected body."""
        stored = self._read("mesh/parts")
        names = {}
        if stored is None:
            return names
        of_parts = zip(stored.attributes["names"], stored.attributes["kinds"])
        for part, (name, kind) in enumerate(of_parts):
            if _text(kind) == "cells":
                cell = self._array(f"mesh/parts/{part}", "a part is not stored")[0]
                names.setdefault(self.bodies[self.cells[cell, 0]], _text(name))
        return names

    def _check_nodes(self, where, nodes):
        """Refuses negative numbers too, because Python would count them from the end."""
        count = len(self.points)
        wrong = nodes[(nodes < 0) | (nodes >= count)]
        if len(wrong):
            raise self._bad(where, f"it names node {wrong[0]}, and there are {count}")

    def some_steps(self, most):
        """Stored steps after the start: at most `most`, spread evenly in time, with the last."""
        after = numpy.flatnonzero(self.times > self.times[0]) if len(self.times) else []
        if len(after) <= most:
            return list(after)
        wanted = numpy.linspace(self.times[0], self.times[-1], most + 1)[1:]
        return sorted({int(after[numpy.abs(self.times[after] - t).argmin()]) for t in wanted})


def not_a_result(path):
    """Why a file that is not HDF5 cannot be drawn."""
    if path.suffix == ".toml":
        return (f"{path} is a scene or a study, not a result: `gnomon run {path}` makes a result, "
                "which can be drawn")
    return f"{path} is not an HDF5 file; expected a result of gnomon"


def _text(value):
    return value.decode(errors="replace") if isinstance(value, bytes) else str(value)
