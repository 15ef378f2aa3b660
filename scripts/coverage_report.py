"""Lines that ran in a build with GNOMON_COVERAGE: coverage_report.py BUILD FOLDER...

Prints a table of the folders of the source, and the lines that did not run by file. A line has run
when it has in any object that holds it.
"""

import collections
import json
import pathlib
import subprocess
import sys


def counts(build, folders):
    """Largest count of every line of code: {file: {line: count}}."""
    root = pathlib.Path.cwd()
    lines = {}
    for data in sorted(build.rglob("*.gcno")):
        answer = subprocess.run(["gcov", "--json-format", "--stdout", str(data)],
                                capture_output=True, text=True, check=True).stdout
        for unit in answer.splitlines():
            add(lines, json.loads(unit), root, folders)
    return lines


def add(lines, unit, root, folders):
    for file in unit["files"]:
        path = pathlib.Path(unit["current_working_directory"], file["file"]).resolve()
        if not path.is_relative_to(root):
            continue
        path = path.relative_to(root)
        if path.parts[0] not in folders:
            continue
        known = lines.setdefault(str(path), {})
        for line in file["lines"]:
            number = line["line_number"]
            known[number] = max(known.get(number, 0), line["count"])


def ranges(numbers):
    """[3, 4, 5, 9] as "3-5 9"."""
    runs = []
    for number in sorted(numbers):
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return " ".join(f"{a}-{b}" if b > a else f"{a}" for a, b in runs)


def folder_of(file):
    """The folder of its room, such as src/linear; include/gnomon for headers directly in it."""
    parts = pathlib.Path(file).parent.parts
    return "/".join(parts[:3] if parts[0] == "include" else parts[:2])


def main(build, *folders):
    lines = counts(pathlib.Path(build), folders)
    totals = collections.defaultdict(lambda: [0, 0])
    for file, known in lines.items():
        for name in (folder_of(file), "in all"):
            totals[name][0] += sum(count > 0 for count in known.values())
            totals[name][1] += len(known)
    print("lines that did not run:")
    for file, known in sorted(lines.items()):
        missed = [number for number, count in known.items() if count == 0]
        if missed:
            print(f"  {file}: {ranges(missed)}")
    print(f"\n{'folder':32}{'lines':>8}{'ran':>8}{'':>9}")
    for name in sorted(totals, key=lambda name: (name == "in all", name)):
        ran, of = totals[name]
        if of == 0:
            continue  # declarations only
        print(f"{name:32}{of:8}{ran:8}{100 * ran / of:8.1f} %")


if __name__ == "__main__":
    main(*sys.argv[1:])
