"""Writes figures. An SVG's ids carry the figure's name, so that several fit into one page."""

import io
import re
from pathlib import Path

import matplotlib

ID = re.compile(r'\bid="([^"]+)"')
PATH = re.compile(r'\b[dxy]="([^"]+)"')
DECIMALS = re.compile(r"-?\d+\.\d{3,}")
REFERENCE = re.compile(r'((?:xlink:)?href="#|url\(#)([^")]+)')


def save(figure, folder, name, kinds=("png", "svg")):
    """Writes NAME.png, NAME.svg; returns the paths."""
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for kind in kinds:
        path = folder / f"{name}.{kind}"
        if kind == "svg":
            path.write_text(svg_text(figure, name), encoding="utf-8")
        else:
            figure.savefig(path, format=kind, dpi=300)
        paths.append(path)
    return paths


def svg_text(figure, name):
    """The same text for the same figure: no date, ids hashed with the name."""
    stream = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": name}):
        figure.savefig(stream, format="svg", dpi=300, metadata={"Date": None, "Title": name})
    return own_ids(shorter_paths(stream.getvalue()), name)


def shorter_paths(text):
    """Hundredths of a point are enough."""
    def rounded(match):
        return DECIMALS.sub(lambda number: f"{float(number[0]):.2f}", match[0]).replace(" \n", "\n")
    return re.sub(r"\n +", "\n", PATH.sub(rounded, text))


def own_ids(text, name):
    prefix = re.sub(r"[^A-Za-z0-9_-]", "_", name) + "-"
    known = set(ID.findall(text))
    text = ID.sub(lambda match: f'id="{prefix}{match[1]}"', text)
    return REFERENCE.sub(
        lambda match: match[1] + (prefix if match[2] in known else "") + match[2], text)
