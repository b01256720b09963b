import numpy as np
import pytest

from shapewright.feedback.surfaces.placement import best_fit
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Mesh, concatenate


def table(height=0.7, stretcher=False, back=False):
    top = box((1, 0.06, 0.6), at=(0, height - 0.03, 0)).label("top")
    leg = box((0.06, height, 0.06), at=(0.45, height / 2, 0.25)).label("legs")
    shape = top | leg.mirror("x", keep=True).mirror("z", keep=True)
    if stretcher:
        shape = shape | box((0.9, 0.06, 0.06), at=(0, 0.2, 0)).label("stretcher")
    if back:
        shape = shape | box((1, 0.6, 0.06), at=(0, height + 0.3, -0.27)).label("back")
    return shape.mesh()


def share(found, side):
    return sum(region.share for region in found.of(side))


def soup(mesh, seed=0):
    """Every triangle its own, half of them inside out, one part twice, a solid cube hidden inside the top."""
    rng = np.random.default_rng(seed)
    flipped = rng.random(len(mesh.faces)) < 0.5
    faces = np.where(flipped[:, None], mesh.faces[:, ::-1], mesh.faces)
    loose = Mesh(mesh.vertices[faces].reshape(-1, 3), np.arange(3 * len(faces)).reshape(-1, 3))
    inner = box((0.3, 0.04, 0.3), at=(0, 0.67, 0)).mesh()
    return concatenate([loose, loose, Mesh(inner.vertices, inner.faces)])


def test_equal_shapes_have_no_regions_whatever_their_size_and_place():
    moved = table().transformed(np.array([[3, 0, 0, 5], [0, 3, 0, 1], [0, 0, 3, 0], [0, 0, 0, 1]]))
    found = residuals(table(), moved)
    assert found.regions == () and share(found, "unexplained") == share(found, "surplus") == 0.0
    assert found.to_replica.max() < 0.02
    assert np.allclose(found.placement.apply(moved.vertices), table().normalised().vertices, atol=1e-6)


@pytest.mark.parametrize("make", [lambda mesh: mesh, soup])
def test_a_missing_part_is_one_region_in_its_place(make):
    found = residuals(make(table(stretcher=True)), table())
    (region,) = found.regions
    assert region.side == "unexplained" and region.label == "legs"
    assert np.allclose(region.box.centre, (0, 0.2 - 0.35, 0), atol=0.03)
    assert np.allclose(region.box.size, (0.84, 0.06, 0.06), atol=0.07)
    assert np.allclose(region.box.axes, np.eye(3))
    assert region.share == pytest.approx(0.84 * 4 * 0.06 / VisibleSurface.of(table(stretcher=True)).area, rel=0.2)
    assert 0.2 < region.distance < 0.35 and share(found, "surplus") == 0.0
    assert share(found, "unexplained") == region.share


def test_a_surplus_part_bears_its_own_label():
    (region,) = residuals(table(), table(stretcher=True)).regions
    assert region.side == "surplus" and region.label == "stretcher"
    assert region.points.shape == (len(region.rows), 3)


def test_a_part_that_moves_the_bounding_box_does_not_move_the_rest():
    found = residuals(table(back=True), table())
    surfaces = [VisibleSurface.of(mesh.normalised()) for mesh in (table(back=True), table())]
    assert best_fit(*surfaces).anchors[1] == 0.0
    (region,) = found.regions
    assert region.side == "unexplained" and region.label == "top"
    assert region.box.centre[1] == pytest.approx((1.0 - 0.65) / 1.3, abs=0.03)
    assert found.placement.scale == pytest.approx(1 / 1.3, rel=0.02)


def test_faces_of_a_region_are_those_of_its_side():
    mesh = table(stretcher=True)
    found = residuals(mesh, table())
    (region,) = found.regions
    assert {mesh.labels[face] for face in found.reference.faces[region.rows]} == {"stretcher"}


def test_a_turned_part_has_a_turned_box():
    bar = box((0.5, 0.05, 0.05)).rotate(40, "y").translate((0, 0.2, 0))
    reference = concatenate([table(), Mesh(bar.mesh().vertices, bar.mesh().faces)])
    (region,) = residuals(reference, table()).regions
    assert sorted(region.box.size)[2] == pytest.approx(0.5, abs=0.05) and sorted(region.box.size)[1] < 0.1
    assert abs(region.box.axes[0] @ np.array([np.cos(np.radians(40)), 0, -np.sin(np.radians(40))])) > 0.98
    assert np.allclose(region.box.axes @ region.box.axes.T, np.eye(3))


def test_what_lies_inside_is_not_seen():
    around, within = box((1, 1, 1)).mesh(), cylinder((0.5, 0.5, 0.5)).mesh()
    surface = VisibleSurface.of(concatenate([around, within]), 2000)
    of_cube = surface.faces < len(around.faces)
    assert surface.visible[of_cube].mean() > 0.99 and not surface.visible[~of_cube].any()
    assert surface.area == pytest.approx(6.0, rel=0.05)


def test_distance_is_to_the_surface_not_to_the_nearest_sample():
    surface = VisibleSurface.of(box((1, 1, 1)).mesh(), 3000)
    rng = np.random.default_rng(0)
    points = np.column_stack([rng.uniform(-0.4, 0.4, (100, 2)), np.full(100, 0.6)])
    assert np.allclose(surface.distance(points), 0.1, atol=1e-3)
    assert np.all(surface.distance(points * [1, 1, 0] + [0, 0, 0.5]) < 0.01)


def test_a_mesh_without_area_is_refused():
    flat = Mesh(np.array([[0, 0, 0], [1, 0, 0], [0.5, 0, 0]]), np.array([[0, 1, 2]]))
    with pytest.raises(ValueError, match="no area"):
        residuals(flat, table())
