"""Whole runs."""

import dataclasses
import json

from gnomon import _gnomon
from gnomon.tables import Table


@dataclasses.dataclass
class Outcome:
    """How a run ended."""

    status: str          #: "finished", "interrupted" (by its callback) or "failed"
    diagnosis: str       #: why it failed
    warnings: list       #: reasons why its numbers may be worthless
    counters: dict       #: work of the whole run
    wall_seconds: float  #: of the integration
    summary: dict        #: as `gnomon run --summary` writes it
    history: Table       #: one array per column, one entry per step
    state: object        #: the last State; None if the start failed
    model: object        #: the Model of this state, another one than at the start where contact has grown
    surface: dict        #: the contact surface of this state, one array per column; None without one


def run(scene, result=None, *, force=False, on_step=None, check=True):
    """Integrates a scene (a Scene or a Model) from its start to time.end.

    `result`: a result file (HDF5) to write; an earlier one is refused unless `force`. `on_step(step)` is called after
    the start and after every step with a gnomon.Step; True ends the run there; so does an exception, which is then
    raised again when the result is closed. Ctrl-C ends it with KeyboardInterrupt. A run that fails raises
    SolutionError; with check=False the outcome says so.

    >>> import gnomon
    >>> scene = gnomon.Scene.example("winkler/pin.toml", {"foundation.points": 41})
    >>> times = []
    >>> outcome = gnomon.run(scene, on_step=lambda step: times.append(step.t) or step.t > 100)
    >>> outcome.status, times[-1] == outcome.history["t"][-1]
    ('interrupted', True)
    """
    if not isinstance(scene, (_gnomon.Scene, _gnomon.Model)):
        raise TypeError(f"expected a gnomon.Scene or gnomon.Model, got {scene!r}")
    model = scene if isinstance(scene, _gnomon.Model) else _gnomon.Model(scene)
    outcome = Outcome(**_gnomon._run(model, result, force, on_step))
    outcome.summary = json.loads(outcome.summary)
    outcome.history = Table(outcome.history, "t")
    if check and outcome.status == "failed":
        error = _gnomon.SolutionError(outcome.diagnosis)
        error.outcome = outcome
        raise error
    return outcome
