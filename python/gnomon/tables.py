"""Named columns of equal length, as numpy arrays."""

import collections.abc


class Table(collections.abc.Mapping):
    """Columns by name; `index` is the column that orders the rows.

    >>> import gnomon
    >>> scene = gnomon.Scene.example("dahlquist/decay.toml", {"integrator.step": 1.0, "time.end": 2.0})
    >>> history = gnomon.run(scene).history
    >>> history["t"].tolist(), "worn_volume" in history
    ([0.0, 1.0, 2.0], False)
    """

    def __init__(self, columns, index):
        self._columns, self.index = dict(columns), index

    def __getitem__(self, name):
        return self._columns[name]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def __repr__(self):
        rows = len(self._columns[self.index]) if self.index in self._columns else 0
        return f"<gnomon table of {rows} rows: {', '.join(self._columns)}>"

    def to_pandas(self):
        """A pandas.DataFrame; needs pandas."""
        import pandas
        return pandas.DataFrame(self._columns).set_index(self.index)

    def to_xarray(self):
        """An xarray.Dataset; needs xarray."""
        import xarray
        columns = {name: (self.index, values) for name, values in self._columns.items() if name != self.index}
        return xarray.Dataset(columns, {self.index: self._columns[self.index]})
