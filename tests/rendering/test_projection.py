import numpy as np
import pytest
import shapely

from shapewright.modelling.solids import box, cylinder
from shapewright.rendering.projection import silhouette
from shapewright.shapes import Drawing, Mesh, concatenate

TOP, LEG = box((1, 0.1, 0.6), at=(0, 0.65, 0)), box((0.1, 0.6, 0.1), at=(0.4, 0.3, 0.2))
TABLE = concatenate([TOP.mesh(), LEG.mirror("x", keep=True).mirror("z", keep=True).mesh()])


def front(width, leg):
    """A top of this width and a leg on either side."""
    legs = [shapely.box(x - 0.05, 0, x + 0.05, 0.6) for x in (-leg, leg)]
    return shapely.union_all([shapely.box(-width / 2, 0.6, width / 2, 0.7), *legs])


FRONT, SIDE = front(1, 0.4), front(0.6, 0.2)


def overlap(drawing, geometry):
    ours, theirs = drawing.normalised().geometry, Drawing(geometry).normalised().geometry
    return ours.intersection(theirs).area / ours.union(theirs).area


@pytest.mark.parametrize(("view", "expected"), [("front", FRONT), ("side", SIDE), ("top", shapely.box(0, 0, 1, 0.6))])
def test_each_view_shows_what_triangles_cover(view, expected):
    assert overlap(silhouette(TABLE, view), expected) > 0.999


def test_front_and_right_are_where_they_should_be():
    cube, knob = box((1, 1, 1)).mesh(), box((0.2, 0.2, 0.2))
    wedge = concatenate([cube, knob.translate((0.6, 0.4, 0)).mesh(), knob.translate((0, 0, 0.6)).mesh()])
    front, side, top = (silhouette(wedge, view).geometry for view in ("front", "side", "top"))
    assert front.bounds[2] > 0.59 and front.contains(shapely.Point(0.59, 0.35))
    assert side.bounds[0] < -0.51  # the front is on the left, seen from the right
    assert top.bounds[1] < -0.51  # and below, seen from above


def test_soups_are_no_harder_than_solids():
    rng = np.random.default_rng(0)
    mesh = (TOP | cylinder((0.2, 0.6, 0.2), at=(0, 0.3, 0))).mesh()
    flipped = np.where(rng.random((len(mesh.faces), 1)) < 0.5, mesh.faces[:, ::-1], mesh.faces)
    doubled = np.concatenate([flipped, flipped[::3], [[0, 0, 1]]])
    corners = mesh.vertices[doubled].reshape(-1, 3) + 1e-7 * rng.standard_normal((3 * len(doubled), 3))
    soup = Mesh(corners, np.arange(len(corners)).reshape(-1, 3))
    drawing = silhouette(soup)
    assert overlap(drawing, silhouette(mesh).geometry) > 0.999
    assert drawing.geometry.geom_type == "Polygon" and shapely.get_num_coordinates(drawing.geometry) < 20


def test_slits_are_closed_and_gaps_stay():
    halves = [box((0.5, 1, 0.1), at=(x, 0.5, 0)).mesh() for x in (-0.25005, 0.25005)]
    apart = [box((0.5, 1, 0.1), at=(x, 0.5, 0)).mesh() for x in (-0.255, 0.255)]
    assert silhouette(concatenate(halves)).geometry.geom_type == "Polygon"
    assert silhouette(concatenate(apart)).geometry.geom_type == "MultiPolygon"


def test_a_sheet_seen_from_its_edge_shows_nothing():
    sheet = Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]), np.array([[0, 1, 2], [0, 2, 3]]))
    with pytest.raises(ValueError, match="shows no area from the front"):
        silhouette(sheet)
    assert overlap(silhouette(sheet, "top"), shapely.box(0, 0, 1, 1)) > 0.999
    with pytest.raises(ValueError, match="view='below'"):
        silhouette(sheet, "below")
