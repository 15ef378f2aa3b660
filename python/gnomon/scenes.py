"""Scenes: from files, texts and dictionaries, with the same checks and messages."""

import collections.abc
import copy
import functools
import os
import pathlib
import re
import tomllib

from gnomon import _gnomon


def toml_value(value):
    """A value of a scene as TOML."""
    if hasattr(value, "item") and not getattr(value, "ndim", 0):  # a number or truth value of numpy
        value = value.item()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        escaped = value.replace("\\", "\\\\").replace('"', '\\"')
        escaped = "".join(c if c.isprintable() else f"\\U{ord(c):08x}" for c in escaped)
        return f'"{escaped}"'
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist") and getattr(value, "ndim", 0):
        return "[" + ", ".join(toml_value(entry) for entry in value) + "]"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, pathlib.PurePath):
        return toml_value(str(value))
    raise _gnomon.InputError(f"a value of a scene: expected a bool, number, text or list of these, got {value!r}")


def _toml_key(name):
    bare = name and all(c.isalnum() and c.isascii() or c in "_-" for c in name)
    return name if bare else toml_value(name)


def _unquoted(part):
    try:
        return tomllib.loads(f"name = {part}")["name"] if part.startswith('"') else part
    except tomllib.TOMLDecodeError:
        return part


def _parts(key):
    """Those of a dotted name, as in the commands: wear.surfaces."a.b".rate has four."""
    return [_unquoted(part) for part in re.findall(r'(?:^|\.)("(?:[^"\\]|\\.)*"(?=\.|$)|[^.]*)', key)]


def _is_group(path, value):
    """The names of surfaces are those of a mesh, which may have dots."""
    return path == ("wear", "surfaces") and isinstance(value, dict)


def _toml_lines(table, path=()):
    """`table` with nested tables and dotted names, as lines KEY = VALUE; lists of tables as [[TABLE]] after them."""
    lines, behind = [], []
    for name, value in table.items():
        if not isinstance(name, str):
            raise _gnomon.InputError(f"a key of a scene: expected a text, got {name!r}")
        here = path + ((name,) if _is_group(path, value) else tuple(_parts(name)))
        if isinstance(value, dict):
            more, later = _toml_lines(value, here)
            lines += more
            behind += later
        elif isinstance(value, (list, tuple)) and value and all(isinstance(entry, dict) for entry in value):
            for entry in value:
                more, later = _toml_lines(entry)
                behind += [f"[[{'.'.join(map(_toml_key, here))}]]"] + more + later
        else:
            lines.append(f"{'.'.join(map(_toml_key, here))} = {toml_value(value)}")
    return lines, behind


def _require_dictionary(values):
    if not isinstance(values, collections.abc.Mapping):
        raise _gnomon.InputError(f"keys of a scene: expected a dictionary, got {values!r}")
    return values


def overrides(values):
    """{"body.young_modulus": 20} as the arguments of --set."""
    _require_dictionary(values or {})
    return [f"{key}={toml_value(value)}" for key, value in (values or {}).items()]


class Scene(_gnomon.Scene):
    """Every parameter of one run.

    >>> import gnomon
    >>> scene = gnomon.Scene.example("pin_on_flat/small_deformation.toml")
    >>> scene["body.young_modulus"]
    640.0
    >>> scene.with_({"body.young_modulus": -1})  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    gnomon.InputError: body.young_modulus: expected ... got -1
    """

    def __init__(self, file, set=None):
        """Reads a scene file (TOML); `set` replaces keys: {"body.young_modulus": 20}."""
        if not isinstance(file, (str, os.PathLike)):
            raise TypeError(f"expected a scene file, got {file!r}; Scene.from_dict and Scene.from_text make scenes "
                            "without a file")
        super().__init__(file, overrides(set))

    @classmethod
    def _from_text(cls, text, name, set=None):
        made = cls.__new__(cls)
        _gnomon.Scene.__init__(made, text, name, overrides(set))
        return made

    @classmethod
    def from_text(cls, text, set=None, name="text"):
        """From TOML text; `name` stands for the file in messages, and files that the scene names are relative to its
        folder."""
        return cls._from_text(text, name, set)

    @classmethod
    def from_dict(cls, values, set=None, name="dict"):
        """From nested dictionaries, {"body": {"young_modulus": 640}}, or dotted names, or both; quotes hold a part with
        dots together, as in the commands."""
        lines, behind = _toml_lines(_require_dictionary(values))
        return cls._from_text("\n".join(lines + behind) + "\n", name, set)

    @classmethod
    def example(cls, name, set=None):
        """A scene that comes with gnomon: "pin_on_flat/small_deformation.toml"."""
        return cls(pathlib.Path(_gnomon.installed("share/gnomon/problems")) / name, set)

    def with_(self, values):
        """The same scene with other values of keys."""
        return Scene._from_text(self.resolved(), str(self.path), values)

    @functools.cached_property
    def _values(self):
        return tomllib.loads(self.resolved())  # once: a scene does not change

    def to_dict(self):
        """All keys that have a value, defaults included, as nested dictionaries."""
        return copy.deepcopy(self._values)

    def __getitem__(self, key):
        table = self._values
        for part in _parts(key):
            if not isinstance(table, dict) or part not in table:
                raise KeyError(key)
            table = table[part]
        return copy.deepcopy(table)

    def __repr__(self):
        return f"<gnomon.Scene {self['problem']} {self.path}>"

    def __reduce__(self):
        return _scene_again, (self.resolved(), str(self.path))


def _scene_again(text, name):
    return Scene._from_text(text, name)
