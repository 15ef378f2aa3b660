"""Parts whose mesh is given by arrays."""

import subprocess

import gnomon
import numpy
import pytest

nan = float("nan")


def block(across=12, high=4, lift=0.0):
    """A block of 2 x 1 of quadrilaterals, with its facets."""
    x, y = numpy.linspace(-1, 1, across + 1), numpy.linspace(-1, 0, high + 1)
    points = numpy.array([(a, b + lift * a * a * (1 + b)) for b in y for a in x])
    number = numpy.arange(len(points)).reshape(high + 1, across + 1)
    cells = numpy.stack([number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]], -1).reshape(-1, 4)

    def line(nodes):
        return numpy.stack([nodes[:-1], nodes[1:]], -1)
    return points, cells, {"bottom": line(number[0]), "surface": line(number[-1]), "side": line(number[:, 0])}


GEOMETRY = """Point(1) = {-1, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0, 0}; Point(4) = {-1, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 13; Transfinite Curve {2, 4} = 5; Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("bottom") = {1}; Physical Curve("surface") = {3}; Physical Curve("side") = {4};
Physical Surface("block") = {1};
"""


def scene(more=None):
    return gnomon.Scene.from_dict({
        "problem": "worn_body", "body": {"young_modulus": 1e3, "poisson_ratio": 0.3}, "support": [{"on": "bottom"}],
        "load": [{"on": "side", "traction": [0.5, 0.0]}],
        "counter_body": {"shape": "cylinder", "radius": 4, "center": [0, 4],
                         "press": {"direction": [0, -1], "force": 10}},
        "cycle": {"period": 1, "phases": 4, "x": "0.3 * sin(2*pi*tau)", "load": "1 + tau * (1 - tau)"},
        "friction.coefficient": 0.1, "wear": {"on": ["surface"], "coefficient": 1e-5},
        "time.end": 50, "integrator": {"name": "esdirk-3", "step": 10, "nonlinear_fraction": 0}}, more)


def test_a_cyclic_part_is_the_same_as_from_a_scene(tmp_path):
    try:
        gnomon.installed("libexec/gnomon/gnomon_gmsh")
    except gnomon.Error:
        pytest.skip("built without Gmsh's library")
    geometry = tmp_path / "block.geo"
    geometry.write_text(GEOMETRY)
    theirs = gnomon.run(scene({"mesh.file": geometry}))
    ours = gnomon.run(gnomon.assemble(scene(), *block()))
    for name in ("worn_volume", "approach", "max_pressure", "wear_depth"):
        assert ours.history[name] == pytest.approx(theirs.history[name], rel=1e-8), name
    assert ours.history["worn_volume"][-1] > 1e-3


def test_orientation_and_order_do_not_matter():
    points, cells, facets = block(6, 3)
    force = gnomon.run(gnomon.assemble(scene(), points, cells, facets)).history["max_pressure"][-1]
    order = numpy.random.default_rng(1).permutation(len(points))
    where = numpy.argsort(order)
    mixed = gnomon.assemble(scene(), points[order], where[cells][::-1, ::-1],
                            {name: where[group][::-1, ::-1] for name, group in facets.items()})
    assert gnomon.run(mixed).history["max_pressure"][-1] == pytest.approx(force, rel=1e-8)


def test_layers_are_springs_in_series():
    points, cells, facets = block(2, 4)
    upper = [cell for cell, nodes in enumerate(cells) if points[nodes, 1].mean() > -0.5]
    bodies = [{"name": name, "young_modulus": modulus, "poisson_ratio": 0.0, "material": "linear"}
              for name, modulus in (("lower", 2e4), ("upper", 1e3))]
    layered = gnomon.Scene.from_dict({
        "problem": "worn_body", "body": bodies, "support": [{"on": "bottom", "directions": ["y"]}, {"on": "corner"}],
        "counter_body": {"shape": "plane", "normal": [0, -1], "motion.velocity": [1, 0],
                         "press": {"direction": [0, -1], "approach": 1e-3}},
        "friction.coefficient": 0, "wear": {"on": ["surface"], "coefficient": 0}, "time.end": 1,
        "integrator.name": "esdirk-3"})
    model = gnomon.assemble(layered, points, cells, facets, nodes={"corner": [0]},
                            bodies={"upper": upper, "lower": [c for c in range(len(cells)) if c not in upper]})
    pressure = model.contact(model.start())["pressure"]
    assert pressure == pytest.approx(1e-3 / (0.5 / 2e4 + 0.5 / 1e3), rel=1e-6)


def test_a_tetrahedron_is_subdivided_with_a_warning():
    points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, -1]]
    text = {"problem": "worn_body", "body": {"young_modulus": 1e3, "poisson_ratio": 0.3},
            "support": [{"on": "sides"}],
            "counter_body": {"shape": "plane", "normal": [0, 0, -1], "motion.velocity": [1, 0, 0],
                             "press": {"direction": [0, 0, -1], "force": 1}},
            "friction.coefficient": 0, "wear": {"on": ["top"], "coefficient": 1e-6}, "time.end": 1,
            "integrator.name": "esdirk-3"}
    with pytest.warns(UserWarning, match="1 tetrahedron"):
        model = gnomon.assemble(gnomon.Scene.from_dict(text), points, [[0, 1, 2, 3]],
                                {"top": [[0, 1, 2]], "sides": [[0, 1, 3], [1, 2, 3], [0, 2, 3]]})
    assert model.grid()["cells"].shape == (4, 8)


def test_its_result_goes_on_without_the_arrays(tmp_path):
    file = tmp_path / "block.h5"
    ended = gnomon.run(gnomon.assemble(scene(), *block()), file, on_step=lambda step: step.t > 20)
    assert ended.status == "interrupted"
    assert gnomon.Result(file).model().grid()["points"].shape == (65, 3)
    subprocess.run([gnomon.studies._program(), "resume", str(file), "--quiet"], check=True)
    whole = gnomon.run(gnomon.assemble(scene(), *block()))
    assert gnomon.Result(file).history()["worn_volume"][-1] == pytest.approx(whole.history["worn_volume"][-1], rel=1e-3)


@pytest.mark.parametrize("change, expected", [
    ({"points": [[0.0, nan], [1, 0], [1, 1], [0, 1]]}, "finite coordinates"),
    ({"points": [1.0, 2.0]}, "points: expected numbers in rows of two"),
    ({"points": "none"}, "points: expected numbers"),
    ({"cells": [[0, 1, 2, 4]]}, "cells: expected numbers from 0 to 3, got 4"),
    ({"cells": [[0, 1, 2, -1]]}, "got -1"),
    ({"cells": [[0.5, 1, 2, 3]]}, "cells: expected whole numbers"),
    ({"cells": [0, 1, 2, 3]}, "cells: expected whole numbers in two dimensions"),
    ({"cells": numpy.array([[0, 1, 2, 3]]) > 0}, "cells: expected whole numbers"),
    ({"points": numpy.zeros((0, 2))}, "points: expected numbers in rows of two"),
    ({"points": numpy.array([[-1, -1], [1, -1], [1, 0], [-1, 0]]) + 0j}, "points: expected numbers in rows of two"),
    ({"bodies": {"all": [True, False]}}, "cells of \"all\": expected numbers, or 1 booleans"),
    ({"cells": [[0, 1]]}, "no element of 2 dimensions has 2 corners"),
    ({"facets": {"bottom": [[0, 1]], "surface": [[0, 2]], "side": [[3, 0]]}}, "surface"),
    ({"facets": {"bottom": [[0, 1]], "side": [[3, 0]]}}, "surface"),
    ({"bodies": {"all": [1]}}, "cells of \"all\": expected numbers from 0 to 0"),
    ({"scene": gnomon.Scene.example("winkler/pin.toml")}, "expected \"worn_body\""),
])
def test_what_is_wrong_is_refused(change, expected):
    given = {"scene": scene(), "points": [[-1.0, -1], [1, -1], [1, 0], [-1, 0]], "cells": [[0, 1, 2, 3]],
             "facets": {"bottom": [[0, 1]], "surface": [[2, 3]], "side": [[3, 0]]}} | change
    with pytest.raises(gnomon.InputError, match=expected):
        gnomon.assemble(**given)


@pytest.mark.parametrize("change, expected", [
    ({"scene": {"problem": "worn_body"}}, "^expected a gnomon.Scene, got {'problem'"),
    ({"facets": [[0, 1]]}, "^facets: expected a dictionary with names"),
    ({"nodes": {3: [0]}}, "^nodes: expected a dictionary with names of groups as its keys, got {3: "),
    ({"bodies": numpy.zeros(3)}, "^bodies: expected a dictionary"),
])
def test_what_is_no_dictionary_of_groups_is_named(change, expected):
    points, cells, facets = block()
    given = {"scene": scene(), "points": points, "cells": cells, "facets": facets} | change
    with pytest.raises(TypeError, match=expected):
        gnomon.assemble(**given)


def test_facets_are_numbered_within_their_group():
    points, cells, facets = block(4, 2)
    inner = [[5, 6]]
    with pytest.raises(gnomon.InputError, match='1 of its 3 facets lie inside .*, the first has the number 2'):
        gnomon.assemble(scene(), points, cells, facets | {"surface": numpy.vstack([facets["surface"][:2], inner])})


def test_groups_may_be_masks():
    points, cells, facets = block()
    held = numpy.array(points)[:, 1] == min(y for _, y in points)
    by_nodes = scene({"support.1.on": "held"})
    pressures = [gnomon.assemble(by_nodes, points, numpy.array(cells, dtype=numpy.uint64), facets, {"held": nodes})
                 for nodes in (held, numpy.flatnonzero(held))]
    first, second = [model.contact(model.start())["pressure"] for model in pressures]
    assert first.tolist() == second.tolist()


def test_a_scene_with_a_mesh_of_its_own_is_refused():
    with pytest.raises(gnomon.InputError, match="expected none beside arrays"):
        gnomon.assemble(scene({"mesh.file": "block.msh"}), *block())


def test_a_mistake_is_told_without_the_mesh_that_follows():
    with pytest.raises(gnomon.InputError, match="young_modul.*: unknown key") as refused:
        scene({"body.young_modul": 3})
    assert "mesh" not in str(refused.value)


def test_points_of_a_plane_may_have_a_third_number(tmp_path):
    points, cells, facets = block()
    flat = numpy.column_stack([points, numpy.zeros(len(points))])
    worn = [gnomon.run(gnomon.assemble(scene(), given, cells, facets)).history["worn_volume"][-1]
            for given in (points, flat)]
    assert worn[0] == worn[1]


def test_keys_of_mesh_files_are_refused_or_have_their_effect():
    for key in ("mesh.factor", "mesh.contact_size", "accuracy.within"):
        with pytest.raises(gnomon.InputError, match=f"{key}.*: expected none beside arrays"):
            gnomon.assemble(scene({key: 0.1}), *block())
    gnomon.assemble(scene().with_({"time.end": 40}), *block())
    cells = [len(gnomon.assemble(scene({"mesh.split": split}), *block()).grid()["cells"]) for split in (0, 1)]
    assert cells[1] == 4 * cells[0]


def test_a_plan_is_a_scene_and_comes_from_one():
    example = gnomon.Scene.example("pin_on_flat/small_deformation.toml",
                                   {"mesh.elements": [6, 6], "time.end": 20, "accuracy.within": 0.5})
    planned, table = gnomon.plan(example)
    assert planned["integrator.rtol"] > 0 and planned.with_({"time.end": 10})["time.end"] == 10 and "CPU" in table
    for ask in (gnomon.plan, gnomon.budget):
        with pytest.raises(TypeError, match="expected a gnomon.Scene, got Model"):
            ask(gnomon.Model(gnomon.Scene.example("winkler/pin.toml")))


def growing():
    """Contact grows over boundary beside wear.on, which is met in later epochs."""
    points, cells, facets = block(24, 4)
    top = facets.pop("surface")
    facets |= {"surface": top[10:14], "beside": numpy.vstack([top[:10], top[14:]])}
    text = scene().to_dict()
    text.pop("cycle"), text.pop("load")
    text |= {"counter_body": {"shape": "cylinder", "radius": 4, "center": [0, 4], "motion.velocity": [500, 0],
                              "press": {"direction": [0, -1], "force": 0.2, "times": [0, 10, 50],
                                        "factors": [1, 1, 200]}},
             "body": {"young_modulus": 1e3, "poisson_ratio": 0.3, "material": "linear"},
             "wear": {"on": ["surface"], "coefficient": 0},
             "integrator": {"name": "esdirk-3", "rtol": 1e-3}}
    return gnomon.assemble(gnomon.Scene.from_dict(text), points, cells, facets)


def test_models_of_later_epochs_are_those_of_their_states():
    model, seen = growing(), []

    def look(step):
        surface = step.surface
        seen.append((surface["pressure"].size, surface["pressure"].max(), step.scalars["max_pressure"]))
    outcome = gnomon.run(model, on_step=look)
    assert seen[-1][0] > seen[0][0]
    assert [largest for _, largest, _ in seen] == pytest.approx([observed for _, _, observed in seen], rel=1e-9)
    last = outcome.model.observe(outcome.state)
    assert last["max_pressure"] == outcome.history["max_pressure"][-1]

    stepper = gnomon.Stepper(model)
    while stepper.state.t < 50:
        stepper.advance()
    assert stepper.model.observe(stepper.state)["max_pressure"] == pytest.approx(last["max_pressure"], rel=1e-6)
    assert gnomon.Stepper(stepper.model).state.y.size == model.start().y.size


# 0.05 mm/s of 1 mm.
@pytest.mark.parametrize("integrator", [{"name": "esdirk-3", "rtol": 1e-7}, {"name": "bdf", "rtol": 1e-3},
                                        {"name": "backward-euler", "step": 7}])
def test_what_wears_through_ends_when_it_does(integrator):
    text = {"problem": "worn_body", "body": {"young_modulus": 1e3, "poisson_ratio": 0.0, "material": "linear"},
            "support": [{"on": "bottom"}], "wear": {"on": ["surface"], "coefficient": 1e-5}, "shape.motion": "gap",
            "counter_body": {"shape": "plane", "normal": [0, -1], "point": [0, 0], "motion.velocity": [500, 0],
                             "press": {"direction": [0, -1], "force": 20}},
            "friction.coefficient": 0, "time.end": 60, "integrator": integrator}
    points, cells, facets = block(6, 3)
    model = gnomon.assemble(gnomon.Scene.from_dict(text), points, cells, facets)
    ended = gnomon.run(model, check=False)
    assert "worn through" in ended.diagnosis
    assert ended.history["t"][-1] == pytest.approx(20, rel=0.02)
    assert 0 < ended.history["thickness_left"][-1] < 0.02
    stepper = gnomon.Stepper(model)
    with pytest.raises(gnomon.SolutionError, match="worn through"):
        while not stepper.ended:
            stepper.advance()


def test_a_stepper_ends_as_its_run():
    model = gnomon.assemble(scene({"time.until": "wear_depth > 1e-3"}), *block())
    stepper = gnomon.Stepper(model)
    while not stepper.ended:
        stepper.advance()
    assert stepper.state.t == gnomon.run(model).history["t"][-1] < 50
    with pytest.raises(gnomon.InputError, match="no further step"):
        stepper.advance()
