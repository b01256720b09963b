import numpy as np
from shapely import Polygon

from shapewright.modelling.solids import box, cylinder
from shapewright.references import Collection
from shapewright.shapes import Drawing, Mesh, Points
from shapewright.survey.duplicates import NEAR, duplicates, equal
from shapewright.survey.likeness import differences, pictures

STEP = box((1, 0.2, 0.6)) | box((0.3, 0.5, 0.2), at=(0.3, 0.3, 0.1))


def found(**shapes) -> list[tuple[str, str, bool, int]]:
    collection = Collection.of(shapes)
    like = duplicates(collection.references, pictures([reference.shape for reference in collection]))
    return [(each.name, each.of, each.is_equal, each.quarters) for each in like]


def shuffled(mesh: Mesh) -> Mesh:
    order = np.random.default_rng(0).permutation(len(mesh.vertices))
    return Mesh(mesh.vertices[order], np.argsort(order)[np.roll(mesh.faces[::-1], 1, axis=1)])


def test_the_order_of_corners_and_faces_does_not_matter():
    assert found(a=STEP, b=shuffled(STEP.mesh())) == [("b", "a", True, 0)]


def test_all_copies_follow_the_first():
    assert found(a=STEP, b=STEP, c=STEP.scale(3.0)) == [("b", "a", True, 0), ("c", "a", True, 0)]


def test_a_copy_that_faces_another_way_is_told_with_its_turn():
    turned = STEP.mesh().transformed(np.array([[0, 0, 1], [0, 1, 0], [-1, 0, 0]]))
    ((name, of, is_equal, quarters),) = found(a=STEP, b=turned)
    assert (name, of, is_equal) == ("b", "a", True) and quarters in (1, 3)
    collection = Collection.of({"a": STEP, "b": turned})
    assert equal(collection["a"].shape, collection["b"].turned(quarters).shape)


def test_other_shapes_are_none():
    assert found(a=STEP, b=STEP.scale((1, 1.2, 1)), c=cylinder((1, 1, 1)), d=box((1, 1, 1))) == []


def test_drawings_and_points_are_compared_too():
    triangle = Drawing(Polygon([(0, 0), (1, 0), (1, 1)]))
    points = Points(np.random.default_rng(0).random((500, 3)))
    assert found(a=points, b=points) == [("b", "a", True, 0)]
    assert found(a=triangle, b=triangle) == [("b", "a", True, 0)]


def test_differences_are_0_to_1_and_0_for_the_same():
    seen = pictures([STEP.mesh().normalised(), STEP.mesh().normalised(), box((0.02, 1, 0.02)).mesh().normalised()])
    apart, _ = differences(seen, np.array([0, 0]), np.array([1, 2]))
    assert apart[0] == 0.0 and NEAR < apart[1] <= 1.0
