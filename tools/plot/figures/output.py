"""Writes figures. An SVG's ids carry the figure's name, so that several fit into one page."""

import io
import re
from pathlib import Path

import matplotlib

ID = re.compile(r'\bid="([^"]+)"')
PATH = re.compile(r'\b[dxy]="([^"]+)"')
DECIMALS = re.compile(r"-?\d+\.\d{3,}")
REFERENCE = re.compile(r'((?:xlink:)?href="#|url\(#)([^")]+)')


def render(figure, name, kinds=("png", "svg")):
    """The contents of NAME.png, NAME.svg by these names."""
    return {f"{name}.{kind}": svg_text(figure, name).encode() if kind == "svg" else bitmap(figure)
            for kind in kinds}


def save(pictures, folder):
    """Writes what render returned; returns the paths."""
    paths = [Path(folder) / name for name in pictures]
    for path, content in zip(paths, pictures.values()):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return paths


def bitmap(figure):
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=300)
    return stream.getvalue()


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
