"""Integrators and wear laws, written in Python or in plug-ins of C++."""

import keyword
import math
import numbers
import os
import pathlib
import re

from gnomon import _gnomon

_VARIABLES = ("p", "v", "h", "q", "t", "s", "x")


def _checked_name(name, what):
    if not isinstance(name, str) or not name or any(c.isspace() or not c.isprintable() for c in name):
        raise _gnomon.InputError(f"the name of {what}: expected a text without blanks, got {name!r}")
    return name


def _checked_function(function, what):
    if not callable(function):
        raise TypeError(f"{what}: expected something that can be called, got {function!r}")
    return function


def _checked_constants(constants):
    taken = set(re.findall(r"\bwear\.(\w+)", _gnomon._key_help("winkler")))
    for name, value in constants.items():
        usable = isinstance(name, str) and name.isidentifier() and not keyword.iskeyword(name)
        if not usable or name in _VARIABLES:
            raise _gnomon.InputError(f"a constant of a wear law: expected a name other than those of the variables "
                                     f"({' '.join(_VARIABLES)}), got {name!r}")
        if name in taken - _registered_constants:
            raise _gnomon.InputError(f"a constant of a wear law: wear.{name} is a key of scenes already")
        if not isinstance(value, numbers.Real) or not math.isfinite(value):
            raise _gnomon.InputError(f"the constant {name} of a wear law: expected a finite number, got {value!r}")
    _registered_constants.update(constants)
    return constants


_registered_constants = set()


def load_plugin(file):
    """Loads a plug-in in C++ (docs/library.md) for the rest of the process, and for the programs that it starts, as those
    of a study, by the variable GNOMON_PLUGINS of its environment."""
    _gnomon.load_plugin(file)
    loaded = os.environ.get("GNOMON_PLUGINS", "")
    name = str(pathlib.Path(file).resolve())
    if name not in [str(pathlib.Path(other).resolve()) for other in loaded.split(":") if other]:
        os.environ["GNOMON_PLUGINS"] = f"{loaded}:{name}".strip(":")


def register_wear_law(name, rate, constants=None, help="a wear law in Python"):
    """A wear law that scenes choose by wear.law = NAME.

    `rate(p, v, h, q, t, s, x, **constants)` returns the wear rate from pressure, sliding speed, worn depth, frictional
    power, time, sliding distance and initial position (three numbers). Scenes may set its constants as wear.CONSTANT;
    otherwise they have the values given here. A law of Python may be registered again; scenes that were read before are
    then read again, if its constants are others. Steps do not look for jumps and kinks of a law of Python, and no warning
    says that fixed steps pass over a jump: an expression as wear.rate has both.

    >>> import gnomon
    >>> gnomon.register_wear_law("python-archard", lambda p, v, h, q, t, s, x, K: K * p * v, {"K": 1e-7})
    >>> scene = gnomon.Scene.example("winkler/pin.toml", {"foundation.points": 41, "time.end": 50.0})
    >>> twice = gnomon.run(scene.with_({"wear.law": "python-archard", "wear.K": 2e-7}))
    >>> round(twice.history["wear_integral"][-1] / gnomon.run(scene).history["wear_integral"][-1], 6)
    2.0
    """
    _gnomon.register_wear_law(_checked_name(name, "a wear law"), _checked_function(rate, "a wear law"),
                              _checked_constants(dict(constants or {})), help)


def register_integrator(name, make, help="an integrator in Python", order="not known", fixed_steps=True):
    """An integrator that scenes choose by integrator.name = NAME.

    `make(system, settings)` returns an object with `advance(state, until)`, which returns the State at the end of one
    step, at `until` at the latest: the next time at which a load has a kink or a jump, a state is stored or the run
    ends. `system.consistent` there gives what holds before a jump, and the next step begins behind it. `settings` has
    the keys step (0: none is given), rtol, atol, end, scale (the mean wear depth) and max_step (0: none). There is no
    error control but its own. Its steps are counted, and the Newton iterations of `system.consistent`; wear_integral
    is by the trapezoidal rule over its steps. `order`: for lists and for every row of the history, if it is a number
    (2 or "2"); a method of variable order sets its attribute `order` in every step.

    >>> import gnomon
    >>> class Euler:
    ...     def __init__(self, system, settings):
    ...         self.system, self.step = system, settings["step"]
    ...     def advance(self, state, until):
    ...         t = min(state.t + self.step, until)
    ...         return self.system.consistent(t, state.y + (t - state.t) * state.ydot)
    >>> gnomon.register_integrator("python-euler", Euler, help="explicit", order=1)
    >>> scene = gnomon.Scene.example("winkler/pin.toml", {"foundation.points": 41, "time.end": 50.0})
    >>> outcome = gnomon.run(scene.with_({"integrator.name": "python-euler", "integrator.step": 10.0}))
    >>> outcome.counters["steps"], outcome.history["order"].tolist()
    (5, [0, 1, 1, 1, 1, 1])
    """
    if isinstance(order, int):
        order = str(order)
    _gnomon.register_integrator(_checked_name(name, "an integrator"), _checked_function(make, "an integrator"), help,
                                order, fixed_steps)
