"""Pages of the reference, from what the program tells of itself (`gnomon help`, `gnomon list`).

  reference.py PROGRAM FOLDER     writes FOLDER/*.md
"""
import os
import re
import subprocess
import sys
from pathlib import Path

KEY = re.compile(r"^(\S+): (.*)\n    (.*)$", re.M)
KIND = re.compile(r"^(?P<kind>.*?)(?: in (?P<range>[\[(][^\])]*[\])]))?(?: \[(?P<unit>[^\]]+)\])?$")


def asked(program, *words):
    """What the program prints; plug-ins of the user are no part of the site."""
    return subprocess.run([program, *words], check=True, capture_output=True, text=True,
                          env={**os.environ, "GNOMON_PLUGINS": ""}).stdout


def escaped(text):
    """Text in Markdown; words that are commands, keys or files are set as code, names of pages as links."""
    text = re.sub(r"([\\*_$|<>\[\]])", r"\\\1", text)
    text = re.sub(r"(?<![`\w/])docs/([\w\\]+)\.md",
                  lambda page: f"[{page[1]}](../{page[1]}.md)".replace("\\", ""), text)
    return re.sub(r"`([^`]*)`", lambda code: "`" + code[1].replace("\\", "") + "`", text)


def literal(text):
    return "```\n" + text.strip("\n") + "\n```\n"


def key_entry(key, help_text, value):
    """One key as an entry of a definition list: what it is, then kind, unit, range and default."""
    kind, presence, where = re.match(r"^(.*?); (required|default .*?|optional.*?)(?:; (\[\S+\], or each \S+))?$",
                                     value).groups()
    parts = KIND.match(kind).groupdict()
    facts = [escaped(parts["kind"])]
    if parts["unit"]:
        facts.append(f"unit {escaped(parts['unit'])}")
    if parts["range"]:
        facts.append(f"range {escaped(parts['range'])}")
    if presence.startswith("default "):
        facts.append(f"default `{presence.removeprefix('default ')}`")
    else:
        facts.append(escaped(presence.replace("optional, absent: ", "optional; if absent: ")))
    if where:
        facts.append(escaped(where))
    return f"`{key}`\n: {escaped(help_text)}\n\n  *{'; '.join(facts)}*\n"


def table_of(key):
    """The table of a scene in which a key stands: body of body.density, support of support.#.on."""
    return key.split(".")[0] if "." in key else ""


def key_list(text, level):
    """Keys as definition lists, with a heading for each table."""
    tables = {}
    for key, help_text, value in KEY.findall(text):
        name = table_of(key)
        heading = f"[[{name}]]" if key.startswith(f"{name}.#") else f"[{name}]" if name else ""
        tables.setdefault(heading, []).append(key_entry(key.replace(".#", "", 1), help_text, value))
    return "\n".join((f"{level} `{heading}`\n\n" if heading else "") + "\n".join(entries)
                     for heading, entries in tables.items())


def problems(program):
    return [line.split(None, 1) for line in asked(program, "list", "problems").splitlines()]


def scene_pages(program):
    """A page of keys for each problem, and one that leads to them."""
    pages, rows = {}, []
    for name, help_text in problems(program):
        pages[f"scene-{name}"] = (f"# Scene keys of {name}\n\n{escaped(help_text)[0].upper() + escaped(help_text)[1:]}."
                                  " The same text on the terminal:\n\n"
                                  + literal(f"gnomon help scene {name}") + "\n"
                                  + key_list(asked(program, "help", "scene", name), "##"))
        rows.append(f"- [`{name}`](scene-{name}.md): {escaped(help_text)}")
    first = asked(program, "help", "scene").split("\nKEYS OF ")[0]
    pages["scene"] = f"# Scenes\n\n{escaped(first)}\nKeys of each problem:\n\n" + "\n".join(rows) + "\n"
    return pages


def options(text):
    """A section of options as entries of a definition list; a name that is too long has its help on the next line."""
    entries = re.findall(r"^  (\S.*?)(?: (REQUIRED))?(?:  +(\S.*))?$((?:\n {10,}\S.*)*)", text, re.M)
    return "\n".join(f"`{name}`\n: {escaped(' '.join((first + more).split()))}{'; required' * bool(required)}\n"
                     for name, required, first, more in entries if name != "-h,--help")


def sections(text, names):
    """The entries of some sections of a help text."""
    return [options(body) for body in re.findall(rf"^(?:{names}):\n((?:  .*\n?)+)", text, re.M)]


def commands(program):
    lines = ["# Commands\n", "`gnomon help COMMAND` prints the same on the terminal.\n", literal("gnomon [OPTIONS] COMMAND"),
             *sections(asked(program, "help"), "Options")]
    for text in re.split(r"^More: (?:.+\n?)+", asked(program, "help", "commands"), flags=re.M):
        usage = re.search(r"^Usage: (gnomon ([a-z]\S*) .*)$", text, re.M)
        if not usage:
            continue
        lines += [f"## gnomon {usage[2]}\n", escaped(text.split("\nUsage:")[0].strip()).rstrip(".") + ".\n",
                  literal(usage[1]), *sections(text, "Positionals|Options")]
    return "\n".join(lines)


def integrators(program):
    head, *rows = [re.split(r"  +", line.strip()) for line in asked(program, "list", "integrators").splitlines()]
    table = [head, ["---"] * len(head), *([f"`{row[0]}`", *map(escaped, row[1:])] for row in rows)]
    entries, rest = asked(program, "help", "integrators").split("\n\n", 1)
    sources = [f"`{name}`\n: {escaped(text)}\n" for name, text in re.findall(r"^(\S+): (.*)$", entries, re.M)]
    return "\n".join(["# List of integrators\n", "Which one to use when: [integrators](../integrators.md).\n",
                      escaped(rest), "\n".join("| " + " | ".join(row) + " |" for row in table),
                      "\n## Sources\n", *sources])


def studies(program):
    first, *sections = re.split(r"^KEYS OF (.*)$", asked(program, "help", "studies"), flags=re.M)
    before, example, after = re.match(r"((?:.+\n)+)\n((?:    .*\n)+)\n([\s\S]*)", first).groups()
    lines = ["# Study keys\n", escaped(before), literal(re.sub("^    ", "", example, flags=re.M)), escaped(after),
             "More: [studies](../studies.md).\n"]
    for heading, text in zip(sections[::2], sections[1::2]):
        heading = re.sub(r"\b[A-Z]+\b", lambda word: word[0].lower(), heading)
        lines += [f"## Keys of {escaped(heading)}\n",
                  "\n".join(key_entry(*key) for key in KEY.findall(text))]
    return "\n".join(lines)


def catalogue(program):
    subjects = {"laws": "Wear laws: `wear.law`", "materials": "Materials: `body.material`, `shape.energy`",
                "shapes": "Shapes of counter-bodies: `counter_body.shape`",
                "solvers": "Linear solvers: `solver.method`", "problems": "Problems"}
    lines = ["# Laws, materials, shapes, solvers, problems\n", "What scenes may name, by `gnomon list`. How one is added:",
             "[architecture](../architecture.md#what-can-be-extended-and-how).\n"]
    for subject, title in subjects.items():
        lines.append(f"## {title}\n")
        for line in asked(program, "list", subject).splitlines():
            name, *rest = re.split(r"  +", line.strip(), 1)
            lines.append(f"`{name}`\n: {escaped('; '.join(re.split('  +', rest[0])))}\n" if rest else escaped(line) + "\n")
    return "\n".join(lines)


def exit_codes(program):
    rows = [line.split(None, 1) for line in asked(program, "help", "exit-codes").splitlines()]
    return ("# Exit codes\n\n| code | meaning |\n|---|---|\n"
            + "\n".join(f"| {code} | {escaped(text)} |" for code, text in rows) + "\n")


def text_page(title, text):
    """A topic of the program's help as it is printed."""
    return f"# {title}\n\n{literal(text)}"


def main():
    program, folder = sys.argv[1], Path(sys.argv[2])
    pages = {**scene_pages(program), "commands": commands(program), "integrator-list": integrators(program),
             "study-keys": studies(program), "catalogue": catalogue(program), "exit-codes": exit_codes(program),
             "units": text_page("Units", asked(program, "help", "units")),
             "output": text_page("Output of a run", asked(program, "help", "output"))}
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pages.items():
        (folder / f"{name}.md").write_text(text)


if __name__ == "__main__":
    main()
