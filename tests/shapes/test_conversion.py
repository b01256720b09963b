from types import SimpleNamespace

import manifold3d
import numpy as np
import pytest
import shapely
import trimesh

from shapewright.shapes import Drawing, Mesh, Points
from shapewright.shapes.conversion import as_reference, as_shape

VERTICES, FACES = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


class CadVector:
    """As build123d's: X, Y, Z and iterable."""

    def __init__(self, x, y, z):
        self.X, self.Y, self.Z = x, y, z


class CadSolid:
    """As build123d's Shape: geom_type and area like shapely's, but also tessellate."""

    geom_type, area = "SOLID", 1.0

    def vertices(self):
        return []

    def faces(self):
        return []

    def bounding_box(self):
        return SimpleNamespace(diagonal=100.0)

    def tessellate(self, tolerance):
        self.tolerance = tolerance
        return [CadVector(*v) for v in VERTICES], [tuple(f) for f in FACES]


class OlderCadSolid(CadSolid):
    """As CadQuery's Shape, whose vectors have toTuple."""

    def tessellate(self, tolerance):
        return [SimpleNamespace(toTuple=lambda v=v: tuple(map(float, v))) for v in VERTICES], FACES


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
        (CadSolid(), 4),
        (OlderCadSolid(), 4),
        (SimpleNamespace(vals=lambda: [OlderCadSolid(), OlderCadSolid()]), 8),
        (SimpleNamespace(part=CadSolid()), 4),
        (SimpleNamespace(mesh=lambda: Mesh(np.array(VERTICES), np.array(FACES))), 4),
        ([(VERTICES, FACES), trimesh.Trimesh(VERTICES, FACES)], 8),
    ],
)
def test_everything_that_users_have_becomes_a_mesh(value, faces):
    mesh = as_shape(value)
    assert isinstance(mesh, Mesh) and len(mesh.faces) == faces
    assert mesh.extent.max() >= 1.0


def test_cad_is_tessellated_relative_to_its_size():
    solid = CadSolid()
    as_shape(solid)
    assert solid.tolerance == pytest.approx(0.05)


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
