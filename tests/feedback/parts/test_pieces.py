import numpy as np
import pytest

from shapewright.feedback.parts.pieces import Piece


def piece(kind="box", size=(1, 0.1, 0.6), at=(0.0, 0.0, 0.0), **more):
    size, at = np.array(size, dtype=float), np.array(at)
    return Piece(kind, at - size / 2, at + size / 2, **more)


@pytest.mark.parametrize("kind", ["box", "cylinder", "rod x", "rod z", "frustum", "foot", "sphere"])
def test_every_kind_fills_its_box(kind):
    made = piece(kind, (0.4, 0.2, 0.3), (0.1, 0.5, 0.2))
    np.testing.assert_allclose(made.mesh().bounds, np.stack([made.low, made.high]), atol=1e-9)


def test_slats_fill_their_box_together():
    made = piece("slats x", (1, 0.3, 0.02), count=4, gap=0.1)
    np.testing.assert_allclose(made.mesh().bounds, np.stack([made.low, made.high]), atol=1e-9)
    assert len(made.mesh().faces) == 4 * 12


def test_mirrored_pieces_stand_on_both_sides():
    legs = piece(size=(0.1, 1, 0.1), at=(0.5, 0, 0.4), mirrored=(True, True), middle=(0.2, 0.1))
    np.testing.assert_allclose(legs.mesh().bounds[:, [0, 2]], [[-0.15, -0.25], [0.55, 0.45]])
    assert len(legs.mesh().faces) == 4 * 12


@pytest.mark.parametrize(
    ("made", "noun"),
    [
        (piece(size=(1, 0.1, 0.6)), "plate"),
        (piece(size=(1, 0.6, 0.1)), "panel"),
        (piece(size=(1, 0.1, 0.1)), "bar"),
        (piece(size=(0.1, 1, 0.1), mirrored=(True, False)), "posts"),
        (piece("cylinder", (0.6, 0.1, 0.6)), "disc"),
        (piece("cylinder", (0.1, 1, 0.1)), "column"),
        (piece("sphere", (1, 1, 1)), "ball"),
        (piece("slats y", (1, 1, 0.1), count=3), "rails"),
    ],
)
def test_what_an_author_would_call_it(made, noun):
    assert made.noun == noun


def test_pieces_made_alike_have_equal_keys():
    assert piece(size=(1, 0.1, 0.6)).key == piece(size=(0.9, 0.08, 0.7), at=(0, 0.3, 0)).key
    assert piece(size=(1, 0.1, 0.6)).key != piece(size=(0.1, 1, 0.1)).key
