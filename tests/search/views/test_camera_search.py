"""The camera of a picture, found for a mesh."""

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright.comparison.blurred import PARTS
from shapewright.search.views.camera_search import CameraSearch, ViewsDifference, parts_of
from stools import stool, view, views


@pytest.mark.parametrize("place", [(-70.0, 5.0, 0.25), (0.0, 30.0, 0.5), (33.0, 12.0, 0.6), (95.0, 45.0, 0.4)])
def test_the_camera_of_a_picture_of_the_same_mesh_is_found(place):
    mesh = stool().normalised()
    found = CameraSearch(view(mesh, place)).found(mesh)
    assert found.place[:2] == pytest.approx(place[:2], abs=1.0)
    assert found.camera.azimuth == found.place[0] and found.cost < 1500.0


def test_a_mesh_has_the_same_camera_whatever_was_looked_at_before():
    search, mesh = CameraSearch(view(stool())), stool(width=0.8).normalised()
    first = search.found(mesh)
    search.found(stool(plinth=True).normalised())
    assert (search.found(mesh).place == first.place).all()


def test_another_object_costs_more():
    search = CameraSearch(view(stool()))
    same, other = (search.found(mesh.normalised()).cost for mesh in (stool(), stool(plinth=True)))
    assert other > 5.0 * same


def test_residuals_have_one_form_whatever_the_number_of_views():
    one, two = views(stool()), views(stool(), (35.0, 20.0, 0.4), (-40.0, 10.0, 0.4))
    lengths = {len(ViewsDifference(each, most=2).residual(stool())) for each in (one, two)}
    assert lengths == {2 * PARTS[-1].stop} and parts_of(2)[-1].stop == 2 * PARTS[-1].stop
    fine = ViewsDifference(two, most=2).residual(stool(plinth=True))[parts_of(2)[-1]]
    assert np.abs(fine).sum() > 0.0


def test_a_drawing_cannot_be_compared():
    assert ViewsDifference(views(stool())).residual(sw.Drawing(shapely.box(0, 0, 1, 1))) is None
