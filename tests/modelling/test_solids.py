import math

import numpy as np
import pytest
import shapely
from manifold3d import Manifold

from shapewright.modelling.solids import Solid, box, cone, cylinder, extrude, prism, revolve, sphere, union
from shapewright.shapes import shape_digest
from shapewright.shapes.conversion import as_shape

NAN, INFINITY = float("nan"), float("inf")
SQUARE = [(0, 0), (2, 0), (2, 1), (0, 1)]


def circle_area(width: float, depth: float, segments: int = 32) -> float:
    return segments / 2 * math.sin(2 * math.pi / segments) * width * depth / 4


def volume(solid: Solid) -> float:
    """From the mesh, by the divergence theorem: negative if it is wound inside out."""
    a, b, c = (solid.mesh().triangles[:, i] for i in range(3))
    return float(np.einsum("fd,fd->", a, np.cross(b, c)) / 6)


def area_by_label(solid: Solid) -> dict[str | None, float]:
    mesh = solid.mesh()
    a, b, c = (mesh.triangles[:, i] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    labels = np.array(mesh.labels, dtype=object)
    return {label: float(areas[labels == label].sum()) for label in dict.fromkeys(mesh.labels)}


@pytest.mark.parametrize(
    ("primitive", "expected"),
    [
        (box, 2 * 3 * 4),
        (cylinder, circle_area(2, 4) * 3),
        (cone, circle_area(2, 4) * 3 / 3),
        (sphere, None),
        (lambda size, at: prism(size, at, sides=4), 2 * 4 / 2 * 3),
    ],
)
def test_a_primitive_fills_its_size_around_at(primitive, expected):
    solid = primitive((2, 3, 4), at=(10, 20, 30))
    filled = np.array([2, 3, 4]) / (1 if expected != 12 else np.array([math.sqrt(2), 1, math.sqrt(2)]))
    np.testing.assert_allclose(solid.bounds, [[10, 20, 30] - filled / 2, [10, 20, 30] + filled / 2], atol=1e-12)
    np.testing.assert_allclose(solid.mesh().bounds, solid.bounds, atol=1e-12)
    if expected is not None:
        assert volume(solid) == pytest.approx(expected)
        assert solid.volume == pytest.approx(expected)


def test_a_sphere_nears_the_ball_and_one_number_is_three():
    assert volume(sphere(2, segments=128)) == pytest.approx(4 / 3 * math.pi, rel=2e-3)
    np.testing.assert_array_equal(box(2).bounds, box((2, 2, 2)).bounds)
    np.testing.assert_array_equal(box(np.float32(2)).bounds, box(np.array([2.0, 2.0, 2.0])).bounds)


def test_a_frustum_stands_upright():
    for solid, wide in ((cone((1, 2, 1), top=0.5), -1), (cone((1, 2, 1), top=1, bottom=0.5), 1)):
        vertices = solid.mesh().vertices
        radius = np.linalg.norm(vertices[:, [0, 2]], axis=1)
        np.testing.assert_allclose(radius[vertices[:, 1] * wide > 0], 0.5, atol=1e-12)
        np.testing.assert_allclose(radius[vertices[:, 1] * wide < 0], 0.25, atol=1e-12)


@pytest.mark.parametrize("sides", [3, 4, 5, 6, 7])
def test_a_prism_shows_a_flat_side_in_front(sides):
    solid = prism(2, sides=sides)
    in_front = solid.mesh().vertices[:, 2] > math.cos(math.pi / sides) - 1e-9
    assert in_front.sum() == 4
    assert volume(solid) == pytest.approx(sides / 2 * math.sin(2 * math.pi / sides) * 2)


def test_extrude_raises_a_plan_around_at():
    solid = extrude(SQUARE, 3, at=(10, 20, 30))
    np.testing.assert_allclose(solid.bounds, [[10, 18.5, 30], [12, 21.5, 31]], atol=1e-6)
    assert volume(solid) == pytest.approx(6, rel=1e-6)
    assert volume(extrude(SQUARE[::-1], 3)) == pytest.approx(6, rel=1e-6)


def test_extrude_with_holes():
    hole = [(0.5, 0.25), (1.5, 0.25), (1.5, 0.75), (0.5, 0.75)]
    rings = extrude([SQUARE, hole], 3)
    polygon = extrude(shapely.Polygon(SQUARE, [hole]), 3)
    several = extrude(shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)]), 1)
    assert volume(rings) == pytest.approx(4.5, rel=1e-6)
    assert volume(polygon) == pytest.approx(4.5, rel=1e-6)
    assert volume(several) == pytest.approx(2, rel=1e-6)


def test_extrude_tapers_and_twists():
    plan = shapely.box(-1, -1, 1, 1)
    assert volume(extrude(plan, 3, taper=0)) == pytest.approx(4, rel=1e-6)
    assert volume(extrude(plan, 3, taper=0.5)) == pytest.approx(7, rel=1e-6)
    strip = extrude([(0, -0.1), (1, -0.1), (1, 0.1), (0, 0.1)], 1, twist=90).mesh().vertices
    np.testing.assert_allclose(strip[strip[:, 1] < -0.49][:, 0].max(), 1, atol=1e-6)
    np.testing.assert_allclose(strip[strip[:, 1] > 0.49][:, 2].min(), -1, atol=1e-6)


def test_revolve_turns_about_y():
    ring = revolve([(1, 0), (2, 0), (2, 3), (1, 3)], at=(0, 1, 0))
    assert volume(ring) == pytest.approx(circle_area(4, 4) * 3 - circle_area(2, 2) * 3, rel=1e-6)
    np.testing.assert_allclose(ring.bounds, [[-2, 1, -2], [2, 4, 2]], atol=1e-6)
    quarter = revolve([(0, 0), (2, 0), (2, 3)], degrees=90)
    np.testing.assert_allclose(quarter.bounds, [[0, 0, -2], [2, 3, 0]], atol=1e-6)


def test_moves():
    brick = box((2, 4, 6), at=(1, 2, 3))
    np.testing.assert_allclose(brick.translate((1, 0, -1)).bounds, [[1, 0, -1], [3, 4, 5]])
    np.testing.assert_allclose(brick.rotate(90).bounds, [[0, 0, -2], [6, 4, 0]], atol=1e-12)
    np.testing.assert_allclose(brick.rotate(90, "x").bounds, [[0, -6, 0], [2, 0, 4]], atol=1e-12)
    np.testing.assert_allclose(brick.rotate(90, "z").bounds, [[-4, 0, 0], [0, 2, 6]], atol=1e-12)
    np.testing.assert_allclose(brick.rotate(90, about=(1, 2, 3)).bounds, [[-2, 0, 2], [4, 4, 4]], atol=1e-12)
    np.testing.assert_allclose(brick.scale(2).bounds, [[0, 0, 0], [4, 8, 12]])
    np.testing.assert_allclose(brick.scale((1, 0.5, 1), about=(0, 4, 0)).bounds, [[0, 2, 0], [2, 4, 6]])
    np.testing.assert_allclose(brick.mirror("x").bounds, [[-2, 0, 0], [0, 4, 6]])
    np.testing.assert_allclose(brick.mirror("z", keep=True).bounds, [[0, 0, -6], [2, 4, 6]])
    for moved in (brick.rotate(37, "x"), brick.mirror("x"), brick.mirror("y", about=(0, 7, 0))):
        assert volume(moved) == pytest.approx(48)
    np.testing.assert_allclose(brick.bounds, [[0, 0, 0], [2, 4, 6]])


def test_arrays():
    row = box(1).array(3, step=(2, 0, 0))
    assert volume(row) == pytest.approx(3)
    np.testing.assert_allclose(row.bounds, [[-0.5, -0.5, -0.5], [4.5, 0.5, 0.5]])
    star = box(1, at=(3, 0, 0)).polar_array(4)
    assert volume(star) == pytest.approx(4)
    np.testing.assert_allclose(star.bounds, [[-3.5, -0.5, -3.5], [3.5, 0.5, 3.5]], atol=1e-12)


def test_booleans():
    a, b = box(2), box(2, at=(1, 0, 0))
    assert volume(a | b) == pytest.approx(12)
    assert volume(a & b) == pytest.approx(4)
    assert volume(a - b) == pytest.approx(4)
    assert volume(union(a, b, box(2, at=(5, 0, 0)))) == pytest.approx(20)
    with pytest.raises(TypeError):
        a | [b]
    with pytest.raises(ValueError, match="nothing to unite"):
        union()


def test_labels_survive_booleans_and_moves():
    top = box((4, 1, 4), at=(0, 2.5, 0)).label("top")
    leg = box((1, 2, 1), at=(1.5, 1, 1.5)).label("legs")
    hole = cylinder((1, 9, 1)).label("hole")
    table = (top | leg.mirror("x", keep=True).mirror("z", keep=True)) - hole
    for solid in (table, table.rotate(30, "x").translate((1, 2, 3)), table.mirror("y"), table.scale(1)):
        areas = area_by_label(solid)
        rim = 32 * math.sin(math.pi / 32)
        assert areas["legs"] == pytest.approx(4 * (4 * 2 + 1))
        assert areas["hole"] == pytest.approx(rim)
        assert areas["top"] == pytest.approx(2 * (16 - circle_area(1, 1)) - 4 + 16)
    assert area_by_label(top & box(2, at=(0, 2, 0)).label("tool")).keys() == {"top", "tool"}


def test_labels_of_parts_made_from_one_another_stay_apart():
    plain = box(1)
    left, right = plain.translate((-2, 0, 0)).label("left"), plain.translate((2, 0, 0)).label("right")
    mesh = (left | plain | right).mesh()
    for label, x in (("left", -2), (None, 0), ("right", 2)):
        corners = mesh.triangles[[found == label for found in mesh.labels]]
        assert len(corners) == 12
        np.testing.assert_allclose(corners.reshape(-1, 3).mean(axis=0)[0], x, atol=0.2)
    relabelled = (left | right).label("both").mesh()
    assert set(relabelled.labels) == {"both"}
    assert relabelled.label_names == ("both",)


def test_the_labels_of_its_pieces():
    assert (box(1).label("seat") | box(2, at=(3, 0, 0)).label("back") | box(1)).label_names == ("seat", "back")
    assert box(1).label_names == ()


def test_labels_of_what_a_boolean_removed_are_not_listed():
    inner, outer = box(1).label("inner"), box(2).label("outer")
    assert (inner | outer).mesh().label_names == ("outer",)
    assert box(1).mesh().face_labels is None
    assert (outer & box(1).label("tool")).mesh().label_names == ("tool",)


def test_results_are_the_same_every_time():
    def table() -> Solid:
        leg = cylinder((0.1, 1, 0.1), at=(0.4, 0, 0.3)).label("legs")
        return box((1, 0.1, 0.8), at=(0, 0.5, 0)).label("top") | leg.mirror("x", keep=True).mirror("z", keep=True)

    first, second = table().mesh(), table().mesh()
    assert shape_digest(first) == shape_digest(second)
    assert first.labels == second.labels


@pytest.mark.parametrize("leg", [0.05, 0.1, 0.15, 0.2, 0.25])
def test_flush_faces_leave_no_triangle_without_area(leg):
    for breadth in np.linspace(0.3, 1, 8):
        side = leg * breadth
        legs = box((side, 0.7, side), at=((1 - side) / 2, 0, (breadth - side) / 2))
        mesh = (box((1, 0.1, breadth), at=(0, 0.3, 0)) | legs.mirror("x", keep=True).mirror("z", keep=True)).mesh()
        a, b, c = (mesh.triangles[:, i] for i in range(3))
        assert np.linalg.norm(np.cross(b - a, c - a), axis=1).min() > 1e-12


def test_a_solid_is_a_shape_and_takes_manifolds():
    assert len(as_shape(box(1)).faces) == 12
    assert volume(Solid(Manifold.tetrahedron()) & box(9)) == pytest.approx(8 / 3)
    with pytest.raises(ValueError, match="empty"):
        as_shape(box(1) - box(2))
    with pytest.raises(ValueError, match="empty solid has no bounds"):
        _ = (box(1) - box(2)).bounds
    with pytest.raises(ValueError, match="InvalidConstruction"):
        Solid(Manifold.cube((-1, 1, 1))).mesh()


@pytest.mark.parametrize("bad", [0, -1, NAN, INFINITY, (1, 0, 1), (1, NAN, 1), (1, 1), "big", None])
@pytest.mark.parametrize("primitive", [box, cylinder, cone, sphere, prism])
def test_a_bad_size_names_the_function_and_the_argument(primitive, bad):
    with pytest.raises(ValueError, match=f"^{primitive.__name__}: size="):
        primitive(bad)


@pytest.mark.parametrize(
    ("build", "message"),
    [
        (lambda: box(1, at=(0, NAN, 0)), "box: at="),
        (lambda: cylinder(1, segments=2), "cylinder: segments=2"),
        (lambda: prism(1, sides=4.5), "prism: sides=4.5"),
        (lambda: cone(1, top=-0.1), "cone: top=-0.1"),
        (lambda: cone(1, top=0, bottom=0), "not both be 0"),
        (lambda: extrude(SQUARE, 0), "extrude: height=0"),
        (lambda: extrude(SQUARE, 1, twist=NAN), "extrude: twist=nan"),
        (lambda: extrude(SQUARE, 1, taper=(0, 1)), "extrude: taper="),
        (lambda: extrude(SQUARE[:2], 1), "extrude: a polygon is at least three"),
        (lambda: extrude([], 1), "extrude: a polygon is at least three"),
        (lambda: extrude([(0, 0), (1, 1), (2, 2)], 1), "extrude: the polygon has no area"),
        (lambda: revolve([(-1, 0), (1, 0), (1, 1)]), "revolve: the profile reaches r=-1"),
        (lambda: revolve(SQUARE, degrees=400), "revolve: degrees=400"),
        (lambda: box(1).translate((0, 0, INFINITY)), "translate: by="),
        (lambda: box(1).rotate(NAN), "rotate: degrees=nan"),
        (lambda: box(1).rotate(1, "w"), "rotate: axis='w'"),
        (lambda: box(1).scale(0), "scale: factor=0"),
        (lambda: box(1).mirror("x", about=(0, 0)), "mirror: about="),
        (lambda: box(1).array(0, (1, 0, 0)), "array: count=0"),
        (lambda: box(1).polar_array(2.5), "polar_array: count=2.5"),
    ],
)
def test_bad_arguments_are_named(build, message):
    with pytest.raises(ValueError, match=message):
        build()
