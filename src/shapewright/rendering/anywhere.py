"""From where pictures of an object are taken: all that is ever supposed of a camera."""

from __future__ import annotations

from itertools import product

import numpy as np

from shapewright.rendering.cameras import Camera
from shapewright.shapes import Floats

LOW, HIGH = np.array([-100.0, -10.0, 1.0 / 6.0]), np.array([100.0, 50.0, 1.0 / 1.6])
"""Azimuth and elevation in degrees, and nearness: one over the distance, in units of the object's largest extent. The
front half and a little more; from a little below to steeply above; from a tele lens to the wide one of a telephone
that the object fills. The camera stands upright, and looks at the object's middle."""
SLACK = np.array([8.0, 5.0, 0.05])
"""How far beyond that a search may go, so that it does not end at the edge where pictures still are."""
BANK = np.array(list(product(np.linspace(-98.0, 98.0, 15), (-4.0, 10.0, 25.0, 42.0), (0.4,))))
"""(60, 3): places all over the reach, from which a search begins."""


def camera_at(place: Floats) -> Camera:
    """The camera of a place (3,)."""
    return Camera(float(place[0]), float(place[1]), float(1.0 / place[2]))


def random_places(count: int, rng: np.random.Generator) -> Floats:
    """(count, 3): uniform in the reach."""
    return rng.uniform(LOW, HIGH, (count, 3))
