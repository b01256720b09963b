"""The kernels of the judge, against the same said slowly."""

import numpy as np
import pytest
from scipy import ndimage

from shapewright.judging import pixels
from shapewright.judging.differences import Look
from shapewright.modelling.solids import box, sphere
from shapewright.rendering.surround import AXES, EMPTY, ORDERS, PIXELS, POSES, Surround, pose_matrix
from shapewright.shapes import Mesh

CHAIR = (
    box((1, 0.1, 0.9), at=(0, 0.5, 0)) | box((1, 0.9, 0.1), at=(0, 1, -0.4)) | box((0.2, 0.5, 0.2), at=(0.3, 0.25, 0))
)
OURS, THEIRS = (Look.of(shape.mesh()) for shape in (CHAIR, CHAIR | sphere(0.5, at=(0.2, 0.8, 0.1))))
MOST = 0.08


@pytest.fixture(scope="module")
def gaps() -> np.ndarray:
    found = np.empty(OURS.surround.nearness.shape, dtype=np.float32)
    pixels.measure_gaps(OURS.surround.nearness, THEIRS.surround.nearness, PIXELS, MOST, found)
    return found


@pytest.mark.parametrize("view", [0, 4, 9])
def test_a_gap_is_the_distance_to_the_nearest_pixel_of_the_other(gaps, view):
    z, other = OURS.surround.nearness[view], THEIRS.surround.nearness[view]
    there = np.argwhere(other > EMPTY)
    for row, column in np.argwhere(z > EMPTY)[::37]:
        aside = ((there - (row, column)) ** 2).sum(axis=1) * PIXELS[view] ** 2
        nearest = np.sqrt((aside + (other[tuple(there.T)] - z[row, column]) ** 2).min())
        assert gaps[view, row, column] == pytest.approx(min(nearest, MOST), abs=1e-6)
    assert not gaps[view][z <= EMPTY].any()


@pytest.mark.parametrize("beyond", [0.001, 0.025, 0.079])
def test_the_longest_side_is_that_of_the_largest_connected_region(gaps, beyond):
    sides = [0.0]
    for view, picture in enumerate(gaps):
        numbers, _ = ndimage.label(picture > beyond, np.ones((3, 3)))
        sides.extend(PIXELS[view] * np.sqrt(area) for area in np.bincount(numbers.ravel())[1:] if area > 2)
    assert pixels.longest_side(gaps, beyond, PIXELS) == pytest.approx(max(sides))


def test_edges_are_beside_each_other_within_two_pixels():
    marks = [np.unpackbits(look.edges.view(np.uint8), bitorder="little").reshape(14, 64, 64) for look in (OURS, THEIRS)]
    hits = np.empty((14, 2))
    pixels.count_beside(OURS.edges, THEIRS.edges, 2, hits)
    near = ndimage.binary_dilation(marks[1], np.ones((1, 5, 5)))
    assert hits.tolist() == [[(mark & other).sum(), mark.sum()] for mark, other in zip(marks[0], near, strict=True)]


def test_the_best_other_pose_is_found_without_drawing_it():
    mesh, turned = THEIRS.mesh, pose_matrix(1, False, True)
    posed = Surround.of(Mesh(mesh.vertices @ turned.T, mesh.faces))
    weights = np.full(len(AXES), 1.0 / len(AXES))
    pictures = OURS.surround.nearness, THEIRS.surround.nearness
    own, other = pixels.pose_depths(*pictures, *ORDERS, 0.2, weights)
    posed_own, posed_other = pixels.pose_depths(OURS.surround.nearness, posed.nearness, *ORDERS, 0.2, weights)
    assert len(POSES) == 16 and own < other
    assert posed_other == pytest.approx(own, abs=1e-3) and posed_own > own


def test_cells_that_touch_at_corners_are_one_region():
    inside = np.zeros((pixels.GRID,) * 3, dtype=bool)
    inside[1:-1, 1:-1, 1:-1] = np.random.default_rng(0).random((pixels.CELLS,) * 3) < 0.05
    numbers = np.zeros(inside.size, dtype=np.int64)
    count = pixels.connect(inside.ravel(), numbers)
    expected, regions = ndimage.label(inside, np.ones((3, 3, 3)))
    assert count == regions and (numbers.reshape(inside.shape) == expected).all()
