"""Wrong uses end in a typed exception, never in a crash."""

import concurrent.futures
import copy
import gc
import multiprocessing
import os
import pickle
import threading

import gnomon
import numpy
import pytest

nan, inf = float("nan"), float("inf")


@pytest.mark.parametrize("make, expected", [
    (lambda: gnomon.Scene(None), TypeError),
    (lambda: gnomon.Scene(3), TypeError),
    (lambda: gnomon.Scene("nowhere.toml"), gnomon.InputError),
    (lambda: gnomon.Scene("/"), gnomon.InputError),
    (lambda: gnomon.Scene(b"\xff\xfe"), (gnomon.InputError, TypeError, UnicodeError)),
    (lambda: gnomon.Scene.from_text(""), gnomon.InputError),
    (lambda: gnomon.Scene.from_text("\x00" * 100), gnomon.InputError),
    (lambda: gnomon.Scene.from_text("problem = \"" + "x" * 10**6), gnomon.InputError),
    (lambda: gnomon.Scene.from_dict({}), gnomon.InputError),
    (lambda: gnomon.Scene.from_dict({3: 4}), gnomon.InputError),
    (lambda: gnomon.Scene.from_dict({"": ""}), gnomon.InputError),
    (lambda: gnomon.Scene.from_dict({"problem": "winkler\n\"]"}), gnomon.InputError),
    (lambda: gnomon.Scene.from_dict({"problem": ["winkler"]}), gnomon.InputError),
    (lambda: gnomon.Scene.example("winkler/pin.toml", {"load.force": nan}), gnomon.InputError),
    (lambda: gnomon.Scene.example("winkler/pin.toml", {"load.force": 10**400}), gnomon.InputError),
    (lambda: gnomon.Scene.example("winkler/pin.toml", {"problem": "pin_on_flat"}), gnomon.InputError),
    (lambda: gnomon.Model("winkler"), TypeError),
    (lambda: gnomon.Model(None), TypeError),
    (lambda: gnomon._gnomon.Model.__new__(gnomon._gnomon.Model).start(), RuntimeError),
    (lambda: gnomon._gnomon.System(), TypeError),
    (lambda: gnomon.State(0, [1, 2], [1]), gnomon.InputError),
    (lambda: gnomon.State(0, [[1, 2]], [1, 2]), gnomon.InputError),
    (lambda: gnomon.State("now", [1], [1]), TypeError),
    (lambda: gnomon.Result("nowhere.h5"), gnomon.InputError),
    (lambda: gnomon.Result(__file__), gnomon.InputError),
    (lambda: gnomon.Study("nowhere"), gnomon.InputError),
    (lambda: gnomon.study("nowhere.toml", "/nowhere"), gnomon.InputError),
    (lambda: gnomon.load_plugin(__file__), gnomon.InputError),
    (lambda: gnomon.register_integrator("x", 3), TypeError),
    (lambda: gnomon.register_integrator("x", abs, order=[2]), TypeError),
    (lambda: gnomon.register_wear_law("x", None, constants=[1]), TypeError),
])
def test_wrong_arguments(make, expected):
    with pytest.raises(expected):
        make()


@pytest.mark.parametrize("use", [
    lambda model, state: model.system.residual(0, state.y[:-1], state.ydot),
    lambda model, state: model.system.residual(0, "text", state.ydot),
    lambda model, state: model.system.residual(0, state.y.reshape(1, -1), state.ydot),
    lambda model, state: model.system._jacobian(0, [], [], 1),
    lambda model, state: model.system.switching(0, [1.0] * 5),
    lambda model, state: model.system.consistent(0, state.y[:-1]),
    lambda model, state: model.observe(gnomon.State(0, [1], [1])),
    lambda model, state: model.fields(gnomon.State(0, [], [])),
    lambda model, state: model.contact(gnomon.State(0, [1], [1])),
    lambda model, state: gnomon.Stepper(model).advance(-1),
    lambda model, state: gnomon.Stepper(model).advance(nan),
    lambda model, state: gnomon.Stepper(model).advance(1e9),
    lambda model, state: gnomon.run(model, "/nowhere/r.h5"),
])
def test_wrong_arrays_states_and_times(springs, use):
    model = gnomon.Model(springs)
    with pytest.raises(gnomon.InputError):
        use(model, model.start())


def test_states_that_are_no_numbers(pin):
    model = gnomon.Model(pin)
    start = model.start()
    with pytest.raises(gnomon.SolutionError, match=r"t = 0.0: y\[0\] is not a finite number"):
        model.system.consistent(0, start.y * nan)
    for time in (nan, inf, -inf):
        with pytest.raises(gnomon.InputError, match="expected a finite time"):
            model.system.consistent(time, start.y)
    with pytest.raises(gnomon.Error):
        model.system.residual(0, start.y * 1e200, start.ydot)


def test_objects_outlive_their_owners(springs):
    system = gnomon.Model(springs).system
    stepper = gnomon.Stepper(gnomon.Model(springs))
    surfaces = []
    gnomon.run(springs, on_step=lambda step: surfaces.append(step) or True)
    gc.collect()
    state = stepper.state
    del stepper
    gc.collect()
    assert numpy.isfinite(system.residual(0, state.y, state.ydot)).all()
    assert surfaces[0].surface["pressure"].max() > 0


def test_arrays_do_not_reach_into_the_library(springs):
    model = gnomon.Model(springs)
    state = model.start()
    with pytest.raises(ValueError, match="read-only"):
        state.y[:] = nan
    model.system.row_scale[:] = 0
    assert numpy.isfinite(state.y).all() and (model.system.row_scale > 0).all()
    with pytest.raises(AttributeError):
        state.y = state.y


@pytest.mark.parametrize("name", ["model", "system", "stepper", "result"])
def test_what_cannot_be_pickled_says_so(springs, tmp_path, name):
    model = gnomon.Model(springs)
    gnomon.run(model, tmp_path / "r.h5", on_step=lambda step: True)
    things = {"model": model, "system": model.system, "stepper": gnomon.Stepper(model),
              "result": gnomon.Result(tmp_path / "r.h5")}
    with pytest.raises(TypeError):
        pickle.dumps(things[name])
    with pytest.raises(TypeError):
        copy.deepcopy(things[name])


def test_states_can_be_pickled(springs):
    state = gnomon.Model(springs).start()
    again = pickle.loads(pickle.dumps(state))
    assert again.t == state.t and (again.y == state.y).all()


@pytest.mark.parametrize("answer", ["stop", [], numpy.array([1, 2])])
def test_callbacks_that_answer_something_else(springs, answer):
    try:
        outcome = gnomon.run(springs.with_({"time.end": 1}), on_step=lambda step: answer)
        assert outcome.status in ("finished", "interrupted")
    except (TypeError, ValueError):
        pass


@pytest.mark.parametrize("raised", [SystemExit, KeyboardInterrupt, MemoryError, StopIteration, RecursionError,
                                    gnomon.SolutionError, gnomon.RecoverableError, gnomon.InputError])
def test_callbacks_that_raise(springs, raised):
    def on_step(step):
        raise raised("of the callback")

    with pytest.raises(raised):
        gnomon.run(springs, on_step=on_step)


def test_a_callback_that_runs_its_own_model(springs):
    model = gnomon.Model(springs)
    inner = []

    def on_step(step):
        if not inner:
            inner.append(gnomon.run(model, on_step=lambda step: True).status)
        return True

    assert gnomon.run(model, on_step=on_step).status == "interrupted"
    assert inner == ["interrupted"]


def test_a_callback_that_waits_for_a_thread_with_its_model(springs):
    model = gnomon.Model(springs)
    seen = []
    with concurrent.futures.ThreadPoolExecutor(1) as other:
        def on_step(step):
            seen.append(other.submit(model.contact, step.state).result(timeout=60)["pressure"].max())
            return len(seen) == 3

        assert gnomon.run(model, on_step=on_step).status == "interrupted"
    assert len(seen) == 3 and min(seen) > 0


def test_two_runs_whose_callbacks_use_the_model_of_the_other(springs):
    models = [gnomon.Model(springs), gnomon.Model(springs)]
    start, both, ended = models[0].start(), threading.Barrier(2, timeout=60), []

    def work(own, other):
        def on_step(step):
            both.wait()
            other.observe(start)
            return True

        ended.append(gnomon.run(own, on_step=on_step).status)

    threads = [threading.Thread(target=work, args=pair, daemon=True) for pair in (models, models[::-1])]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert ended == 2 * ["interrupted"]


def test_threads_on_one_model_and_on_their_own(springs, tmp_path):
    model = gnomon.Model(springs)
    ends, errors = [], []

    def work(number):
        try:
            own = model if number % 2 else gnomon.Model(springs)
            outcome = gnomon.run(own, tmp_path / f"{number}.h5")
            ends.append(outcome.history["worn_volume"][-1])
            gnomon.Result(tmp_path / f"{number}.h5").history()
        except Exception as error:  # told below, in the main thread
            errors.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    assert not errors and len(ends) == 6 and len(set(ends)) == 1


def test_threads_that_share_a_stepper_take_turns(springs):
    stepper = gnomon.Stepper(gnomon.Model(springs))
    errors = []

    def work(until):
        while True:
            try:
                stepper.advance(until=until)
            except gnomon.InputError as error:  # another thread has come there first
                assert "expected a time after" in str(error)
                return
            except Exception as error:  # told below, in the main thread
                errors.append(error)
                return

    for until in (300, 600):
        threads = [threading.Thread(target=work, args=(until,)) for _ in range(4)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            assert 0 <= stepper.state.t <= until and stepper.counters["steps"] >= 0
        for thread in threads:
            thread.join(120)
        assert not errors and stepper.state.t == until


@pytest.mark.parametrize("wrong", ["scene.toml", 3, None, {"problem": "winkler"}])
def test_what_is_no_scene_is_named(wrong):
    with pytest.raises(TypeError, match="expected a gnomon.Scene"):
        gnomon.run(wrong)
    if not isinstance(wrong, str):
        with pytest.raises(TypeError, match="expected a scene file"):
            gnomon.Scene(wrong)


def test_other_threads_go_on_during_a_run(springs):
    count, done = [0], threading.Event()

    def tick():
        while not done.is_set():
            count[0] += 1
            done.wait(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    gnomon.Stepper(gnomon.Model(springs.with_({"foundation.points": 4001}))).advance()
    done.set()
    thread.join()
    assert count[0] > 1


def _volume(scene):
    return gnomon.run(scene).history["worn_volume"][-1]


def test_fork_and_processes(springs):
    expected = _volume(springs)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(_volume, [springs, springs]).get(120) == [expected, expected]
    child = os.fork()
    if child == 0:
        os._exit(0 if _volume(springs) == expected else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_an_exit_in_the_middle_of_a_run(springs):
    import subprocess
    import sys
    program = ("import gnomon, sys\nscene = gnomon.Scene.example('winkler/pin.toml')\n"
               "gnomon.register_wear_law('law', lambda *a: 0.0)\nkept = gnomon.Stepper(gnomon.Model(scene))\n"
               "gnomon.run(scene, on_step=lambda step: sys.exit(7))")
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 7
