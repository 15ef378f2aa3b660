"""Members of the classes in C++ that are written in Python: matrices of scipy, scenes."""

from gnomon import _gnomon
from gnomon.scenes import Scene


def _jacobian(self, t, y, ydot=None, alpha=0.0, branch=None, within=None):
    """dF/dy + alpha dF/dydot as a scipy.sparse.csc_matrix, on a branch as in residual(); needs scipy."""
    import scipy.sparse
    values, rows, starts = self._jacobian(t, y, ydot, alpha, branch, within)
    return scipy.sparse.csc_matrix((values, rows, starts), shape=(self.size, self.size))


_gnomon.System.jacobian = _jacobian


def _scene(self):
    """The Scene, with the choices that follow from the size of the model."""
    return Scene.from_text(self._scene.resolved(), name=str(self._scene.path))


_gnomon.Model.scene = property(_scene)
