import numpy as np
import pytest

from shapewright.modelling.anchors import Space
from shapewright.modelling.solids import between, box, cone, cylinder, face, on, slats, under, within

SEAT = box((0.5, 0.04, 0.4), at=(0.1, 0.45, 0)).label("seat")
LEG = box((0.05, 0.43, 0.05), at=(-0.125, 0.215, 0.175))


def bounds(space):
    return pytest.approx(np.array(space), abs=1e-12)


def test_within_is_as_large_as_the_part_or_as_asked():
    assert within(SEAT).bounds == bounds(SEAT.bounds)
    assert within(SEAT, 0.02).size == (0.02, 0.02, 0.02) and within(SEAT, 0.02).at == pytest.approx((0.1, 0.45, 0))
    shelf = within(SEAT | LEG, (None, 0.02, None), y=0.25)
    assert (shelf.width, shelf.height, shelf.depth) == pytest.approx((0.5, 0.02, 0.4))
    assert shelf.at == pytest.approx((0.1, 0.25 * 0.47, 0))


def test_a_side_is_touched_from_inside_and_a_part_lends_its_extent():
    rail = within(SEAT, (0.1, None, 0.02), x="left", z="front")
    assert rail.bounds == bounds([(-0.15, 0.43, 0.18), (-0.05, 0.47, 0.2)])
    above_the_leg = within(SEAT, (None, None, 0.1), x=LEG, z="back")
    assert above_the_leg.bounds == bounds([(-0.15, 0.43, -0.2), (-0.1, 0.47, -0.1)])


def test_on_and_under_are_outside():
    assert on(SEAT, (None, 0.5, 0.03), z="back").bounds == bounds([(-0.15, 0.47, -0.2), (0.35, 0.97, -0.17)])
    assert under(SEAT, (0.05, 0.43, 0.05), x="left", z="front").bounds == bounds(LEG.bounds)
    assert on(SEAT, 0.02, x=1, side="front").bounds == bounds([(0.34, 0.44, 0.2), (0.36, 0.46, 0.22)])


def test_between_is_the_gap_and_what_both_share():
    legs = [under(SEAT, (0.05, 0.43, 0.05), x=side, z="front") for side in ("left", "right")]
    assert between(*legs).bounds == bounds([(-0.1, 0, 0.15), (0.3, 0.43, 0.2)])
    assert between(legs[1], legs[0]) == between(*legs)
    shape = SEAT | LEG
    assert between(face(shape, "bottom"), SEAT).bounds == bounds([(-0.15, 0, -0.2), (0.35, 0.43, 0.2)])
    assert face(shape, "bottom").height == 0 and face(SEAT, "right").at == pytest.approx((0.35, 0.45, 0))


def test_what_fills_a_space_keeps_its_labels_and_may_lie():
    space = Space((0.4, 0.1, 0.2), (1, 2, 3))
    for along in ("x", "y", "z"):
        assert space.fill(cylinder, along=along).bounds == bounds(space.bounds)
    flat = space.fill(cone, along="x", top=0.5).mesh().vertices
    assert np.ptp(flat[flat[:, 0] > 1.19, 1]) == pytest.approx(0.1) and np.ptp(flat[flat[:, 0] < 0.81, 1]) < 0.06
    made = space.fill(lambda size, at: slats(size, 3, 0.02, "x", at).label("slat"))
    assert made.label_names == ("slat",) and made.bounds == bounds(space.bounds)
    assert space.fill(slats, count=3, gap=0.02, axis="x").volume == pytest.approx(made.volume)


@pytest.mark.parametrize(
    ("act", "message"),
    [
        (lambda: within(SEAT, (1, 2)), r"within: size=\(1, 2\) must be \(width, height, depth\)"),
        (lambda: within(SEAT, (None, 0, None)), "within: size=0 must be positive"),
        (lambda: within(SEAT, y="front"), "within: y='front' must be a number, 'bottom', 'top' or a part"),
        (lambda: on(SEAT, 0.1, x=float("nan")), "on: x=nan must be finite"),
        (lambda: on(SEAT, 0.1, side="above"), "on: side: 'above' must be one of left, right"),
        (lambda: on(SEAT, (0.1, None, 0.1)), r"on: size=\(0.1, None, 0.1\) must say how far .* from the top"),
        (lambda: under(SEAT, (None, None, 0.1)), "under: size=.* must say how far .* from the bottom"),
        (lambda: face(SEAT, "up"), "face: side: 'up' must be one of"),
        (lambda: within(SEAT).fill(box, along="up"), "fill: along='up' must be 'x', 'y' or 'z'"),
    ],
)
def test_an_error_names_the_argument(act, message):
    with pytest.raises(ValueError, match=message):
        act()
