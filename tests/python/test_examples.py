"""The examples in the documentation of the package do what they say."""

import doctest
import importlib
import json
import pathlib
import pkgutil

import gnomon
import pytest


def test_examples():
    attempted = 0
    for module in [gnomon] + [importlib.import_module(f"gnomon.{entry.name}")
                              for entry in pkgutil.iter_modules(gnomon.__path__) if entry.name != "_gnomon"]:
        result = doctest.testmod(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        assert result.failed == 0, module.__name__
        attempted += result.attempted
    assert attempted >= 10


def test_the_tutorial():
    tutorial = pathlib.Path(__file__).parents[2] / "docs/tutorials/python.md"
    result = doctest.testfile(str(tutorial), module_relative=False)
    assert result.failed == 0 and result.attempted > 20


def test_the_notebook():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    notebook = pathlib.Path(__file__).parents[2] / "examples/python/work_precision.ipynb"
    names = {}
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)  # pylint: disable=exec-used
    errors = names["study"].table["shape_error"]
    assert len(errors) == 10 and errors.min() < 2e-4 and errors.max() > 1e-2
    assert names["error"] < 1e-2
