"""How wrong results are, and settings for an accuracy."""

import json

from gnomon import _gnomon
from gnomon.scenes import Scene


def _require_scene(scene):
    if not isinstance(scene, _gnomon.Scene):
        raise TypeError(f"expected a gnomon.Scene, got {type(scene).__name__}")


def budget(scene):
    """How wrong the result of a scene is, and by what, from further runs of it, as `gnomon budget --json` prints it:
    `values` with their relative `error`, and the `parts` of it. Runs the scene, and takes some three to five times as long.

    >>> import gnomon
    >>> scene = gnomon.Scene.example("pin_on_flat/small_deformation.toml",
    ...                              {"mesh.elements": [16, 8], "time.end": 100, "integrator.rtol": 1e-2})
    >>> found = gnomon.budget(scene)
    >>> [part["source"] for part in found["parts"]]
    ['mesh', 'time', 'solves']
    """
    _require_scene(scene)
    return json.loads(_gnomon._budget(scene))


def plan(scene):
    """The scene with the settings that meet its accuracy.within at the least cost, by pilot runs, and the table of the
    plan as text. A run by gnomon.run(scene) is not checked against it; gnomon.budget(scene) checks."""
    _require_scene(scene)
    planned, table = _gnomon._plan(scene)
    return Scene._from_text(planned.resolved(), str(planned.path)), table
