from collections import namedtuple
from pathlib import Path
from types import SimpleNamespace

import manifold3d
import numpy as np
import pytest
import shapely
import torch
import trimesh

from shapewright.shapes import Drawing, Mesh, Points
from shapewright.shapes.conversion import as_reference, as_shape

VERTICES, FACES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


class Brick:
    """As authors write classes of their own."""

    def __shapewright__(self):
        return {"brick": (VERTICES, FACES)}


def scene():
    box = trimesh.creation.box()
    made = trimesh.Scene()
    made.add_geometry(box)
    made.add_geometry(box, transform=trimesh.transformations.translation_matrix([3, 0, 0]))
    return made


@pytest.mark.parametrize(
    ("value", "faces"),
    [
        (Mesh(np.array(VERTICES), np.array(FACES)), 4),
        ((VERTICES, FACES), 4),
        ((np.array(VERTICES), np.array(FACES, dtype=np.int32)), 4),
        ((np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]), np.array([[0, 1, 2, 3]])), 2),
        (trimesh.Trimesh(VERTICES, FACES), 4),
        (scene(), 24),
        (manifold3d.Manifold.cube((1, 1, 1)), 12),
        (Brick(), 4),
        (manifold3d.Manifold.cube((1, 1, 1)).to_mesh(), 12),
        (trimesh.primitives.Box(), 12),
        (trimesh.voxel.VoxelGrid(np.ones((1, 1, 2), dtype=bool)), 24),
        (SimpleNamespace(vertices=VERTICES, faces=FACES), 4),
        ({"vertices": VERTICES, "faces": FACES}, 4),
        (namedtuple("Made", "verts faces")(VERTICES, FACES), 4),
        ((VERTICES, [], FACES), 4),
        ((VERTICES, [[0, 1], [1, 2]], FACES), 4),
        ((np.array(VERTICES, dtype=np.float32), np.array(FACES, dtype=np.uint16)), 4),
        ((np.array(VERTICES), np.array(FACES, dtype=float)), 4),
        ((torch.tensor(VERTICES, dtype=torch.float32, requires_grad=True), torch.tensor(FACES)), 4),
        (np.array(VERTICES, dtype=np.float32)[np.array(FACES)], 4),
        ((VERTICES, [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]), 4),
        ({"a": (VERTICES, FACES), "b": [(VERTICES, FACES)]}, 8),
        ([[(VERTICES, FACES)], ((VERTICES, FACES), (VERTICES, FACES))], 12),
        ((part for part in [(VERTICES, FACES), (VERTICES, FACES)]), 8),
        (iter([(VERTICES, FACES)]), 4),
        ([("a", (VERTICES, FACES)), ("b", (VERTICES, FACES))], 8),
        ([(VERTICES, FACES), trimesh.Trimesh(VERTICES, FACES)], 8),
    ],
)
def test_everything_that_users_have_becomes_a_mesh(value, faces):
    mesh = as_shape(value)
    assert isinstance(mesh, Mesh) and len(mesh.faces) == faces
    assert mesh.extent.max() >= 1.0


def test_names_become_labels_and_stand_before_those_inside():
    legs = [(VERTICES, FACES), ("left", (VERTICES, FACES))]
    labels = as_shape({"top": (VERTICES, FACES), "legs": legs, "drawer": {"front": Brick()}}).label_names
    assert labels == ("top", "legs/left", "legs", "drawer/front/brick")


def test_a_scene_keeps_its_names_and_colours_and_mirrored_parts_stay_outside_out():
    made, box = trimesh.Scene(), trimesh.creation.box()
    box.visual.face_colors = [200, 150, 80, 255]
    made.add_geometry(box, node_name="top", transform=np.diag([-2.0, 1.0, 1.0, 1.0]))
    made.add_geometry(trimesh.creation.box())
    mesh = as_shape(made)
    assert mesh.labels == ("top",) * 12 + (None,) * 12
    assert {tuple(row) for row in mesh.face_colours.tolist()} == {(200, 150, 80, 255), (0, 0, 0, 0)}
    assert trimesh.Trimesh(mesh.vertices, mesh.faces).volume == pytest.approx(3.0)


def test_a_textured_mesh_has_the_colour_of_its_material():
    box = trimesh.creation.box()
    material = trimesh.visual.material.SimpleMaterial(diffuse=[10, 20, 30, 255])
    box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
    assert as_shape(box).face_colours[0].tolist() == [10, 20, 30, 255]


def test_labels_of_listed_meshes_survive():
    mesh = Mesh(np.array(VERTICES), np.array(FACES))
    joined = as_shape([mesh.label("a"), mesh, mesh.label("b"), mesh.label("a")])
    assert joined.labels == ("a",) * 4 + (None,) * 4 + ("b",) * 4 + ("a",) * 4


@pytest.mark.parametrize(
    "value",
    [
        shapely.box(0, 0, 1, 1),
        shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)]),
        [shapely.box(0, 0, 1, 1), shapely.box(0.5, 0, 3, 1)],
        shapely.GeometryCollection([shapely.box(0, 0, 1, 1), shapely.Point(5, 5)]),
        manifold3d.CrossSection.square((1, 1)),
        trimesh.load_path(np.array([[0.0, 0], [2, 0], [2, 1], [0, 1], [0, 0]])),
        {"left": shapely.box(0, 0, 1, 1), "right": shapely.box(2, 0, 3, 1)},
        np.array([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)], dtype=object),
        (each for each in [shapely.box(0, 0, 1, 1)]),
    ],
)
def test_plane_geometry_becomes_a_drawing(value):
    drawing = as_shape(value)
    assert isinstance(drawing, Drawing) and drawing.geometry.area >= 1.0
    assert drawing.bounds.max() <= 3.0


def test_a_cross_section_keeps_its_holes():
    ring = manifold3d.CrossSection.square((4, 4), True) - manifold3d.CrossSection.square((2, 2), True)
    assert as_shape(ring).geometry.area == pytest.approx(12.0)


@pytest.mark.parametrize(
    ("value", "error", "message"),
    [
        (None, TypeError, "returned nothing"),
        ("table", TypeError, "it returned str"),
        (3.0, TypeError, "it returned float"),
        ([], ValueError, "without parts"),
        ((VERTICES, []), ValueError, "no faces"),
        ((np.array(VERTICES) * np.nan, FACES), ValueError, "not finite"),
        ((VERTICES, [[0, 1, 9]]), ValueError, "outside the 4 vertices"),
        ((np.zeros((3, 3)), [[0, 1, 2]]), ValueError, "no size"),
        ((np.zeros((3, 2)), [[0, 1, 2]]), ValueError, r"\(V, 3\)"),
        (manifold3d.Manifold(), ValueError, "no faces"),
        (shapely.LineString([(0, 0), (1, 1)]), ValueError, "width"),
        ([shapely.box(0, 0, 1, 1), (VERTICES, FACES)], TypeError, "mixes"),
        (shapely.Polygon([(0, 0), (4, 1), (4, 0), (0, 1)]), ValueError, "crosses itself"),
        (shapely.Polygon(), ValueError, "without points"),
        ([(VERTICES, FACES), None], TypeError, r"at \[1\]: it returned nothing"),
        ({"top": [(VERTICES, FACES), "x"]}, TypeError, r"at \['top'\]\[1\]: it returned str"),
        ({trimesh.creation.box()}, TypeError, "return a list"),
        ([VERTICES, FACES], TypeError, r"tuple \(vertices, faces\)"),
        ((VERTICES, FACES, VERTICES), TypeError, r"3 tables; for one mesh return the tuple \(vertices, faces\)"),
        (np.array(VERTICES), TypeError, r"form \(4, 3\); return \(vertices, faces\)"),
        (Path("box.stl"), TypeError, "trimesh.load"),
        (b"glTF", TypeError, "trimesh.load"),
        (trimesh.Scene(), ValueError, "holds no meshes"),
        (trimesh.path.creation.box_outline((1, 1, 1)), TypeError, "Path3D"),
        (trimesh.load_path(np.array([[0.0, 0], [2, 0]])), TypeError, "outlines is closed"),
        ((VERTICES, [[0, 1]]), ValueError, r"\(F, 3\)"),
        ((VERTICES, [[0, 1, 2], [0, 1]]), ValueError, "face 1 has 2 corners"),
        ((VERTICES, [[0.5, 1, 2]]), ValueError, "fractions"),
        ((np.array(VERTICES) + 1j, FACES), ValueError, "complex"),
        (object(), TypeError, "__shapewright__"),
    ],
)
def test_what_is_no_shape_is_refused_with_the_reason(value, error, message):
    with pytest.raises(error, match=message):
        as_shape(value)


class TestPoints:
    CORNERS = np.array([[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0]])

    def test_points_and_a_point_cloud_of_trimesh_are_references(self):
        points = Points(self.CORNERS)
        assert as_reference(points) is points
        assert (as_reference(trimesh.PointCloud(self.CORNERS)).positions == self.CORNERS).all()

    def test_a_cloud_that_says_whether_it_has_normals_gives_them(self):
        normals = np.tile([0.0, 0.0, 1.0], (3, 1))
        cloud = SimpleNamespace(points=self.CORNERS, normals=normals, has_normals=lambda: True)
        assert (as_reference(cloud).normals == normals).all()
        assert as_reference(SimpleNamespace(points=self.CORNERS, has_normals=lambda: False)).normals is None

    def test_a_procedure_cannot_return_points_and_is_told_what_it_can(self):
        with pytest.raises(TypeError, match=r"returned points .*no surface; return a mesh"):
            as_shape(Points(self.CORNERS))
        with pytest.raises(TypeError, match="returned points"):
            as_shape([trimesh.PointCloud(self.CORNERS)])

    def test_points_at_one_place_are_no_reference(self):
        with pytest.raises(ValueError, match="no size"):
            as_reference(Points(self.CORNERS[:1]))
