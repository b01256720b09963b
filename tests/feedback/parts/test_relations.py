import numpy as np

from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.relations import INNER, NEW, WHOLE, best_frame, equal_sizes, inside_of, made_bounds

HEIGHTS = (0.5, 0.7, 0.9)
FRAMES = [
    {
        WHOLE: np.array([(-0.5, 0, -0.3), (0.5, height, 0.3)]),
        "top": np.array([(-0.5, height - 0.05, -0.3), (0.5, height, 0.3)]),
        "column": np.array([(-0.05, 0, -0.05), (0.05, height - 0.05, 0.05)]),
    }
    for height in HEIGHTS
]


def pieces(low_high, **more):
    return [Piece("box", *np.array(low_high(height), dtype=float), **more) for height in HEIGHTS]


def test_the_frame_that_leaves_least_free():
    sleeve = pieces(lambda h: [(-0.08, 0, -0.08), (0.08, h - 0.05, 0.08)])
    frame, along = best_frame(sleeve, FRAMES)
    assert along[1].size == "full" and {axis.size for axis in (along[0], along[2])} <= {"free", "full"}
    shelf = pieces(lambda h: [(-0.5, 0.2 * h, -0.3), (0.5, 0.2 * h + 0.02, 0.3)])
    frame, along = best_frame(shelf, FRAMES)
    assert frame == WHOLE and [axis.size for axis in along] == ["full", "free", "full"]
    assert along[1].place == "free" and abs(along[1].offsets - 0.2).max() < 0.03


def test_a_piece_reaches_from_part_to_part():
    plain = [{name: each[name] for name in (WHOLE, "top")} for each in FRAMES]
    post = pieces(lambda h: [(0.2, 0, -0.02), (0.24, h - 0.05, 0.02)])
    _, along = best_frame(post, plain)
    assert along[1].ends == ((WHOLE, 0), ("top", 0)) and along[1].size == "full"
    with_foot = [{**each, f"{NEW}foot": np.array([(-0.3, 0, -0.3), (0.3, 0.1, 0.3)])} for each in plain]
    stem = pieces(lambda h: [(-0.02, 0.1, -0.02), (0.02, h - 0.05, 0.02)])
    assert best_frame(stem, with_foot)[1][1].ends == ((f"{NEW}foot", 1), ("top", 0))


def test_mirrored_pieces_stand_at_the_sides_or_off_the_middle():
    sides = pieces(lambda h: [(0.45, 0, -0.3), (0.5, h, 0.3)], mirrored=(True, False))
    assert best_frame(sides, FRAMES)[1][0].place == "high"
    inner = pieces(lambda h: [(0.2, 0, -0.3), (0.25, h, 0.3)], mirrored=(True, False))
    along = best_frame(inner, FRAMES)[1][0]
    assert along.place == "free" and abs(along.offsets - 0.45).max() < 1e-9


def test_equal_sizes_are_one_quantity():
    bar = pieces(lambda h: [(-0.3, 0.2, -0.02), (0.3, 0.2 + 0.04, 0.02)])
    _, along = best_frame(bar, FRAMES)
    assert equal_sizes(bar, along) == {2: 1}


def test_a_thin_piece_does_not_reach_from_one_side_to_the_same():
    low = [{**each, "legs": each[WHOLE]} for each in FRAMES]
    disc = pieces(lambda h: [(-0.25, 0, -0.25), (0.25, 0.04, 0.25)])
    _, along = best_frame(disc, low)
    assert along[1].ends is None and along[1].size == "free" and along[1].place == "low"


def test_the_box_that_a_rule_makes():
    post = pieces(lambda h: [(0.2, 0.02, -0.02), (0.24, h - 0.06, 0.02)], mirrored=(True, False))
    plain = [{name: each[name] for name in (WHOLE, "top")} for each in FRAMES]
    frame, along = best_frame(post, plain)
    made = made_bounds(post[0], frame, along, plain[0])
    np.testing.assert_allclose(made, [(-0.24, 0, -0.02), (0.24, HEIGHTS[0] - 0.05, 0.02)], atol=1e-9)


def test_a_bar_between_two_others_reaches_into_both():
    sides = Piece("box", np.array([0.4, 0.1, -0.2]), np.array([0.45, 0.15, 0.2]), mirrored=(True, False))
    outer = np.array([(-0.45, 0.1, -0.2), (0.45, 0.15, 0.2)])
    inner = inside_of(sides, outer)
    np.testing.assert_allclose(inner[:, 0], [-0.4, 0.4])
    frames = [{WHOLE: each[WHOLE], f"{NEW}bars": outer, f"{INNER}{NEW}bars": inner} for each in FRAMES]
    bar = pieces(lambda h: [(-0.39, 0.1, -0.03), (0.39, 0.15, 0.03)])
    assert best_frame(bar, frames)[1][0].ends == ((f"{NEW}bars", 0), (f"{NEW}bars", 1))


def test_the_frame_in_which_all_agree():
    wide = [np.array([(-0.5, 0, -0.3), (0.5, 0.7, 0.3)]), np.array([(-0.5, 0, -0.3), (0.5, 0.7, 0.3)])]
    legs = [np.array([(-0.5, 0, -0.3), (0.5, 0.6, 0.3)]), np.array([(-0.3, 0, -0.2), (0.3, 0.6, 0.2)])]
    frames = [{WHOLE: w, "legs": own} for w, own in zip(wide, legs, strict=True)]
    bars = [
        Piece("box", np.array([own[1, 0] - 0.04, 0.1, -0.1]), np.array([own[1, 0], 0.14, 0.1]), mirrored=(True, False))
        for own in legs
    ]
    frame, along = best_frame(bars, frames)
    assert frame == "legs" and along[0].place == "high" and along[0].unlike == 0.0
