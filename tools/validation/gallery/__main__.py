"""Draws docs/gallery.md, its figures and docs/notes/gallery.md from runs of gnomon; scripts/gallery calls this."""

import argparse
import pathlib
import re
import time

from figures import style
from program import ROOT

from gallery import bodies, closed_forms, contact, cycles, methods, paper, parts, published, rolling
from gallery.entry import markdown

GROUPS = {
    "Contact without wear": contact.ENTRIES,
    "Wear with closed forms": closed_forms.ENTRIES,
    "Published tests": published.ENTRIES,
    "Cycles": cycles.ENTRIES,
    "The paper's examples": paper.ENTRIES,
    "Parts": parts.ENTRIES + bodies.ENTRIES + rolling.ENTRIES,
    "Methods": methods.ENTRIES,
}
MARK = "<!-- {} -->\n"


def options():
    names = [entry.name for entries in GROUPS.values() for entry in entries]
    parser = argparse.ArgumentParser(prog="scripts/gallery", epilog="Entries: " + " ".join(names),
                                     description="Draws docs/gallery.md, its figures and its numbers, docs/notes/gallery.md.")
    parser.add_argument("names", nargs="*", metavar="NAME", help="draw these entries and keep the others; default: all")
    parser.add_argument("--full", action="store_true",
                        help="bodies in space on the full meshes of their scenes, a quarter of an hour more")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=ROOT / "docs", metavar="FOLDER",
                        help="instead of docs")
    chosen = parser.parse_args()
    if unknown := set(chosen.names) - set(names):
        parser.error(f"expected names of entries ({' '.join(names)}), got {' '.join(sorted(unknown))}")
    return chosen


def earlier_sections(page):
    """The sections of a page that this program has made, by the names of their entries."""
    if not page.exists():
        return {}
    parts = re.split(r"^<!-- (\S+) -->\n", page.read_text(), flags=re.MULTILINE)[1:]
    return dict(zip(parts[::2], parts[1::2]))


def write(page, head, sections):
    """The page of the sections that exist, in the order of the entries."""
    text = (pathlib.Path(__file__).parent / head).read_text()
    for entries in GROUPS.values():
        for entry in entries:
            if entry.name in sections:
                text += "\n" + MARK.format(entry.name) + sections[entry.name].strip() + "\n"
    page.write_text(text)
    print(page)


def main():
    chosen = options()
    page, folder = chosen.output / "gallery.md", chosen.output / "gallery"
    numbers_page = chosen.output / "notes" / "gallery.md"
    for made in (folder, numbers_page.parent):
        made.mkdir(parents=True, exist_ok=True)
    sections, numbers = earlier_sections(page), earlier_sections(numbers_page)
    style.apply()
    for entry in (entry for entries in GROUPS.values() for entry in entries):
        if chosen.names and entry.name not in chosen.names:
            continue
        begin = time.monotonic()
        sections[entry.name], numbers[entry.name] = markdown(entry, entry.draw(chosen.full), folder)
        print(f"{entry.name}: {time.monotonic() - begin:.0f} s", flush=True)
    write(page, "head.md", sections)
    write(numbers_page, "numbers_head.md", numbers)


if __name__ == "__main__":
    main()
