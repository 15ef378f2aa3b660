"""Scenes that several tests use."""

import gnomon
import pytest


@pytest.fixture
def springs():
    """The pin on springs, in closed form; 82 + 1 unknowns."""
    return gnomon.Scene.example("winkler/pin.toml", {"foundation.points": 41})


@pytest.fixture
def pin():
    """The elastic pin, coarse and short."""
    return gnomon.Scene.example("pin_on_flat/small_deformation.toml", {"mesh.elements": [6, 6], "time.end": 20})
