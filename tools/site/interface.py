"""The page of the C++ interface: Doxygen reads the public headers, the page lists them in the order of
cmake/PublicHeaders.cmake.

  interface.py SITE     writes SITE/doxygen/xml and SITE/source/reference/interface.md
"""
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

root = Path(__file__).resolve().parents[2]

# Of Doxygen's files: links to headers and to derived classes, which have no target in the page, and default values
# that Sphinx cannot read (lambda expressions, named members).
UNWANTED = re.compile(r"<(includes|derivedcompoundref)\b.*?</\1>|<initializer>\s*=?\s*(?:\[|\{\.).*?</initializer>")

DOXYFILE = """
PROJECT_NAME = gnomon
INPUT = {headers}
STRIP_FROM_PATH = {include}
OUTPUT_DIRECTORY = {output}
GENERATE_XML = YES
GENERATE_HTML = NO
GENERATE_LATEX = NO
JAVADOC_AUTOBRIEF = YES
MARKDOWN_SUPPORT = YES
AUTOLINK_SUPPORT = NO
SHOW_HEADERFILE = NO
SHOW_INCLUDE_FILES = NO
EXTRACT_ALL = YES
EXTRACT_PRIVATE = NO
HIDE_UNDOC_MEMBERS = NO
QUIET = YES
WARN_IF_UNDOCUMENTED = NO
WARN_IF_INCOMPLETE_DOC = NO
WARN_AS_ERROR = FAIL_ON_WARNINGS
"""


def public_headers():
    return re.findall(r"gnomon/\S+\.hpp", (root / "cmake/PublicHeaders.cmake").read_text())


def introduction(header):
    """The first paragraph of the comment at the top of a header."""
    comment = re.match(r"(?:// .*\n)+", (root / "include" / header).read_text())[0]
    text = re.sub(r"\s*^// ", " ", comment, flags=re.M).strip()
    return re.sub(r":$", ".", text).replace("`", "``")


def classes(xml, header):
    """The classes that a header declares, without those within others."""
    file = next(tree for tree in xml if tree.find("compounddef").get("kind") == "file"
                and tree.find("compounddef/location").get("file") == header)
    names = [inner.text for inner in file.iter("innerclass") if inner.text.startswith("gnomon::")]
    kinds = {tree.findtext("compounddef/compoundname"): tree.find("compounddef").get("kind") for tree in xml}
    return [(kinds[name], name) for name in names if name.rpartition("::")[0] not in names]


def others(xml, header):
    """What a header declares beside classes, in its order: functions, enumerations, types, constants."""
    space = next(tree for tree in xml if tree.findtext("compounddef/compoundname") == "gnomon")
    members = list(space.iter("memberdef"))
    names = [member.findtext("name") for member in members]
    found = [member for member in members if member.find("location").get("file") == header]
    for member in sorted(found, key=lambda member: int(member.find("location").get("line"))):
        name = member.findtext("name")
        overloaded = names.count(name) > 1
        yield member.get("kind"), f"gnomon::{name}" + (member.findtext("argsstring") if overloaded else "")


def page(headers, xml):
    text = ["# C++ interface\n",
            "The public headers of the library, with what they declare in the namespace `gnomon`. How a program links the",
            "library, and what a plug-in is: [gnomon as a library](../library.md).\n"]
    for header in headers:
        text += [f"## {header}\n", "```{eval-rst}", introduction(header), ""]
        for kind, name in [*classes(xml, header), *others(xml, header)]:
            text += [f".. doxygen{kind}:: {name}"]
            text += ["   :members:", "   :undoc-members:"] if kind in ("class", "struct") else []
            text += [""]
        text += ["```\n"]
    return "\n".join(text)


def main():
    site = Path(sys.argv[1])
    headers = public_headers()
    output = site / "doxygen"
    output.mkdir(parents=True, exist_ok=True)
    settings = DOXYFILE.format(include=root / "include", output=output,
                               headers=" ".join(f'"{root / "include" / header}"' for header in headers))
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True)
    for file in (output / "xml").glob("*.xml"):
        file.write_text(UNWANTED.sub("", file.read_text()))
    xml = [ElementTree.parse(file) for file in (output / "xml").glob("*.xml")]
    xml = [tree for tree in xml if tree.find("compounddef") is not None]
    (site / "source/reference").mkdir(exist_ok=True)
    (site / "source/reference/interface.md").write_text(page(headers, xml))


if __name__ == "__main__":
    main()
