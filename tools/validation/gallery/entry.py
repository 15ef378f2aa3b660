"""An entry of the gallery: its figures, and the table of its numbers on a page of their own."""

import dataclasses
import pathlib
import re
import tempfile
import textwrap
from typing import Callable

from figures import style

from program import gnomon


@dataclasses.dataclass
class Drawn:
    """What an entry shows. Figures are of Matplotlib, or PNG files; `captions` has one text for each. Notes go below
    the table; their links are those of a page in docs."""
    figures: list
    captions: list
    head: list
    rows: list
    notes: str = ""


@dataclasses.dataclass
class Entry:
    name: str  # of its figures: NAME.png, or NAME-1.png and so on
    title: str
    text: str  # Markdown, before the figures
    draw: Callable[[bool], Drawn]  # from runs; True: bodies in space on the full meshes of their scenes


def column(rows, name):
    return [row[name] for row in rows]


def filled(text):
    """A paragraph in lines of documents."""
    return textwrap.fill(" ".join(text.split()), 118, break_long_words=False, break_on_hyphens=False)


def table(head, rows):
    lines = [head, ["---"] * len(head), *rows]
    text = "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines) + "\n"
    return text.replace(" %", "\N{NO-BREAK SPACE}%").replace("|  |", "| |")


def file_names(name, count):
    return [f"{name}.png"] if count == 1 else [f"{name}-{i}.png" for i in range(1, count + 1)]


def anchor(title):
    """Of a heading, as readers of Markdown make it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def markdown(entry, drawn, folder):
    """The section of an entry in the gallery, and that of its numbers; writes its figures into the folder."""
    text = [f"## {entry.title}\n", filled(entry.text) + "\n"]
    for name, figure, caption in zip(file_names(entry.name, len(drawn.figures)), drawn.figures, drawn.captions):
        if isinstance(figure, bytes):
            (folder / name).write_bytes(figure)
        else:
            figure.savefig(folder / name, dpi=200)
        text.append(f"![{caption}]({folder.name}/{name})\n")
    text.append(f"[Numbers](notes/gallery.md#{anchor(entry.title)})\n")
    notes = filled(drawn.notes.replace("](", "](../")) + "\n" if drawn.notes else ""
    return "\n".join(text), f"## {entry.title}\n\n{table(drawn.head, drawn.rows)}\n{notes}"


def panels(columns, height, rows=1):
    """A figure of a page's width and its axes."""
    figure = style.figure(style.DOUBLE, height * style.DOUBLE)
    return figure, figure.subplots(rows, columns, squeeze=False).ravel()


def plotted(target, *names):
    """Figures of `gnomon plot`, by the ends of their names, as PNG."""
    with tempfile.TemporaryDirectory() as folder:
        gnomon("plot", target, "-o", folder)
        found = {path.name: path.read_bytes() for path in pathlib.Path(folder).glob("*.png")}
    return [next(found[name] for name in found if name.endswith(f"-{end}.png")) for end in names]
