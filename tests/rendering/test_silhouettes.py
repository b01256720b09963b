from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
import trimesh

from shapewright.comparison.light_field.dodecahedra import directions
from shapewright.rendering.silhouettes import SIZE, draw, view_axes
from shapewright.shapes import Mesh

SHARED = Path(__file__).resolve().parents[2].parent / "shared"
FRONT = view_axes([0.0, 0.0, 1.0])


def draw_in_front(points: np.ndarray, faces: np.ndarray) -> np.ndarray:
    """The image (256, 256) of triangles with corners (V, 2) in pixels, whole numbers being pixel centres."""
    image = np.empty((1, SIZE, SIZE), dtype=np.uint8)
    vertices = np.column_stack([(points + 0.5) / (SIZE / 2) - 1.0, np.zeros(len(points))])
    draw(vertices, np.asarray(faces, dtype=np.int64), FRONT[None], image)
    return image[0]


def silhouettes(mesh: Mesh, directions: np.ndarray) -> np.ndarray:
    """Silhouettes (N, 256, 256) of a normalised mesh seen from N directions (N, 3)."""
    normalised, axes = mesh.normalised(), view_axes(directions)
    images = np.empty((len(axes), SIZE, SIZE), dtype=np.uint8)
    draw(normalised.vertices, normalised.faces, axes, images)
    return images


def covered_exactly(points: np.ndarray) -> set[tuple[int, int]]:
    """(row, column) of pixel centres inside a triangle, on its left or on its bottom edge, in exact arithmetic."""
    corners = [(Fraction(x), Fraction(y)) for x, y in points]
    covered = set()
    for row in range(int(points[:, 1].min()), int(points[:, 1].max()) + 2):
        crossings = []
        for (xa, ya), (xb, yb) in zip(corners, corners[1:] + corners[:1], strict=True):
            if min(ya, yb) <= row < max(ya, yb):
                crossings.append(xa + (row - ya) * (xb - xa) / (yb - ya))
        if crossings:
            covered |= {(row, c) for c in range(SIZE) if min(crossings) <= c < max(crossings)}
    return covered


def test_pixels_of_a_triangle_are_exact():
    rng = np.random.default_rng(0)
    for scale in (3, 20, 200):
        for _ in range(15):
            points = rng.integers(20 * 256, (20 + scale) * 256, size=(3, 2)) / 256
            points[rng.random((3, 2)) < 0.3] //= 1  # corners and edges on pixel centres
            image = draw_in_front(points, [[0, 1, 2]])
            assert set(map(tuple, np.argwhere(image))) == covered_exactly(points)


def test_neighbours_share_no_pixel_and_leave_no_gap():
    rng = np.random.default_rng(1)
    for _ in range(20):
        rim = np.array([[40.0, 40.0], [200.0, 40.0], [200.0, 200.0], [40.0, 200.0]])
        points = np.vstack([rim, rng.uniform(41, 199, size=2)])
        fan = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
        count = sum(draw_in_front(points, [face]).astype(int) for face in fan)
        assert count[40:200, 40:200].min() == 1
        assert count.max() == 1
        assert count.sum() == 160**2


def test_slivers_without_a_pixel_centre_write_nothing():
    between_rows = np.array([[20.0, 30.2], [90.0, 30.7], [50.0, 30.4]])
    between_columns = between_rows[:, ::-1]
    for points in (between_rows, between_columns, between_rows[[0, 1, 1]]):
        assert not draw_in_front(points, [[0, 1, 2]]).any()


def test_the_order_of_corners_and_faces_does_not_matter():
    mesh = Mesh(*_box((1.0, 0.4, 0.7)))
    turned = Mesh(mesh.vertices, np.roll(mesh.faces[::-1, ::-1], 1, axis=1))
    views = directions()[1]
    assert np.array_equal(silhouettes(mesh, views), silhouettes(turned, views))


def test_a_box_in_front_covers_half_the_image():
    image = silhouettes(Mesh(*_box((2.0, 1.0, 0.3))), [[0.0, 0.0, 5.0]])[0]
    rows, columns = np.nonzero(image)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (96, 159, 64, 191)
    assert image.sum() == 64 * 128


def test_right_and_up_of_a_view():
    right, up = view_axes([1.0, 0.0, 0.0])
    assert np.allclose(right, [0.0, 0.0, -1.0])
    assert np.allclose(up, [0.0, 1.0, 0.0])
    with pytest.raises(ValueError, match="Y axis"):
        view_axes([[0.0, 0.0, 1.0], [0.0, -2.0, 0.0]])


@pytest.mark.skipif(not (SHARED / "data" / "lfd").is_dir(), reason="needs ../shared/data/lfd")
def test_silhouettes_agree_with_the_original():
    original = np.load(SHARED / "data" / "lfd" / "silhouettes.npz")
    different = 0
    for name, packed in zip(original["names"], original["packed"], strict=True):
        loaded = trimesh.load(SHARED / "data" / "lfd" / "meshes" / f"{name}.ply", process=False)
        ours = silhouettes(Mesh(loaded.vertices, loaded.faces), directions().reshape(-1, 3))
        different += int((ours != np.unpackbits(packed, axis=-1).reshape(ours.shape)).sum())
    assert different <= 10  # of a thousand images


def _box(size: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    box = trimesh.creation.box(extents=size)
    return np.asarray(box.vertices), np.asarray(box.faces)
