"""What solids do besides moves and booleans: hulls, simplifying, and meshes without slivers."""

import numpy as np
import pytest

from shapewright.modelling.solid.solid import labelled, solid_of
from shapewright.modelling.solids import box, hull, sphere, union
from shapewright.shapes import Mesh
from shapewright.shapes.slivers import SLIVER, heights

TETRAHEDRON = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


def test_a_hull_wraps_what_it_is_given():
    wrapped = hull(box(1), box(1, at=(3, 0, 0)))
    assert wrapped.volume == pytest.approx(4) and len(wrapped.mesh().faces) == 12
    assert hull(sphere(1)).mesh().soundness().sound
    with pytest.raises(ValueError, match="hull: there is nothing to wrap"):
        hull()


def test_a_solid_of_a_closed_surface_whichever_way_it_is_wound():
    for faces in (FACES, FACES[:, ::-1]):
        assert solid_of(TETRAHEDRON + 5, faces).volume == pytest.approx(1 / 6)
    with pytest.raises(ValueError, match="manifold3d reports NotManifold"):
        solid_of(TETRAHEDRON, FACES[:3])


def test_faces_are_labelled_one_by_one():
    solid = labelled(Mesh(TETRAHEDRON, FACES, np.array([1, 0, 0, 1]), ("a", "b")))
    mesh = solid.mesh()
    tilted = np.array([label == "b" for label in mesh.labels])
    normals = np.cross(*(mesh.triangles[:, i] - mesh.triangles[:, 0] for i in (1, 2)))
    assert {tuple(normal) for normal in normals[tilted]} == {(0, 0, -1), (1, 1, 1)}
    assert set((solid | box(0.1, at=(3, 0, 0))).mesh().labels) == {"a", "b", None}


def test_simplifying_takes_away_points_that_the_shape_does_not_need():
    bar = box((4, 1, 1)).label("bar")
    for made in (bar.deform(lambda p: p + np.array([0, 0, 1])), bar.path((0, 0, 0), (0, 0, 0), (0, 0, 0), axis="x")):
        assert len(made.mesh().faces) == 12 and made.mesh().label_names == ("bar",)
    assert (box(1) - box(2)).simplified().manifold.is_empty()


def test_near_misses_leave_no_slivers():
    """Parts that are all but flush, by less or little more than what counts as nothing."""
    for gap in (1e-12, 1e-9, 3e-7, 1e-6, 3e-6, 1e-5):
        for step in ((0, 1 + gap, 0), (gap, 1, 0), (gap, 1 - gap, gap)):
            mesh = (box(1).label("a") | box((0.5, 1, 1), at=step).label("b")).mesh()
            assert heights(mesh.triangles).min() >= 0.99 * SLIVER * mesh.extent.max(), (gap, step)
            assert mesh.soundness().sound, (gap, step, str(mesh.soundness()))


@pytest.mark.parametrize("turn", [1e-7, 1e-6, 1e-5, 1e-4])
def test_parts_turned_by_next_to_nothing_leave_no_slivers(turn):
    mesh = (box(1).label("a") | box((0.5, 1, 0.5)).rotate(turn, "x").translate((0, 0.5, 0.25)).label("b")).mesh()
    assert mesh.soundness().sound, str(mesh.soundness())


def stool():
    leg = box((0.1, 1, 0.1), at=(0.45, 0, 0.45)).label("legs")
    seat = box((1, 0.1, 1), at=(0, 0.5, 0)).label("seat")
    return seat | leg.mirror("x", keep=True).mirror("z", keep=True)


def test_a_part_is_whole_though_the_union_hides_some_of_it():
    legs = stool().part("legs")
    assert legs.bounds.tolist() == [[-0.5, -0.5, -0.5], [0.5, 0.5, 0.5]] and legs.volume == pytest.approx(0.04)
    with pytest.raises(ValueError, match="no piece is labelled 'back'; the labels are: seat, legs"):
        stool().part("back")


def test_parts_follow_moves_cuts_and_deformations():
    moved = stool().translate((1, 0, 0)).scale((2, 1, 1)).rotate(90, "y", about=(1, 0, 0)).mirror("z")
    assert moved.part("legs").volume == pytest.approx(0.08)
    np.testing.assert_allclose((moved | box(9)).part("seat").bounds, moved.part("seat").bounds)
    assert (stool() - box(1, at=(0.5, 0, 0))).part("legs").volume == pytest.approx(0.02)
    assert (stool() & box(1, at=(0.5, 0, 0))).part("legs").volume == pytest.approx(0.02)
    tapered = stool().taper(0.5)
    assert tapered.part("seat").bounds[1, 0] < 0.35


def test_without_takes_pieces_away():
    assert stool().without("legs").volume == pytest.approx(0.1)
    assert stool().without("legs").mesh().label_names == ("seat",)
    assert stool().without("nothing").volume == pytest.approx(stool().volume)
    assert stool().without("legs", "seat").manifold.is_empty()


@pytest.mark.parametrize("gap", [6e-7, 1e-6, 2e-6])
def test_bent_parts_that_are_all_but_flush_leave_no_slivers(gap):
    """A rail stands out from a post by little more than what counts as nothing: a ribbon whose pieces are slivers."""
    rail = box((0.5, 0.06, 0.03 + gap), at=(0, 0.17 + gap, gap)).label("rail")
    post = box((0.04, 0.4, 0.03 - gap), at=(0.23, 0, 0)).label("post")
    bent = union(*(part.bend(35, "x", fixed=0.5).rotate(-10, "x") for part in (rail, post)))
    mesh = bent.mesh()
    assert mesh.soundness().sound, str(mesh.soundness())
    assert set(mesh.labels) == {"rail", "post"}
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    assert np.einsum("fd,fd->", a, np.cross(b, c)) / 6 == pytest.approx(bent.volume, rel=1e-3)
