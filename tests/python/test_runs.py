import os
import shutil
import signal
import subprocess
import sys
import textwrap

import gnomon
import numpy
import pytest


def test_a_run_is_that_of_the_program(pin, tmp_path):
    pin_file = gnomon._gnomon.installed("share/gnomon/problems/pin_on_flat/small_deformation.toml")
    outcome = gnomon.run(pin, tmp_path / "a.h5")
    subprocess.run([gnomon.studies._program(), "run", pin_file, "--set", "mesh.elements=[6, 6]", "--set", "time.end=20",
                    "-o", tmp_path / "b.h5", "--quiet"], check=True)
    ours, theirs = gnomon.Result(tmp_path / "a.h5"), gnomon.Result(tmp_path / "b.h5")
    assert outcome.status == "finished" == ours.status
    for name in theirs.history():
        assert numpy.array_equal(ours.history()[name], theirs.history()[name]), name
        assert numpy.array_equal(ours.history()[name], outcome.history[name]), name
    assert numpy.array_equal(ours.contact()["pressure"], theirs.contact()["pressure"])
    for name, values in ours.contact().items():
        assert numpy.array_equal(outcome.surface[name], values), name
    assert ours.scene == theirs.scene


def test_the_callback_sees_steps_and_surfaces(pin):
    seen = []

    def on_step(step):
        surface = step.surface
        seen.append((step.t, step.scalars["contact_force"], surface["pressure"], surface["worn"]))

    outcome = gnomon.run(pin, on_step=on_step)
    assert [t for t, *_ in seen] == list(outcome.history["t"])
    assert seen[-1][1] == outcome.history["contact_force"][-1]
    # Arrays stay valid, and different, after the run.
    assert seen[0][2].max() > 0 and seen[0][3].shape[1] == 3
    assert not numpy.array_equal(seen[0][3], seen[-1][3])


def test_true_ends_the_run_and_keeps_its_result(pin, tmp_path):
    outcome = gnomon.run(pin, tmp_path / "r.h5", on_step=lambda step: step.t > 5)
    assert outcome.status == "interrupted" == gnomon.Result(tmp_path / "r.h5").status
    assert 5 < outcome.state.t < 20


def test_an_exception_of_the_callback_comes_back(pin, tmp_path):
    class Own(Exception):
        pass

    def on_step(step):
        if step.t > 5:
            raise Own(step.t)

    with pytest.raises(Own):
        gnomon.run(pin, tmp_path / "r.h5", on_step=on_step)
    assert gnomon.Result(tmp_path / "r.h5").status == "interrupted"
    assert gnomon.run(pin).status == "finished"


def test_a_run_that_fails_says_why(pin):
    torn = pin.with_({"load.force": 1e9})
    with pytest.raises(gnomon.SolutionError) as error:
        gnomon.run(torn)
    assert error.value.outcome.status == "failed"
    assert gnomon.run(torn, check=False).diagnosis == str(error.value)


def test_a_result_has_the_model_with_its_mesh(tmp_path):
    example = gnomon.Scene.example("worn_body/block_on_ring.toml").path
    for name in ("block_on_ring.toml", "block_on_ring.geo"):
        shutil.copy(example.parent / name, tmp_path)
    changed = {"mesh.factor": 4, "time.end": 100, "output.times": []}
    outcome = gnomon.run(gnomon.Scene(tmp_path / "block_on_ring.toml", changed), tmp_path / "r.h5")
    result = gnomon.Result(tmp_path / "r.h5")
    assert result.scene["mesh.file"] == str(tmp_path / "block_on_ring.geo")
    (tmp_path / "block_on_ring.geo").unlink()
    with pytest.raises(gnomon.InputError, match="block_on_ring.geo"):
        gnomon.Model(result.scene)
    observed = result.model().observe(outcome.state)
    assert observed["worn_volume"] == pytest.approx(outcome.history["worn_volume"][-1], rel=1e-12)


def test_results_are_not_overwritten(pin, tmp_path):
    file = tmp_path / "r.h5"
    gnomon.run(pin, file)
    with pytest.raises(gnomon.InputError, match="r.h5"):
        gnomon.run(pin, file)
    assert gnomon.run(pin, file, force=True).status == "finished"


def test_step_by_step_is_the_same_run(springs):
    outcome = gnomon.run(springs.with_({"output.settle": False}))
    stepper = gnomon.Stepper(gnomon.Model(springs))
    times = [stepper.state.t]
    while stepper.state.t < 1000:
        stepper.advance()
        times.append(stepper.state.t)
    assert numpy.allclose(times[:5], outcome.history["t"][:5], rtol=1e-12)
    depth = stepper.model.observe(stepper.state)["worn_volume"]
    assert depth == pytest.approx(outcome.history["worn_volume"][-1], rel=1e-3)
    with pytest.raises(gnomon.InputError, match="no further step"):
        stepper.advance()


def test_ctrl_c_ends_a_run_and_keeps_its_result(tmp_path):
    program = textwrap.dedent(f"""
        import gnomon
        scene = gnomon.Scene.example("winkler/pin.toml", {{"integrator.step": 0.001}})
        def say(step):
            if step.t > 0.05:
                print("running", flush=True)
        try:
            gnomon.run(scene, {str(tmp_path / "r.h5")!r}, on_step=say)
        except KeyboardInterrupt:
            print("interrupted")
    """)
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, env=os.environ)
    assert process.stdout.readline() == "running\n"
    process.send_signal(signal.SIGINT)
    rest, _ = process.communicate(timeout=60)
    assert process.returncode == 0 and rest.endswith("interrupted\n")
    assert gnomon.Result(tmp_path / "r.h5").status == "interrupted"


def test_a_stepper_takes_the_steps_of_a_run(pin):
    """Also those in which pressures settle at the end."""
    model = gnomon.Model(pin.with_({"integrator.name": "esdirk-3", "integrator.rtol": 1e-3}))
    outcome = gnomon.run(model)
    stepper = gnomon.Stepper(model)
    while stepper.state.t < 20:
        stepper.advance()
    for name in ("steps", "newton_iterations", "factorizations"):
        assert stepper.counters[name] == outcome.counters[name]
    assert (stepper.state.y == outcome.state.y).all()
