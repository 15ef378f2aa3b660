"""Damages copies of a result: each is refused in one line with exit code 2, before any figure.

usage: check_damage.py FOLDER_OF_THE_PLOTS RESULT.h5
"""

import contextlib
import io
import sys
from pathlib import Path

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import h5py  # noqa: E402
import gnomon_plot  # noqa: E402

WHOLE = Path(sys.argv[2])
COPY = WHOLE.with_name("damaged.h5")
FIGURES = WHOLE.with_name("damaged-figures")
OBJECTS = ("gnomon", "gnomon/stored", "gnomon/history", "gnomon/contact", "gnomon/contact/0000",
           "gnomon/contact/0000/000001", "steps", "steps/0000/000001",
           "steps/0000/000000/equivalent_stress", "mesh", "mesh/points", "mesh/cells",
           "counter_body", "counter_body/0000/000000/points", "counter_body/0000/000000/facets")


def damage_header(name):
    """One byte, which HDF5's checksum finds. HDF5 itself knows where the header is."""
    with h5py.File(COPY) as file:
        address = h5py.h5o.get_info(file[name].id).addr
    content = bytearray(COPY.read_bytes())
    content[address + 12] ^= 0xff
    COPY.write_bytes(content)


def number_nodes(first):
    """Of a cell: in numbers, which no checksum covers."""
    with h5py.File(COPY, "r+") as file:
        file["mesh/cells"][3, 1] = first


def number_points(first):
    with h5py.File(COPY, "r+") as file:
        file["counter_body/0000/000000/facets"][3, 1] = first


def name_step(path):
    with h5py.File(COPY, "r+") as file:
        table = file["gnomon/stored"][:]
        table["path"][-1] = path
        file["gnomon/stored"][:] = table


def check(expected, damage, *arguments):
    COPY.write_bytes(WHOLE.read_bytes())
    damage(*arguments)
    sys.argv = ["gnomon_plot.py", "any", str(COPY), "-o", str(FIGURES)]
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        code = gnomon_plot.main()
    text = said.getvalue()
    assert code == 2 and text.count("\n") == 1, (arguments, code, text)
    assert text.startswith("gnomon: ") and str(COPY) in text and expected in text, text
    assert not FIGURES.exists(), arguments


for name in OBJECTS:
    check("expected an undamaged result", damage_header, name)
for node in (-1, 1000000):
    check(f"mesh/cells: it names node {node}", number_nodes, node)
    check("counter_body: a facet has points that it does not have", number_points, node)
for path in (b"steps/0000/000009", b"\xff"):
    check("which is not there", name_step, path)
check("truncated file", lambda: COPY.write_bytes(WHOLE.read_bytes()[:-1000]))
