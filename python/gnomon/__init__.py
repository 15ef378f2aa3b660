"""gnomon computes how wear changes the shape of bodies over time.

    >>> import gnomon
    >>> scene = gnomon.Scene.example("winkler/pin.toml").with_({"foundation.points": 41})
    >>> outcome = gnomon.run(scene)
    >>> outcome.status
    'finished'
    >>> outcome.history["t"][-1]
    1000.0
"""

from gnomon._gnomon import (Error, InputError, Model, RecoverableError, SolutionError, State, Step, Stepper, System,
                            __version__, installed, integrators, problems, versions, wear_laws)
from gnomon.accuracy import budget, plan
from gnomon.extensions import load_plugin, register_integrator, register_wear_law
from gnomon.parts import assemble
from gnomon.results import Result
from gnomon.runs import Outcome, run
from gnomon.scenes import Scene
from gnomon.studies import Study, study
from gnomon import systems as _systems  # adds members to Model and System

__all__ = ["Error", "InputError", "Model", "Outcome", "RecoverableError", "Result", "Scene", "SolutionError", "State",
           "Step", "Stepper", "Study", "System", "__version__", "assemble", "budget", "installed", "integrators",
           "load_plugin", "plan", "problems", "register_integrator", "register_wear_law", "run", "study", "versions",
           "wear_laws"]
