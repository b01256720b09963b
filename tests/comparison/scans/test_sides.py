import numpy as np

from shapewright.comparison.scans.sides import AROUND, all_sides, seen_sides, visible
from shapewright.comparison.surfaces import sample
from shapewright.modelling.solids import box

BOX = box((1.0, 1.0, 1.0)).mesh()
ON = sample(BOX, 3000)


def shown(cameras):
    return visible(BOX, ON.points, ON.normals, cameras)


def test_a_camera_shows_the_faces_in_front_of_it():
    bits = shown(all_sides(np.array([[0.0, 0.0, 2.0], [3.0, 0.0, 0.0]]))) >> len(AROUND)
    assert ((bits & 1 > 0) == (ON.normals[:, 2] > 0.5)).all()
    assert ((bits & 2 > 0) == (ON.normals[:, 0] > 0.5)).all()


def test_the_sides_are_found_by_what_they_explain():
    explained = (ON.normals[:, 2] > 0.5) | (ON.normals[:, 1] > 0.5)  # seen from the front and above
    sides = seen_sides(shown(AROUND), explained)
    seen = (shown(AROUND) & sides) != 0
    assert (seen == explained).mean() > 0.99


def test_where_nothing_is_explained_no_side_was_seen():
    assert seen_sides(shown(AROUND), np.zeros(len(ON.points), dtype=bool)) == 0


def test_a_small_surplus_does_not_hide_its_side():
    front = ON.normals[:, 2] > 0.5
    extra = front & (np.abs(ON.points[:, :2]) < 0.2).all(axis=1)
    sides = seen_sides(shown(AROUND), front & ~extra)
    assert ((shown(AROUND) & sides) != 0)[extra].all()
