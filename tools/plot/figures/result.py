"""Reads a result file of gnomon: the layout is that of docs/results.md."""

from pathlib import Path

import h5py
import numpy

from .complaints import BadInput, Unsuitable


class Result:
    """One result; arrays are read when asked for."""

    def __init__(self, path):
        self.path = Path(path)
        self.name = self.path.stem
        try:
            self.file = h5py.File(self.path, "r")
        except OSError as error:
            raise BadInput(f"{self.path} is not an HDF5 file, or is damaged") from error
        self._check()
        stored = self.file["gnomon/stored"][:]
        self.times = stored["t"]
        self._groups = [_text(path).removeprefix("steps/") for path in stored["path"]]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()

    def _check(self):
        group = self.file.get("gnomon")
        complaint = None
        if group is None or "format_version" not in group.attrs:
            complaint = "is not a result of gnomon"
        elif int(group.attrs["format_version"]) != 1:
            complaint = f"has format {group.attrs['format_version']}; these figures read format 1"
        elif "stored" not in group:
            complaint = "has nothing to draw: its run did not get past the start, or did not yet"
        if complaint:
            self.file.close()
            raise BadInput(f"{self.path} {complaint}")

    def attribute(self, name):
        return _text(self.file["gnomon"].attrs.get(name, ""))

    @property
    def history(self):
        """Columns by name, the row of the start included."""
        return self.file["gnomon/history"][:]

    @property
    def history_units(self):
        table = self.file["gnomon/history"]
        units = table.attrs.get("units", [])
        return dict(zip(table.dtype.names, (_text(unit) for unit in units)))

    @property
    def dim(self):
        if not self._groups:
            raise Unsuitable("nothing is stored")
        return int(self._contact(0).attrs.get("dim", 2))

    def _contact(self, step):
        table = self.file.get(f"gnomon/contact/{self._groups[step]}")
        if table is None:
            raise Unsuitable("no contact surface is stored")
        return table

    def contact(self, step):
        """The contact surface at a stored step, one row a node."""
        return self._contact(step)[:]

    def field(self, step, name):
        dataset = self.file.get(f"steps/{self._groups[step]}/{name}")
        if dataset is None:
            raise Unsuitable(f"{name} is not stored")
        return dataset[:]

    @property
    def points(self):
        return self._mesh("points")

    @property
    def cells(self):
        return self._mesh("cells")

    def _mesh(self, name):
        if f"mesh/{name}" not in self.file:
            raise Unsuitable("no mesh is stored")
        return self.file[f"mesh/{name}"][:]

    def some_steps(self, most):
        """Stored steps after the start: at most `most`, spread evenly in time, with the last."""
        after = numpy.flatnonzero(self.times > self.times[0]) if len(self.times) else []
        if len(after) <= most:
            return list(after)
        wanted = numpy.linspace(self.times[0], self.times[-1], most + 1)[1:]
        return sorted({int(after[numpy.abs(self.times[after] - t).argmin()]) for t in wanted})


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
