import pickle
import tomllib

import gnomon
import numpy
import pytest


def test_a_dictionary_is_the_same_scene_as_its_file(pin):
    assert gnomon.Scene.from_dict(pin.to_dict()) == pin
    assert gnomon.Scene.from_text(pin.resolved()) == pin


def test_dotted_names_and_tables_mean_the_same():
    springs = gnomon.Scene.example("winkler/pin.toml")
    values = springs.to_dict()
    force = values["load"].pop("force")
    values["load.force"] = numpy.float64(force)
    assert gnomon.Scene.from_dict(values) == springs


def test_values_are_read_and_replaced(pin):
    assert pin["mesh.elements"] == [6, 6]
    softer = pin.with_({"body.young_modulus": 20})
    assert softer["body.young_modulus"] == 20 and pin["body.young_modulus"] == 640
    assert softer != pin and softer != 3
    with pytest.raises(KeyError):
        pin["body.none"]


def test_a_scene_is_parsed_once(pin, monkeypatch):
    texts = []
    loads = tomllib.loads
    monkeypatch.setattr(gnomon.scenes.tomllib, "loads", lambda text: texts.append(text) or loads(text))
    assert pin["time.end"] == 20 and pin["body.young_modulus"] == 640
    pin["mesh.elements"].append(3)  # of a copy
    pin.to_dict()["time"]["end"] = 3
    assert pin["mesh.elements"] == [6, 6] and pin["time"]["end"] == 20 and len(texts) == 1


def test_all_mistakes_are_told_with_their_lines():
    text = 'problem = "winkler"\n[pin]\nradius = -1.0\nwidht = 10.0\n'
    with pytest.raises(gnomon.InputError) as error:
        gnomon.Scene.from_text(text, name="my.toml")
    lines = error.value.lines
    assert len(lines) > 2 and isinstance(error.value, ValueError)
    assert any("my.toml:3" in line and "pin.radius" in line for line in lines)
    assert any("widht" in line and "pin.width" in line for line in lines)


def test_arrays_of_tables_reach_the_scene():
    part = gnomon.Scene.example("worn_body/block_on_ring.toml")
    assert gnomon.Scene.from_dict(part.to_dict(), name=str(part.path)) == part


@pytest.mark.parametrize("value", [None, {1, 2}, object(), lambda: 1, 1j])
def test_values_without_a_meaning_in_toml_are_refused(value):
    with pytest.raises(gnomon.InputError, match="a value of a scene"):
        gnomon.Scene.from_dict({"problem": value})


def test_values_of_numpy_are_values(pin):
    assert pin.with_({"output.settle": numpy.bool_(True), "mesh.elements": numpy.array([6, 6])}) == pin


@pytest.mark.parametrize("values", [None, 3, [("problem", "winkler")]])
def test_other_things_than_dictionaries_are_refused(values):
    with pytest.raises(gnomon.InputError, match="expected a dictionary"):
        gnomon.Scene.from_dict(values)


def test_scenes_can_be_pickled(pin):
    again = pickle.loads(pickle.dumps(pin))
    assert again == pin and type(again) is gnomon.Scene


def test_mistakes_in_a_dictionary_are_named_by_key(pin):
    """Not by the option of the command line."""
    with pytest.raises(gnomon.InputError, match=r"^body\.young_modulus: expected .* got -1"):
        pin.with_({"body.young_modulus": -1})
    with pytest.raises(gnomon.InputError) as told:
        gnomon.Scene.from_dict({"problem": "pin_on_flat"}, {"load.force": "much", "pin.wide": 1})
    assert "--set" not in str(told.value) and "load.force: expected a number" in str(told.value)


def two_surfaces(names, surfaces):
    return gnomon.Scene.from_dict({
        "problem": "worn_body", "body": {"young_modulus": 1e3, "poisson_ratio": 0.3}, "support": [{"on": "bottom"}],
        "counter_body": {"shape": "plane", "normal": [0, -1], "motion.velocity": [500, 0],
                         "press": {"direction": [0, -1], "force": 10}},
        "friction.coefficient": 0, "wear": {"on": names, "coefficient": 1e-6, "surfaces": surfaces}, "time.end": 10})


@pytest.mark.parametrize("name", ["a.b", "1.5", "upper side", 'the "top"', ".", "a\U000e0001\u0001"])
def test_surfaces_may_have_any_name(name):
    """As in the mesh of which they are groups."""
    scene = two_surfaces([name, "other"], {name: {"rate": "2 * k * p * v"}, "other.rate": "k * p * v"})
    rates = {name: {"rate": "2 * k * p * v"}, "other": {"rate": "k * p * v"}}
    assert scene.to_dict()["wear"]["surfaces"] == rates and scene["wear.on"] == [name, "other"]
    assert gnomon.Scene.from_dict(scene.to_dict()) == scene


def test_quotes_hold_a_name_together():
    scene = two_surfaces(["a.b"], {}).with_({'wear.surfaces."a.b".rate': "k * p * v"})
    assert scene['wear.surfaces."a.b".rate'] == "k * p * v"
    values = scene.to_dict()
    values['wear.surfaces."a.b".rate'] = values["wear"].pop("surfaces")["a.b"]["rate"]
    assert gnomon.Scene.from_dict(values) == scene
    for wrong in ("wear.surfaces.a.b.rate", 'wear.surfaces."a.b', "wear..on", ""):
        with pytest.raises(KeyError):
            scene[wrong]
