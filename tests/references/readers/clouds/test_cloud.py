import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.cloud import LEAST, MOST, Cloud, refuse_count, usable

PLACES = np.random.default_rng(0).random((LEAST + 20, 3))


def test_points_without_a_place_are_left_out_with_what_is_known_of_them_and_told():
    places = PLACES.copy()
    places[3, 1], places[7] = np.nan, np.inf
    rows = np.arange(len(places))[:, None] * np.ones(3) + 1.0
    points, notes = usable(Cloud(places, rows, rows, ("one thing",)))
    kept = np.delete(np.arange(len(places)), [3, 7])
    assert (points.positions == PLACES[kept]).all()
    assert (points.seen_from == rows[kept]).all()
    assert len(points.normals) == len(kept)
    assert notes == ("one thing", f"2 of {len(places)} points left out: their places are not finite")


def test_a_normal_that_is_not_finite_is_not_known_and_normals_that_are_all_zero_are_none():
    normals = np.tile([0.0, 0.0, 2.0], (len(PLACES), 1))
    normals[5, 0] = np.nan
    points, _ = usable(Cloud(PLACES, normals))
    assert (points.normals[4] == [0, 0, 1]).all()
    assert usable(Cloud(PLACES, np.zeros_like(PLACES)))[0].normals is None


def test_one_place_of_the_sensor_stands_for_all_and_an_unknown_one_for_none():
    assert (usable(Cloud(PLACES, seen_from=np.array([0.0, 0.0, 9.0])))[0].seen_from == [0.0, 0.0, 9.0]).all()
    assert usable(Cloud(PLACES, seen_from=np.full(3, np.nan)))[0].seen_from is None


@pytest.mark.parametrize(
    ("places", "why"),
    [
        (PLACES[:40], "only 40 points, too few to show a surface"),
        (np.vstack([PLACES[:40], np.full((500, 3), np.nan)]), "only 40 points.*; 500 of 540 points left out"),
        (np.ones((500, 3)), "all its points lie at one place"),
        (np.vstack([PLACES, [[1e308, 0, 0]]]), "too large to measure"),
        (np.empty((0, 3)), "only 0 points"),
    ],
)
def test_points_that_show_nothing_are_refused(places, why):
    with pytest.raises(UnreadableError, match=why):
        usable(Cloud(places))


def test_a_count_that_the_bytes_cannot_hold_or_that_is_beyond_all_measure_is_refused():
    refuse_count(8000, 1000)
    with pytest.raises(UnreadableError, match="declares 8,001 points in 1,000 bytes"):
        refuse_count(8001, 1000)
    with pytest.raises(UnreadableError, match="more than the"):
        refuse_count(MOST + 1, 10 * MOST)
