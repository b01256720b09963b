"""Silhouettes in perspective, framed by their box."""

from dataclasses import replace

import numpy as np
import pytest

from shapewright.rendering.anywhere import camera_at
from shapewright.rendering.framed import framed, pictures_of
from shapewright.rendering.raster import view as raster_view
from shapewright.shapes.views import REACH, SIDE
from stools import overlap, stool, view


def extent(picture):
    rows, columns = (np.flatnonzero((picture > 127).any(axis=axis)) for axis in (1, 0))
    return rows[0], rows[-1] + 1, columns[0], columns[-1] + 1


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.2), (35.0, 20.0, 0.6), (-90.0, 45.0, 0.4)])
def test_the_box_of_a_silhouette_is_in_the_middle_and_its_longer_side_is_known(place):
    top, bottom, left, right = extent(framed(stool().normalised(), np.array([place]), SIDE, 2)[0])
    assert max(bottom - top, right - left) == pytest.approx(REACH * SIDE, abs=1.0)
    assert (top + bottom) / 2 == pytest.approx(SIDE / 2, abs=1.0) == pytest.approx((left + right) / 2, abs=1.0)


def test_stretched_both_sides_are_as_long():
    top, bottom, left, right = extent(framed(stool().normalised(), np.array([[10.0, 5.0, 0.3]]), SIDE, 1, True)[0])
    assert bottom - top == pytest.approx(right - left, abs=1.0) == pytest.approx(REACH * SIDE, abs=1.0)


def test_it_is_what_the_rasteriser_draws_but_for_place_and_size():
    mesh, place = stool(plinth=True).normalised(), np.array([40.0, 25.0, 0.5])
    drawn = raster_view(mesh, replace(camera_at(place), field_of_view=60.0), 512)[1] > 0.0
    top, bottom, left, right = extent(drawn * 255)
    rows = np.linspace(top, bottom - 1, 200).round().astype(int)
    columns = np.linspace(left, right - 1, 200).round().astype(int)
    ours = framed(mesh, place[None], SIDE, 2)[0]
    a, b, c, d = extent(ours)
    our_rows = np.linspace(a, b - 1, 200).round().astype(int)
    our_columns = np.linspace(c, d - 1, 200).round().astype(int)
    assert overlap(drawn[np.ix_(rows, columns)] * 255, ours[np.ix_(our_rows, our_columns)]) > 0.97


def test_near_cameras_see_the_near_side_larger():
    mesh = stool(plinth=True).normalised()
    near, far = framed(mesh, np.array([[0.0, 40.0, 0.62], [0.0, 40.0, 0.17]]), SIDE, 1) > 127
    share = [picture[: SIDE // 2].sum() / picture.sum() for picture in (near, far)]
    assert share[0] < share[1] - 0.005  # the near side is below


def test_a_view_looks_to_the_network_as_its_mesh_does():
    mesh, place = stool().normalised(), np.array([[35.0, 20.0, 0.4]])
    seen = pictures_of(view(mesh), 64)[0].astype(float)
    drawn = [framed(mesh, place, 64, 4, stretched)[0].astype(float) for stretched in (False, True)]
    assert np.abs(seen - drawn).mean() < 4.0
