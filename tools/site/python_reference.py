"""The page of the Python interface: what the package gnomon has in its __all__, in groups, with the members of each
class, for Sphinx's autodoc.

  python_reference.py FOLDER     writes FOLDER/python.md; the package has to be importable
"""
import inspect
import sys
from pathlib import Path

import gnomon

GROUPS = {
    "Scenes": ["Scene", "assemble"],
    "Runs and results": ["run", "Outcome", "Step", "Result"],
    "Step by step": ["Model", "Stepper", "State"],
    "The equations": ["System"],
    "Accuracy": ["budget", "plan"],
    "Studies": ["study", "Study"],
    "Extensions": ["register_integrator", "register_wear_law", "load_plugin"],
    "What there is": ["integrators", "problems", "wear_laws", "versions", "installed"],
    "Exceptions": ["Error", "InputError", "SolutionError", "RecoverableError"],
}
TABLE = "gnomon.tables.Table"  # what histories and tables of studies are


def members(cls):
    """Public members of a class and of gnomon's classes that it is derived from."""
    ours = [base for base in cls.__mro__ if base.__module__.startswith("gnomon")]
    return sorted({name for base in ours for name in vars(base) if not name.startswith("_")})


def entry(name):
    thing = getattr(gnomon, name)
    if not inspect.isclass(thing):
        return f".. autofunction:: gnomon.{name}\n"
    if issubclass(thing, Exception):
        return f".. autoexception:: gnomon.{name}\n"
    return f".. autoclass:: gnomon.{name}\n   :members: {', '.join(members(thing))}\n   :inherited-members:\n"


def main():
    listed = {name for names in GROUPS.values() for name in names}
    if listed != set(gnomon.__all__) - {"__version__"}:
        sys.exit(f"{__file__}: GROUPS and gnomon.__all__ differ: {sorted(listed ^ set(gnomon.__all__))}")
    text = ["# Python interface\n",
            "What `import gnomon` offers, by name. How to use it: [gnomon in Python](../tutorials/python.md) and, to read",
            "results without it, [read a result in Python](../howto/python.md).\n"]
    for title, names in GROUPS.items():
        text += [f"## {title}\n", "```{eval-rst}", *map(entry, names), "```\n"]
    text += ["## Tables\n", "```{eval-rst}", f".. autoclass:: {TABLE}\n   :members: to_pandas, to_xarray\n", "```\n"]
    (Path(sys.argv[1]) / "python.md").write_text("\n".join(text))


if __name__ == "__main__":
    main()
