"""Whether a mesh is clean: topology, orientation, slivers; the crossing of triangles has its own tests."""

import numpy as np
import pytest

from shapewright import Mesh
from shapewright.modelling.solids import box, cylinder, sphere
from shapewright.shapes import concatenate
from shapewright.shapes.soundness import SLIVER, Soundness


def without_first_face(mesh):
    return Mesh(mesh.vertices, mesh.faces[1:])


def with_first_face_turned(mesh):
    return Mesh(mesh.vertices, np.concatenate([mesh.faces[:1, ::-1], mesh.faces[1:]]))


def soup(mesh):
    return Mesh(mesh.triangles.reshape(-1, 3), np.arange(3 * len(mesh.faces)).reshape(-1, 3))


def test_solids_are_sound():
    for solid in (box(1), cylinder(1), sphere(1), box(1) | cylinder((0.5, 3, 0.5)), box(1) - box((2, 0.5, 0.5))):
        state = solid.mesh().soundness()
        assert state.sound and state.components == 1
        assert state.triangles == len(solid.mesh().faces)


def test_size_and_place_do_not_matter():
    for scale, shift in ((1e-6, 0), (1e5, 0), (1, 1e4)):
        mesh = (box(1) | box(1, at=(0.5, 0.4, 0.3))).mesh()
        assert Mesh(mesh.vertices * scale + shift, mesh.faces).soundness().sound


@pytest.mark.parametrize(
    ("break_it", "closed", "manifold", "oriented"),
    [
        (without_first_face, False, True, True),
        (with_first_face_turned, True, True, False),
        (lambda mesh: Mesh(mesh.vertices, mesh.faces[:, ::-1]), True, True, False),
        (lambda mesh: Mesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[:1]])), True, False, False),
    ],
)
def test_each_fault_is_told(break_it, closed, manifold, oriented):
    state = break_it(box(1).mesh()).soundness()
    assert (state.closed, state.manifold, state.oriented) == (closed, manifold, oriented)
    assert not state.sound


def test_a_hole_in_a_solid_is_a_component_wound_inwards():
    state = (box(2) - box(1)).mesh().soundness()
    assert state.sound and state.components == 2
    assert concatenate([box(1).mesh(), box(1, at=(3, 0, 0)).mesh()]).soundness().components == 2


def test_vertices_at_one_place_are_one_where_the_mesh_is_open_without():
    assert soup(box(1).mesh()).soundness().sound
    assert not soup(without_first_face(box(1).mesh())).soundness().closed


def test_boxes_that_meet_in_an_edge_are_manifold_only_with_vertices_of_their_own():
    apart = concatenate([box(1).mesh(), box(1, at=(1, 1, 0)).mesh()])
    assert apart.soundness().sound
    _, places = np.unique(apart.vertices, axis=0, return_inverse=True)
    together = Mesh(np.unique(apart.vertices, axis=0), places[apart.faces])
    assert not together.soundness().manifold


def test_fans_that_meet_in_a_vertex_are_not_manifold():
    a, b = box(1).mesh(), box(1, at=(1, 1, 1)).mesh()
    both = concatenate([a, b])
    _, places = np.unique(both.vertices, axis=0, return_inverse=True)
    state = Mesh(np.unique(both.vertices, axis=0), places[both.faces]).soundness()
    assert state.closed and state.oriented and not state.manifold and state.components == 2


@pytest.mark.parametrize(("height", "slivers"), [(0.5 * SLIVER, 2), (2.0 * SLIVER, 0)])
def test_slivers_are_counted(height, slivers):
    wedge = Mesh([(0, 0, 0), (1, 0, 0), (0.5, height, 0), (0.5, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])
    state = wedge.soundness()
    assert state.closed and state.slivers == slivers // 2
    flat = Mesh([(0, 0, 0), (1, 0, 0), (0.5, height, 0), (0.5, -1, 0)], [(0, 1, 2), (0, 3, 1)])
    assert flat.soundness().slivers == slivers // 2


def test_a_mesh_without_faces_is_not_sound_and_one_of_a_point_has_slivers():
    assert Mesh(np.zeros((0, 3)), np.zeros((0, 3), dtype=int)).soundness() == Soundness(False, True, True, 0, 0, 0, 0)
    assert Mesh(np.zeros((3, 3)), [(0, 1, 2)]).soundness().slivers == 1


def test_it_is_said_in_words():
    assert str(box(1).mesh().soundness()) == "sound; 12 triangles in 1 component"
    overlapping = concatenate([without_first_face(box(1).mesh()), box(1, at=(0.5, 0.4, 0.3)).mesh()])
    text = str(overlapping.soundness())
    assert text.startswith("not closed, ") and "self-intersections; 23 triangles in 2 components" in text
