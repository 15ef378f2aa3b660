"""Runs gnomon and reads what it prints; shared by the tables of docs/notes/validation.md."""

import csv
import dataclasses
import math
import os
import pathlib
import re
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "problems" / "worn_body"
GNOMON = os.environ.get("GNOMON", str(ROOT / "build" / "release" / "gnomon"))


def gnomon(*words):
    """What the program prints. Its messages are passed on where it fails."""
    done = subprocess.run([GNOMON, *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"gnomon {' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout + done.stderr


def rows_of(text):
    rows = csv.DictReader(text.splitlines())
    return [{key.split(" [")[0]: value if key == "surface" else float(value)
             for key, value in row.items()} for row in rows]


@dataclasses.dataclass
class Run:
    """A finished run; its result lies in a folder that is removed with the object."""
    result: pathlib.Path
    folder: tempfile.TemporaryDirectory
    steps: int
    newton: int
    factorizations: int
    cpu: float  # seconds, of this program alone
    unknowns: int

    def contact(self, time=None):
        """Contact nodes in the order of their first coordinate."""
        at = [] if time is None else ["--time", time]
        return sorted(rows_of(gnomon("contact", self.result, *at)), key=lambda row: row["X0"])

    def history(self):
        return rows_of(gnomon("history", self.result))

    def at(self, time):
        """The row of the history at this time."""
        return min(self.history(), key=lambda row: abs(row["t"] - time))


def unknowns_of(scene, settings):
    text = gnomon("check", scene, *settings)
    return int(re.search(r"^# all +(\d+)", text, re.MULTILINE)[1])


def run(scene, *settings):
    """Runs a scene; a setting is KEY=VALUE."""
    folder = tempfile.TemporaryDirectory()
    result = pathlib.Path(folder.name) / "result.h5"
    words = [word for setting in settings for word in ("--set", setting)]
    before = os.times()
    text = gnomon("run", scene, *words, "-o", result)
    after = os.times()
    counts = re.search(r": (\d+) steps .*?(\d+) Newton iterations, (\d+) factorizations", text)
    cpu = (after.children_user - before.children_user
           + after.children_system - before.children_system)
    return Run(result, folder, *map(int, counts.groups()), cpu, unknowns_of(scene, words))


def bisect(function, low, high):
    """Zero of an ascending function."""
    for _ in range(200):
        middle = (low + high) / 2
        if function(middle) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def table(head, rows):
    """As Markdown."""
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(map(str, row)) + " |")
    print()


def percent(ratio, digits=2):
    return f"{100 * (ratio - 1):+.{digits}f} %"


def arc_lengths(rows):
    """Lengths along the undeformed surface, from its first node."""
    lengths = [0.0]
    for a, b in zip(rows, rows[1:]):
        lengths.append(lengths[-1] + math.hypot(b["X"] - a["X"], b["Y"] - a["Y"]))
    return lengths
