"""Boxes: where their pieces lie and how these face. Every piece is told by its corners."""

import itertools

import numpy as np
import pytest

from shapewright.modelling.grammar.boxes import Box
from shapewright.modelling.grammar.divisions import share

BOX = Box((0, 0, 0), (4, 2, 6))


def extent(box):
    return [pytest.approx(ends) for ends in zip(box.low, box.high, strict=True)]


def test_measures():
    assert (BOX.width, BOX.height, BOX.depth) == BOX.size == (4, 2, 6)
    assert str(BOX) == "4 x 2 x 6 at (2, 1, 3)"


def test_split_runs_from_the_near_end():
    a, b, c = BOX.split("x", 1, ..., share(2))
    assert extent(a) == [(0, 1), (0, 2), (0, 6)]
    assert extent(b) == [(1, 2), (0, 2), (0, 6)]
    assert extent(c) == [(2, 4), (0, 2), (0, 6)]
    top, rest = BOX.split("-y", 0.5, ...)
    assert extent(top) == [(0, 4), (1.5, 2), (0, 6)]
    assert extent(rest) == [(0, 4), (0, 1.5), (0, 6)]
    right, _ = BOX.flip("x").split("x", 1, ...)
    assert extent(right) == [(3, 4), (0, 2), (0, 6)]
    assert right.facing == (-1, 1, 1)


def test_neighbours_meet_in_exactly_the_same_coordinate():
    awkward = Box((0.1, 0, 0), (0.7, 1, 1))
    for pieces in (awkward.split("x", 0.1, ..., 0.2, share(0.3)), awkward.repeat("x", count=7)):
        assert pieces[0].low[0] == 0.1 and pieces[-1].high[0] == 0.7
        assert all(a.high[0] == b.low[0] for a, b in itertools.pairwise(pieces))
    inner, outer = awkward.corners(0.13), awkward.rails(0.13)
    assert {c.high[0] for c in inner} | {c.low[0] for c in inner} >= {r.low[0] for r in outer[:2]}
    assert {r.high[0] for r in outer[:2]} <= {c.low[0] for c in inner}


def test_repeat():
    assert [extent(piece) for piece in BOX.repeat("x", count=3, size=1)] == [
        [(0, 1), (0, 2), (0, 6)],
        [(1.5, 2.5), (0, 2), (0, 6)],
        [(3, 4), (0, 2), (0, 6)],
    ]
    assert len(BOX.repeat("z", size=0.9, gap=0.1)) == 6
    first, second = BOX.repeat("-z", count=2)
    assert first.low[2] == second.high[2] == 3


def test_inset():
    assert extent(BOX.inset(x=0.5, z=(1, 2))) == [(0.5, 3.5), (0, 2), (1, 4)]
    assert extent(BOX.inset(y=-1)) == [(0, 4), (-1, 3), (0, 6)]
    assert extent(BOX.flip("x").inset(x=(1, 2))) == [(2, 3), (0, 2), (0, 6)]


def test_sub():
    assert extent(BOX.sub((1, None, None))) == [(1.5, 2.5), (0, 2), (0, 6)]
    assert extent(BOX.sub((1, 1, None), anchor=(1, 0, 0.3))) == [(3, 4), (0, 1), (0, 6)]
    assert extent(BOX.flip("x").sub((1, None, None), anchor=(1, 0, 0))) == [(0, 1), (0, 2), (0, 6)]
    assert extent(BOX.sub((6, None, None))) == [(-1, 5), (0, 2), (0, 6)]


def test_ends_corners_and_rails_face_outwards():
    left, right = BOX.ends("x", 1)
    assert extent(left) == [(0, 1), (0, 2), (0, 6)] and left.facing == (-1, 1, 1)
    assert extent(right) == [(3, 4), (0, 2), (0, 6)] and right.facing == (1, 1, 1)
    corners = BOX.corners((1, 2))
    assert [corner.facing for corner in corners] == [(-1, 1, -1), (1, 1, -1), (-1, 1, 1), (1, 1, 1)]
    assert extent(corners[0]) == [(0, 1), (0, 2), (0, 2)]
    assert extent(corners[3]) == [(3, 4), (0, 2), (4, 6)]
    back, front, left, right = BOX.rails((1, 2), thickness=0.5)
    assert extent(back) == [(1, 3), (0, 2), (0, 0.5)] and back.facing == (1, 1, -1)
    assert extent(front) == [(1, 3), (0, 2), (5.5, 6)]
    assert extent(left) == [(0, 0.5), (0, 2), (2, 4)] and left.facing == (-1, 1, 1)
    assert extent(right) == [(3.5, 4), (0, 2), (2, 4)]
    around_x = BOX.corners(0.5, "x")
    assert extent(around_x[0]) == [(0, 4), (0, 0.5), (0, 0.5)]


def test_pieces_of_mirror_images_are_mirror_images():
    left, right = BOX.ends("x", 1)
    for divide in (
        lambda box: box.split("x", 0.2, ...)[0],
        lambda box: box.inset(x=(0.1, 0.4)),
        lambda box: box.sub((0.3, None, None), anchor=(0.2, 0, 0)),
        lambda box: box.face("right").extrude(0.1),
        lambda box: box.move((0.7, 0, 0)),
        lambda box: box.repeat("x", count=2, size=0.3)[1],
    ):
        a, b = divide(left), divide(right)
        np.testing.assert_allclose([4 - a.high[0], 4 - a.low[0]], [b.low[0], b.high[0]])


def test_patches():
    top = BOX.face("top")
    assert extent(top) == [(0, 4), (2, 2), (0, 6)] and top.height == 0
    assert extent(top.extrude(0.5)) == [(0, 4), (2, 2.5), (0, 6)]
    assert extent(top.extrude(-0.5)) == [(0, 4), (1.5, 2), (0, 6)]
    bottom = BOX.face("bottom")
    assert extent(bottom.extrude(0.5)) == [(0, 4), (-0.5, 0), (0, 6)] and bottom.facing == (1, -1, 1)
    assert extent(BOX.flip("x").face("left")) == [(4, 4), (0, 2), (0, 6)]
    panel = BOX.face("front").inset(x=1).repeat("y", count=2)[1].extrude(0.1)
    assert extent(panel) == [(1, 3), (1, 2), (6, 6.1)]


def test_labels_and_tags():
    box = BOX.tag("a").label("all").label("cloth", "top").label("leather", "top", "front")
    assert dict(box.names) == {None: "all", "top": "leather", "front": "leather"}
    piece = box.split("x", ..., ...)[0]
    assert dict(piece.names) == {None: "all"} and piece.symbol == ""


def test_pieces_of_a_deformed_box_are_deformed_with_it():
    bent = BOX.bend(20).taper(0.5)
    assert len(bent.deformations) == 2 and bent.groups == ()
    for piece in bent.split("x", ..., ...):
        assert piece.deformations == () and piece.groups[0].deformations == bent.deformations
    assert BOX.bend(20).taper(0.5) == bent and BOX.bend(0) is BOX


@pytest.mark.parametrize(
    ("divide", "message"),
    [
        (lambda: BOX.split("x", 3, 2), "split along x: the sizes 3, 2 are 1 more than the 4"),
        (lambda: BOX.split("w", 1), "split: axis='w'"),
        (lambda: BOX.repeat("x"), "repeat along x: it takes a count"),
        (lambda: BOX.inset(x=3), "inset: a box of -2 x 2 x 6 would have a negative size"),
        (lambda: BOX.corners(5), "ends: size=5 along z must lie in 0..6|ends: size=5 along x"),
        (lambda: BOX.rails(2.5), "negative size"),
        (lambda: BOX.extrude(1), "extrude: only a patch"),
        (lambda: BOX.face("top").inset(y=0).face("left").extrude(1), "extrude: only a patch"),
        (lambda: BOX.face("up"), "face: 'up' must be one of left, right"),
        (lambda: BOX.label("x", "up"), "label: 'up'"),
        (lambda: BOX.round(3), "round: radius=3 must lie in 0..2"),
        (lambda: BOX.round().split("x", 1), "split: a box that is rounded or filled"),
        (lambda: BOX.taper(0.5).move((1, 0, 0)), "move: a box that is deformed"),
        (lambda: BOX.bulge(0.1, BOX), "bulge: give a side, or a patch"),
        (lambda: BOX.bulge(0.1, "inside"), "'inside' must be one of"),
        (lambda: BOX.sub((-1, None, None)), "negative size"),
        (lambda: BOX.bend(400, towards="x"), "the inside would fold"),
    ],
)
def test_what_cannot_be_is_refused(divide, message):
    with pytest.raises(ValueError, match=message):
        divide()
