"""The scenes of docs/bodies.md and docs/partners.md against the calculations of these pages."""

import math

import gnomon
import numpy
import pytest


@pytest.fixture(autouse=True)
def gmsh():
    try:
        gnomon.installed("libexec/gnomon/gnomon_gmsh")
    except gnomon.Error:
        pytest.skip("built without Gmsh's library")


def confined(young, poisson):
    """Modulus of a layer that cannot move sideways."""
    return young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))


def test_a_coating_that_gets_thinner_has_the_compliance_of_what_is_left():
    history = gnomon.run(gnomon.Scene.example("worn_body/coating.toml")).history
    worn = history["wear_depth"]
    by_hand = 20 * ((0.5 - worn) / confined(1500, 0.4) + 10 / confined(70e3, 0.33))
    assert worn[-1] == pytest.approx(0.4, rel=1e-6)
    assert history["approach"] - worn == pytest.approx(by_hand, rel=1e-6)


def test_a_lining_wears_until_its_pressure_is_nearly_uniform():
    surfaces = []
    history = gnomon.run(gnomon.Scene.example("worn_body/lining.toml"),
                         on_step=lambda step: surfaces.append(step.surface)).history
    first, last = surfaces[0]["pressure"], surfaces[-1]["pressure"]
    assert first.max() == pytest.approx(3.32, rel=0.03)  # a plate on springs, without shear
    assert first.min() == 0 and 0.85 < last.min() and last.max() < 1.1
    assert history["worn_volume"][-1] == pytest.approx(5e-9 * 4 * 15 * 1e8, rel=2e-3)


def half_angle(normal, t):
    """Of the arc that touches: R c (a / cos a - sin a) = N (1/K + k v t)."""
    right = normal * (2.95 / confined(3000, 0.35) + 1e-8 * 1000 * t) / (10 * 0.05)
    low, high = 1e-6, math.pi / 2 - 1e-6
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if middle / math.cos(middle) - math.sin(middle) < right else (low, middle)
    return low


@pytest.mark.parametrize("name, friction", [("bore", 0.0), ("journal", 0.3)])
def test_a_shaft_moves_in_its_bore_as_calculated(name, friction):
    history = gnomon.run(gnomon.Scene.example(f"worn_body/{name}.toml")).history
    aside = history["approach_2"] if friction else 0 * history["approach"]
    shift = numpy.hypot(history["approach"], aside)
    by_hand = [0.05 / math.cos(half_angle(100 / math.hypot(1, friction), t)) for t in history["t"]]
    assert shift == pytest.approx(by_hand, rel=3e-3)  # the wall is no layer of springs
    assert numpy.arctan2(abs(aside), history["approach"]) == pytest.approx(math.atan(friction), abs=0.005)
