# The documentation site (scripts/site). The pages are plain Markdown, which links to other files by their names; what
# a site needs beyond that is added here, not in the pages.
import os
import re
from pathlib import Path

docs = Path(__file__).parent
site = Path(os.environ["GNOMON_SITE"])  # where scripts/site builds

project = "gnomon"
author = "the gnomon authors"
copyright = author
extensions = ["myst_parser", "breathe", "sphinx_copybutton", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
exclude_patterns = ["_static"]

# Markdown: formulas between dollars, definition lists, anchors of headings as in other readers of Markdown.
myst_enable_extensions = ["deflist", "dollarmath"]
myst_heading_anchors = 4
myst_update_mathjax = False  # set here, for MathJax 2
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
mathjax2_config = {
    "tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]],
                "ignoreClass": ".*", "processClass": "math"},
    "showMathMenu": False,
    "messageStyle": "none",
    "CommonHTML": {"linebreaks": {"automatic": False}},
}
smartquotes = False  # what pages quote is what a user types
highlight_language = "none"  # indented blocks: commands and what they print
copybutton_exclude = ".linenos, .gp, .go"

html_theme = "furo"
html_title = "gnomon"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_copy_source = False

# Docstrings mark code as Markdown does.
default_role = "literal"

# Names in signatures that no page describes: the standard library, Eigen, the interior of gnomon.
breathe_projects = {"gnomon": str(site / "doxygen" / "xml")}
breathe_default_project = "gnomon"
nitpick_ignore_regex = [("cpp:.*", ".*"), ("py:class", "numpy.ndarray|os.PathLike")]

# Files outside of docs/ that the site has as pages.
outside = {"CHANGELOG.md": "changelog.md", "README.md": "index.md"}
link = re.compile(r"\]\(([^)#\s]+\.md)(#[^)\s]*)?\)")


def toctrees(text):
    """The pages in the order in which index.md lists them: a list of links below each heading of its last part."""
    trees = []
    for section in re.split(r"^### ", text.split("\n## All pages\n")[1], flags=re.M)[1:]:
        pages = "\n".join(target.removesuffix(".md") for target, _ in link.findall(section))
        trees.append(f"```{{toctree}}\n:hidden:\n:caption: {section.splitlines()[0]}\n\n{pages}\n```\n")
    return "\n".join(trees)


def linked_outside(depth):
    """Makes links of a page to files outside of docs/ links to pages of the site, or names without a link."""
    def replaced(match):
        text, file = match.groups()
        return f"[{text}]({'../' * depth}{outside[file]})" if file in outside else text
    return lambda text: re.sub(r"\[([^\]]*)\]\((?:\.\./){%d}([^)]*)\)" % (depth + 1), replaced, text)


def prepare(app, name, source):
    """Makes a page of the site of a page of docs/."""
    text = source[0]
    if name == "changelog":
        text = re.sub(r"\[docs/(?:\w+/)*(\w+)\.md\]\(", r"[\1](", text).replace("](docs/", "](")
    text = linked_outside(name.count("/"))(text)
    if name == "index":
        text += "\n" + toctrees(text)
    if name == "reference":
        pages = sorted(page.stem for page in (Path(app.srcdir) / "reference").glob("*.md"))
        text += "\n```{toctree}\n:hidden:\n\n" + "\n".join(f"reference/{page}" for page in pages) + "\n```\n"
    source[0] = text


def python_names(app, what, name, thing, options, arguments, result):
    """Makes signatures of functions in C++ those that a user of the package sees."""
    def public(text):
        text = re.sub(r"\bself: [\w.]+(, )?", "", text or "")
        return re.sub(r"gnomon\._gnomon\._?", "gnomon.", text).replace("numpy.ndarray[numpy.float64]", "numpy.ndarray")
    return public(arguments), public(result)


def setup(app):
    app.connect("source-read", prepare)
    app.connect("autodoc-process-signature", python_names)
