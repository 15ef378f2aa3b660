"""Result files, finished or not."""

from gnomon import _gnomon
from gnomon.scenes import Scene
from gnomon.tables import Table


class Result(_gnomon._Result):
    """Reads a result: history, stored steps, fields, contact surfaces. Arrays are copies. Without `t` the last stored
    step is meant."""

    def history(self):
        """A Table with one row per step, the start first."""
        return Table(super().history(), "t")

    @property
    def scene(self):
        """The resolved scene of the run."""
        return Scene.from_text(self.scene_text, name="the scene of the result")
