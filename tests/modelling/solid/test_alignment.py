"""Parts that touch but for rounding: after alignment their union is one piece, and sound."""

import numpy as np
import pytest

from shapewright.modelling.solid.alignment import aligned
from shapewright.modelling.solids import Solid, box, cylinder, union

RANDOM = np.random.default_rng(0)
CASES = [tuple(RANDOM.uniform((0.4, 0.02, 0.04, 0.2, 5), (1, 0.1, 0.1, 0.4, 80))) for _ in range(12)]


def one_sound_piece(solid: Solid) -> bool:
    state = solid.mesh().soundness()
    return state.sound and state.components == 1


def parts(height, thick, width, x, _):
    """A board and a post below it; where they meet is computed in two ways."""
    board = box((1, thick, 1), at=(0, height - thick / 2, 0)).label("board")
    return board, box((width, height - thick, width), at=(x, (height - thick) / 2, x)).label("post")


@pytest.mark.parametrize("case", CASES)
def test_boxes_that_meet_are_joined(case):
    board, post = parts(*case)
    assert one_sound_piece(board | post) and one_sound_piece(post | board)
    assert one_sound_piece(union(board, post, post.mirror("x")))
    assert set((board | post).mesh().labels) == {"board", "post"}


@pytest.mark.parametrize("case", CASES)
def test_boxes_that_were_turned_before_they_met_are_joined(case):
    board, post = (part.rotate(case[4], "x").rotate(case[4] / 3, "z") for part in parts(*case))
    assert one_sound_piece(board | post) and one_sound_piece(post | board)
    np.testing.assert_allclose((board | post).volume, board.volume + post.volume, rtol=1e-6)


@pytest.mark.parametrize("case", CASES)
def test_a_cut_flush_with_a_turned_side_leaves_no_skin(case):
    plank, tool = box((1, 0.4, 0.4)), box((0.3, 0.2, 0.4), at=(0, 0.1, 0))
    plank, tool = (part.rotate(case[4], "x").rotate(case[4] / 3, "z") for part in (plank, tool))
    assert one_sound_piece(plank - tool)
    assert (plank - tool).volume == pytest.approx(0.16 - 0.3 * 0.2 * 0.4, rel=1e-6)


def test_discs_in_a_pile_are_joined():
    disc = cylinder((1, 0.1, 1), at=(0, 0.05, 0))
    for turn in (0, 7, 30):
        assert one_sound_piece(disc | disc.translate((0, 0.1, 0)).rotate(turn).scale((0.7, 1, 0.7)))
    assert one_sound_piece(box((1, 0.1, 1)).array(7, (0, 0.1, 0)))


def test_what_is_exact_or_apart_is_left_as_it_is():
    for others in ((box(1), box(1, at=(1, 0, 0))), (box(1), box(1, at=(3, 0.5, 0))), (box(1), box(0.5))):
        manifolds = [other.manifold for other in others]
        assert all(a is b for a, b in zip(aligned(manifolds), manifolds, strict=True))


def test_coordinates_move_by_rounding_only():
    a, b = box(1), box(1, at=(1 + 1e-12, 0, 0))
    moved = aligned([a.manifold, b.manifold])
    assert moved[0] is a.manifold and moved[1] is not b.manifold
    assert (moved[1].to_mesh64().vert_properties[:, 0] == 0.5).sum() == 4
    assert aligned([b.manifold, a.manifold])[0] is b.manifold
    gap = aligned([a.manifold, box(1, at=(1 + 1e-6, 0, 0)).manifold])
    assert gap[0] is a.manifold
