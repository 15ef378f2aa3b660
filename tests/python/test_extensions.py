import gc
import math
import subprocess
import sys
import weakref

import gnomon
import numpy
import pytest


class Heun:
    """Explicit, of order two."""

    def __init__(self, system, settings):
        self.system, self.settings = system, settings

    def advance(self, state, until):
        h = min(self.settings["step"], until - state.t)
        predicted = self.system.consistent(state.t + h, state.y + h * state.ydot)
        mean = (state.ydot + predicted.ydot) / 2
        return self.system.consistent(state.t + h, state.y + h * mean)


gnomon.register_integrator("python-heun", Heun, help="Heun's method", order="2")


def error(scene, step):
    state = gnomon.run(scene.with_({"integrator.name": "python-heun", "integrator.step": step,
                                    "output.settle": False})).state
    system = gnomon.Model(scene).system
    exact = gnomon.run(scene.with_({"integrator.name": "esdirk-4", "integrator.rtol": 1e-10,
                                    "integrator.atol": 1e-14})).state
    return numpy.linalg.norm((state.y - exact.y)[system.differential])


def test_an_integrator_in_python_has_its_order():
    # Without switching nodes: the whole width is in contact from the start.
    scene = gnomon.Scene.example("winkler/pin.toml", {"foundation.points": 21, "pin.width": 1.0, "time.end": 100})
    assert "python-heun" in gnomon.integrators()
    order = math.log2(error(scene, 10) / error(scene, 5))
    assert 1.8 < order < 2.2


def test_a_wear_law_in_python_is_archards_where_it_says_so(pin):
    gnomon.register_wear_law("python-archard", lambda p, v, h, q, t, s, x, K: K * p * v, {"K": 1e-7})
    ours = gnomon.run(pin.with_({"wear.law": "python-archard"}))
    theirs = gnomon.run(pin)
    assert ours.history["worn_volume"][-1] == pytest.approx(theirs.history["worn_volume"][-1], rel=1e-6)
    assert ours.counters["newton_iterations"] == theirs.counters["newton_iterations"]
    twice = gnomon.run(pin.with_({"wear.law": "python-archard", "wear.K": 2e-7}))
    assert twice.history["wear_integral"][-1] == pytest.approx(2 * theirs.history["wear_integral"][-1], rel=1e-3)


def test_exceptions_of_a_law_come_back(pin):
    def broken(p, v, h, q, t, s, x):
        raise ZeroDivisionError("of the law")

    gnomon.register_wear_law("python-broken", broken)
    with pytest.raises(ZeroDivisionError, match="of the law"):
        gnomon.run(pin.with_({"wear.law": "python-broken"}))


def heun(scene, name, **registered):
    gnomon.register_integrator(name, Heun, **registered)
    return gnomon.run(scene.with_({"integrator.name": name, "integrator.step": 10, "time.end": 50}))


@pytest.mark.parametrize("given, expected", [({"order": "2"}, 2), ({"order": 2}, 2), ({"order": "1-2"}, 0), ({}, 0)])
def test_steps_are_counted_and_have_the_order_that_was_registered(springs, given, expected):
    outcome = heun(springs, "python-counted", **given)
    assert outcome.counters["steps"] == 5 == outcome.summary["steps"]
    assert outcome.history["order"].tolist() == [0] + 5 * [expected]
    # The work of system.consistent: at least one iteration in each of two solves.
    assert (outcome.history["newton_iterations"][1:] >= 2).all()
    start = gnomon.run(springs, on_step=lambda step: True).counters["newton_iterations"]
    assert outcome.counters["newton_iterations"] == start + outcome.history["newton_iterations"][1:].sum()


def test_a_method_of_variable_order_tells_it(springs):
    class Varies(Heun):
        def advance(self, state, until):
            self.order = 1 + int(state.t) // 10
            return super().advance(state, until)

    gnomon.register_integrator("python-varies", Varies, order="1-5")
    changed = {"integrator.name": "python-varies", "integrator.step": 10, "time.end": 50}
    assert gnomon.run(springs.with_(changed)).history["order"].tolist() == [0, 1, 2, 3, 4, 5]


def test_a_law_with_other_constants_needs_scenes_that_know_them(springs):
    gnomon.register_wear_law("python-changes", lambda p, v, h, q, t, s, x, K: K * p * v, {"K": 1e-7})
    before = springs.with_({"wear.law": "python-changes", "time.end": 10})
    gnomon.register_wear_law("python-changes", lambda p, v, h, q, t, s, x, C: C * p * v, {"C": 1e-7})
    with pytest.raises(gnomon.InputError, match="wear.law.*registered again, with the constant C"):
        gnomon.run(before)
    assert gnomon.run(springs.with_({"wear.law": "python-changes", "time.end": 10})).status == "finished"


def test_a_result_with_a_law_that_is_not_there_says_how_it_is_loaded(springs, tmp_path):
    gnomon.register_wear_law("python-stored", lambda p, v, h, q, t, s, x: 1e-7 * p * v)
    gnomon.run(springs.with_({"wear.law": "python-stored", "time.end": 5}), tmp_path / "used.h5")
    gnomon.run(springs.with_({"time.end": 5}), tmp_path / "unused.h5")
    assert gnomon.Result(tmp_path / "used.h5").scene["wear.law"] == "python-stored"

    def resume(name):
        return subprocess.run([gnomon.studies._program(), "resume", name, "--end", "10", "--quiet"], cwd=tmp_path,
                              capture_output=True, text=True, check=False)

    assert resume("unused.h5").returncode == 0
    refused = resume("used.h5")
    assert refused.returncode == 2 and refused.stderr.count("\n") == 1
    assert "wear.law" in refused.stderr and "if the run had a plug-in, load it by --plugin" in refused.stderr
    program = f"import gnomon; gnomon.Result({str(tmp_path / 'used.h5')!r}).scene"
    other = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert "gnomon.InputError: " in other.stderr and "load it by gnomon.load_plugin" in other.stderr


def test_a_name_of_python_may_be_registered_again(pin):
    for rate in (1e-7, 2e-7):
        gnomon.register_wear_law("python-again", lambda p, v, h, q, t, s, x, rate=rate: rate * p * v)
        worn = gnomon.run(pin.with_({"wear.law": "python-again"})).history["wear_integral"][-1]
        assert worn == pytest.approx(rate * 20 * 1000 * 20, rel=1e-3)


def test_what_was_registered_before_lives_as_long_as_its_models(springs):
    alive = []

    def register(K):
        def rate(p, v, h, q, t, s, x):
            return K * p * v

        class Method(Heun):
            pass

        gnomon.register_wear_law("python-forgotten", rate)
        gnomon.register_integrator("python-forgotten", Method)
        alive.append((weakref.ref(rate), weakref.ref(Method)))

    def living():
        gc.collect()
        return [(rate() is not None, method() is not None) for rate, method in alive]

    register(1e-7)
    model = gnomon.Model(springs.with_({"wear.law": "python-forgotten", "time.end": 10}))
    for K in (2e-7, 3e-7):
        register(K)
    assert living() == [(True, False), (False, False), (True, True)]
    first = gnomon.run(model).history["wear_integral"][-1]
    assert first == pytest.approx(1e-7 * springs["load.force"] * springs["wear.velocity"] * 10, rel=1e-3)
    del model
    assert living() == [(False, False), (False, False), (True, True)]


def test_a_method_may_register_its_name_again_while_it_is_made(springs):
    def make(system, settings):
        gnomon.register_integrator("python-restless", make)
        gc.collect()
        return Heun(system, settings)

    gnomon.register_integrator("python-restless", make)
    assert gnomon.run(springs.with_({"integrator.name": "python-restless", "integrator.step": 10,
                                     "time.end": 20})).counters["steps"] == 2


def test_other_names_are_registered_once():
    with pytest.raises(gnomon.Error, match="registered twice"):
        gnomon.register_integrator("bdf", Heun)


@pytest.mark.parametrize("answer", [None, 3, "state"])
def test_an_integrator_that_returns_no_state_is_refused(springs, answer):
    name = f"python-returns-{answer}"
    gnomon.register_integrator(name, lambda system, settings: type("S", (), {"advance": lambda *_: answer})())
    with pytest.raises(TypeError, match="expected a gnomon.State"):
        gnomon.run(springs.with_({"integrator.name": name, "integrator.step": 1}))


def test_steps_end_at_jumps_of_loads(pin):
    """The worn area is k times the force times the path, by steps that know nothing of the jump at 5 s."""
    given = pin.with_({"load.times": [0, 5, 5, 10], "load.factors": [1, 1, 3, 1], "time.end": 10,
                       "wear.normal": "conservative"})
    outcome = gnomon.run(given.with_({"integrator.name": "python-heun", "integrator.step": 3}))
    worn = given["wear.coefficient"] * given["wear.velocity"] * given["load.force"] * (5 + 10)
    assert outcome.history["worn_volume"][-1] == pytest.approx(worn, rel=1e-6)


def test_an_integrator_may_fail_as_others_do(springs):
    class Gives:
        def __init__(self, *_):
            pass

        def advance(self, state, until):
            raise gnomon.SolutionError("no step can be taken")

    gnomon.register_integrator("python-gives-up", Gives)
    outcome = gnomon.run(springs.with_({"integrator.name": "python-gives-up", "integrator.step": 1}), check=False)
    assert outcome.status == "failed" and outcome.diagnosis == "no step can be taken"


def test_the_system_of_a_run_ends_with_it(springs):
    kept = []

    class Keeps(Heun):
        def __init__(self, system, settings):
            kept.append(system)
            super().__init__(system, settings)

    gnomon.register_integrator("python-keeps", Keeps)
    gnomon.run(springs.with_({"integrator.name": "python-keeps", "integrator.step": 10, "time.end": 20}))
    with pytest.raises(gnomon.Error, match="has ended"):
        kept[0].size


def test_laws_keep_their_own_constants(springs):
    worn = []
    for name, K in (("python-first", 1e-7), ("python-second", 3e-7)):
        gnomon.register_wear_law(name, lambda p, v, h, q, t, s, x, K: K * p * v, {"K": K})
    for name in ("python-first", "python-second"):
        worn.append(gnomon.run(springs.with_({"wear.law": name})).history["wear_integral"][-1])
    assert worn[1] / worn[0] == pytest.approx(3, rel=1e-2)


def test_a_law_needs_no_coefficient():
    gnomon.register_wear_law("python-own", lambda p, v, h, q, t, s, x, K: K * p * v, {"K": 1e-5})
    x = numpy.linspace(-1, 1, 5)
    points = numpy.array([(a, b) for b in (-1, 0) for a in x])
    cells = numpy.array([(i, i + 1, i + 6, i + 5) for i in range(4)])
    lines = {name: numpy.stack([nodes[:-1], nodes[1:]], -1)
             for name, nodes in (("bottom", numpy.arange(5)), ("top", numpy.arange(5, 10)))}
    scene = gnomon.Scene.from_dict({
        "problem": "worn_body", "body": {"young_modulus": 1e3, "poisson_ratio": 0.3}, "support": [{"on": "bottom"}],
        "counter_body": {"shape": "plane", "normal": [0, -1], "motion": {"velocity": [2, 0]},
                         "press": {"direction": [0, -1], "force": 10}},
        "wear": {"on": ["top"], "law": "python-own"}, "time.end": 50})
    worn = gnomon.run(gnomon.assemble(scene, points, cells, lines)).history["worn_volume"][-1]
    assert worn == pytest.approx(1e-5 * 10 * 2 * 50, rel=1e-4)


@pytest.mark.parametrize("answer", [None, "1", 1j, numpy.array([1.0, 2.0])])
def test_a_law_that_returns_no_number_is_told(springs, answer):
    gnomon.register_wear_law("python-no-number", lambda *_: answer)
    with pytest.raises(TypeError, match="expected a number"):
        gnomon.run(springs.with_({"wear.law": "python-no-number"}))


@pytest.mark.parametrize("name, rate, constants", [
    ("", abs, {}), ("a b", abs, {}), (3, abs, {}), ("x", 3, {}), ("x", abs, {"p": 1}), ("x", abs, {"rate": 1}),
    ("x", abs, {"a b": 1}), ("x", abs, {"K": float("nan")}), ("x", abs, {"K": "a"}),
    ("x", abs, {"lambda": 1}),
])
def test_names_that_cannot_be_keys_are_refused(name, rate, constants):
    with pytest.raises((gnomon.InputError, TypeError)):
        gnomon.register_wear_law(name, rate, constants)
