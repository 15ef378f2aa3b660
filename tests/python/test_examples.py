"""The examples in the documentation of the package do what they say."""

import contextlib
import doctest
import importlib
import io
import json
import pathlib
import pkgutil
import re

import gnomon
import pytest

DOCS = pathlib.Path(__file__).parents[2] / "docs"


def test_examples():
    attempted = 0
    for module in [gnomon] + [importlib.import_module(f"gnomon.{entry.name}")
                              for entry in pkgutil.iter_modules(gnomon.__path__) if entry.name != "_gnomon"]:
        result = doctest.testmod(module, optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
        assert result.failed == 0, module.__name__
        attempted += result.attempted
    assert attempted >= 35


@pytest.mark.parametrize("page, examples", [("tutorials/python.md", 20), ("howto/arrays.md", 10)])
def test_pages(page, examples):
    result = doctest.testfile(str(DOCS / page), module_relative=False)
    assert result.failed == 0 and result.attempted > examples


def words(text):
    """Numbers as numbers."""
    for word in re.split(r"[\s,()\[\]]+", text.strip()):
        try:
            yield float(word)
        except ValueError:
            yield word


def test_how_to_read_a_result(tmp_path, monkeypatch):
    pytest.importorskip("h5py")
    page = (DOCS / "howto/python.md").read_text()
    program = re.search(r"```python\n(.*?)```", page, re.DOTALL).group(1)
    printed = "".join(re.findall(r"^    .*\n", page.split("```")[2], re.MULTILINE))
    monkeypatch.chdir(tmp_path)
    gnomon.run(gnomon.Scene.example("worn_body/block_on_ring.toml"), "ring.h5")
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        exec(program, {})  # pylint: disable=exec-used
    ours, theirs = list(words(output.getvalue())), list(words(printed))
    assert len(ours) == len(theirs) > 50
    for mine, other in zip(ours, theirs):  # pressures depend on the steps by some per cent
        assert mine == (pytest.approx(other, rel=0.1) if isinstance(other, float) else other)


def names_of_notebook(name):
    """What the code of a notebook defines."""
    notebook = pathlib.Path(__file__).parents[2] / "examples/python" / name
    names = {}
    for cell in json.loads(notebook.read_text())["cells"]:
        if cell["cell_type"] == "code":
            exec("".join(cell["source"]), names)  # pylint: disable=exec-used
    return names


def test_the_notebook():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    names = names_of_notebook("work_precision.ipynb")
    errors = names["study"].table["shape_error"]
    assert len(errors) == 10 and errors.min() < 2e-4 and errors.max() > 1e-2
    assert names["error"] < 1e-2


def test_schemes_of_the_literature():
    """The notebook repeats the table of its page: counts to a tenth, errors to a fifth."""
    pytest.importorskip("scipy.sparse.linalg")
    table = names_of_notebook("schemes_of_the_literature.ipynb")["table"]
    page = (DOCS / "schemes_of_the_literature.md").read_text()
    rows = {row[0]: row[1:-1] for row in
            ([cell.strip() for cell in line.strip("|").split("|")] for line in page.splitlines() if " | " in line)}
    del rows["scheme"]
    assert rows.keys() == table.keys()
    for scheme, cells in rows.items():
        for cell, found in zip(cells, table[scheme], strict=True):
            if cell == "fails":
                assert found is None, scheme
                continue
            iterations, error = map(float, cell.split(","))
            assert found[0] == pytest.approx(iterations, rel=0.1) and found[1] == pytest.approx(error, rel=0.2), scheme
