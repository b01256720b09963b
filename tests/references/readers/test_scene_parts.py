import numpy as np
import pytest

from gltf_files import CUBE, CUBE_FACES
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.scene_parts import MOST, join, placed, refuse_too_many


def volume(vertices, faces) -> float:
    corners = vertices[faces]
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def test_a_part_is_moved_by_its_matrix():
    matrix = np.array([[0, -1, 0, 5], [1, 0, 0, 6], [0, 0, 2, 7], [0, 0, 0, 1.0]])
    vertices, faces = placed(CUBE, CUBE_FACES, matrix)
    np.testing.assert_array_equal(vertices, CUBE[:, [1, 0, 2]] * [-1, 1, 2] + np.array([5, 6, 7]))
    assert faces is CUBE_FACES


@pytest.mark.parametrize("scale", [(-1, 1, 1), (-1, -1, -1), (1, -2, 1), (-1, -1, 1)])
def test_a_mirrored_part_stays_outward(scale):
    assert volume(*placed(CUBE, CUBE_FACES, np.diag([*scale, 1.0]))) == pytest.approx(abs(np.prod(scale)))


def test_a_matrix_that_is_not_finite_warns_of_nothing():
    vertices, _ = placed(CUBE, CUBE_FACES, np.diag([np.inf, 1e308, np.nan, 1.0]))
    assert not np.isfinite(vertices).all()


def test_parts_are_joined_one_after_the_other():
    vertices, faces = join([(CUBE, CUBE_FACES), (CUBE + 3, CUBE_FACES[::-1])])
    np.testing.assert_array_equal(vertices[faces], np.concatenate([CUBE[CUBE_FACES], CUBE[CUBE_FACES[::-1]] + 3]))
    assert [part.shape for part in join([])] == [(0, 3), (0, 3)]


def test_more_triangles_than_fit_are_refused():
    refuse_too_many(MOST)
    with pytest.raises(UnreadableError, match="10,000,001 triangles, more than the 10,000,000 that are read"):
        refuse_too_many(MOST + 1)
