"""Result files, finished or not."""

from gnomon import _gnomon
from gnomon.scenes import Scene
from gnomon.tables import Table


class Result(_gnomon._Result):
    """Reads a result: history, stored steps, fields, contact surfaces. Arrays are copies.

    Members: status, wall_seconds, problem, integrator, versions, times (of the stored steps), field_names,
    contact(t), field(name, t), grid(), model(), phase_errors. Without `t` the last stored step is meant.

    >>> import gnomon, numpy, pathlib, tempfile
    >>> folder = tempfile.TemporaryDirectory()
    >>> file = pathlib.Path(folder.name, "pin.h5")
    >>> scene = gnomon.Scene.example("pin_on_flat/small_deformation.toml", {"mesh.elements": [6, 6], "time.end": 20})
    >>> outcome = gnomon.run(scene, file)
    >>> result = gnomon.Result(file)
    >>> result.status, result.scene["time.end"], float(result.times[-1])
    ('finished', 20.0, 20.0)
    >>> numpy.allclose(result.contact()["wear_depth"].max(), numpy.linalg.norm(result.field("shape"), axis=1).max())
    True
    """

    def history(self):
        """A Table with one row per step, the start first."""
        return Table(super().history(), "t")

    @property
    def scene(self):
        """The resolved scene of the run. A mesh that it names may not be there any more: model() has it."""
        return Scene.from_text(self._scene.resolved(), name="the scene of the result")
