"""Parts whose mesh is given by arrays."""

import collections.abc
import reprlib
import warnings

from gnomon import _gnomon


def _groups(given, what):
    groups = {} if given is None else given
    if not isinstance(groups, collections.abc.Mapping) or not all(isinstance(name, str) for name in groups):
        raise TypeError(f"{what}: expected a dictionary with names of groups as its keys, got {reprlib.repr(given)}")
    return dict(groups)


def assemble(scene, points, cells, facets=None, nodes=None, bodies=None):
    """The Model of a scene with problem = "worn_body", with a mesh of arrays in the place of mesh.file.

    `points` [n, 2] or [n, 3] in mm, those of a plane also with a third number of zero; `cells` [m, corners] of one
    kind, their corners in the order of VTK: triangles or quadrilaterals, in space tetrahedra, hexahedra or wedges.
    Named groups are what the scene refers to by support.on, load.on, wear.on and body.name: `facets`
    {name: [k, corners]} of the boundary, `nodes` {name: [k]}, `bodies` {name: [k] numbers of cells}; one of booleans for
    all nodes or cells does as well. Numbers begin at 0. The mesh is checked and repaired as one from a file is, and split
    (mesh.split); what was repaired is a warning. The result of a run keeps the mesh, so that it can be resumed.

    >>> import gnomon
    >>> scene = gnomon.Scene.from_dict({
    ...     "problem": "worn_body", "body": {"young_modulus": 1000, "poisson_ratio": 0.0},
    ...     "support": [{"on": "bottom"}], "wear": {"on": ["top"], "coefficient": 1e-6},
    ...     "counter_body": {"shape": "plane", "normal": [0, -1], "point": [0, 1], "motion.velocity": [500, 0],
    ...                      "press": {"direction": [0, -1], "force": 10}},
    ...     "friction.coefficient": 0, "time.end": 10, "integrator.name": "esdirk-3"})
    >>> model = gnomon.assemble(scene, points=[[0, 0], [1, 0], [1, 1], [0, 1]], cells=[[0, 1, 2, 3]],
    ...                         facets={"bottom": [[0, 1]], "top": [[2, 3]]})
    >>> f"{gnomon.run(model).history['worn_volume'][-1]:.4f} mm^2 of k F v t = {1e-6 * 10 * 500 * 10:.4f}"
    '0.0500 mm^2 of k F v t = 0.0500'
    """
    if not isinstance(scene, _gnomon.Scene):
        raise TypeError(f"expected a gnomon.Scene, got {reprlib.repr(scene)}")
    model, repaired = _gnomon._assemble(scene, points, cells, _groups(facets, "facets"), _groups(nodes, "nodes"),
                                        _groups(bodies, "bodies"))
    for remark in repaired:
        warnings.warn(remark, stacklevel=2)
    return model
