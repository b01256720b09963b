"""From where pictures are taken."""

import numpy as np

from shapewright.rendering.anywhere import BANK, HIGH, LOW, camera_at, random_places


def test_places_are_all_over_the_reach():
    places = random_places(500, np.random.default_rng(0))
    assert (places >= LOW).all() and (places <= HIGH).all()
    assert (np.ptp(places, axis=0) > 0.95 * (HIGH - LOW)).all()


def test_the_bank_is_in_reach_and_without_repetition():
    assert (BANK >= LOW).all() and (BANK <= HIGH).all()
    assert len(np.unique(BANK, axis=0)) == len(BANK)


def test_a_place_is_a_camera():
    camera = camera_at(np.array([30.0, 10.0, 0.5]))
    assert (camera.azimuth, camera.elevation, camera.distance) == (30.0, 10.0, 2.0)
