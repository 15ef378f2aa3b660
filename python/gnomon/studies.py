"""Studies: many runs of one scene, with errors and costs."""

import csv
import pathlib
import subprocess

import numpy

from gnomon import _gnomon
from gnomon.tables import Table


def _program():
    """The program gnomon of this installation."""
    for name in ("bin/gnomon", "gnomon"):
        try:
            return _gnomon.installed(name)
        except _gnomon.Error:
            continue
    raise _gnomon.Error("the program gnomon is not installed beside the library, but studies need it")


_TEXTS = {"study", "sweep", "method", "integrator", "setting_kind", "run", "status", "reason", "reference"}


def _column(name, texts):
    if name in _TEXTS:
        return numpy.array(texts)
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts)


class Study:
    """The results of a study in its folder: `table` has the columns of study.csv (a gnomon.tables.Table)."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        try:
            with open(self.folder / "study.csv", newline="", encoding="utf-8") as file:
                rows = list(csv.DictReader(file))
        except OSError as error:
            raise _gnomon.InputError(f"{folder}: expected the folder of a study: {error}") from None
        names = rows[0].keys() if rows else []
        self.table = Table({name: _column(name, [row[name] for row in rows]) for name in names}, "run")

    def plot(self, axes=None, cost="newton_iterations", error="shape_error"):
        """Work-precision: error over cost, one line per method, in an axes of Matplotlib."""
        import matplotlib.pyplot as plt
        if error not in self.table or numpy.isnan(self.table[error]).all():
            raise _gnomon.InputError(f"{self.folder}: has no {error}, expected a study with a reference")
        axes = axes or plt.figure().add_subplot()
        for method in dict.fromkeys(self.table["method"]):
            rows = self.table["method"] == method
            order = numpy.argsort(self.table[cost][rows])
            axes.loglog(self.table[cost][rows][order], self.table[error][rows][order], "o-", label=method)
        axes.set_xlabel(cost.replace("_", " "))
        axes.set_ylabel(error.replace("_", " ") + " [mm]")
        axes.legend()
        return axes


def study(file, folder, *, jobs=None, resume=False):
    """Makes the study of a study file in `folder` and returns its Study; needs the program gnomon.

    >>> import gnomon, pathlib, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = pathlib.Path(folder.name, "rates.toml")
    >>> scene = gnomon.Scene.example("dahlquist/decay.toml")
    >>> text = f'scene = "{scene.path}"\\nreference = "none"\\n[[sweep]]\\nkey = "dahlquist.rate_real"\\n'
    >>> _ = file.write_text(text + "values = [-1.0, -2.0]\\n")
    >>> made = gnomon.study(file, pathlib.Path(folder.name, "rates"))
    >>> made.table["dahlquist.rate_real"].tolist(), list(made.table["status"])
    ([-1.0, -2.0], ['finished', 'finished'])
    """
    command = [_program(), "study", str(file), "-o", str(folder), "--quiet"]
    command += ["--jobs", str(jobs)] if jobs else []
    command += ["--resume"] if resume else []
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    message = done.stderr.strip().removeprefix("gnomon: ")
    if done.returncode == 2:
        raise _gnomon.InputError(message)
    if done.returncode == 3:
        raise _gnomon.SolutionError(message or "all runs of the study failed")
    if done.returncode != 0:
        raise _gnomon.Error(message or f"the study ended with exit code {done.returncode}")
    return Study(folder)
