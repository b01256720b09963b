import math

import numpy as np
import pytest

from shapewright.modelling.solids import chamfered_box, cushion, rounded_box, slats, tapered_leg, turned_leg

FILLING = {
    "rounded_box": lambda size, at: rounded_box(size, 0.2, at),
    "rounded as far as it goes": lambda size, at: rounded_box(size, 0.5, at),
    "chamfered_box": lambda size, at: chamfered_box(size, 0.2, at),
    "cushion": lambda size, at: cushion(size, at),
    "hard cushion": lambda size, at: cushion(size, at, crown=0),
    "tapered_leg": tapered_leg,
    "round tapered leg": lambda size, at: tapered_leg(size, at, round=True),
    "turned_leg": turned_leg,
    "straight turned leg": lambda size, at: turned_leg(size, at, [(1, 0), (3, 1), (1, 2)], smooth=False),
    "slats": lambda size, at: slats(size, 4, 0.05, "z", at),
}


@pytest.mark.parametrize("name", FILLING)
def test_each_fills_its_size_around_at_and_is_sound(name):
    solid = FILLING[name]((2, 1, 3), at=(10, 20, 30))
    np.testing.assert_allclose(solid.bounds, [[9, 19.5, 28.5], [11, 20.5, 31.5]], atol=1e-12)
    assert solid.mesh().soundness().sound


def test_rounding_and_chamfering():
    assert rounded_box(1, 0.5, segments=32).volume == pytest.approx(math.pi / 6, rel=0.01)
    assert rounded_box((3, 1, 1), 0.1, segments=1).volume == pytest.approx(chamfered_box((3, 1, 1), 0.1).volume)
    core, sides, edges, corners = 0.8**3, 6 * 0.8**2 * 0.1, 12 * 0.8 * 0.1**2 / 2, 8 * 0.1**3 / 6
    assert chamfered_box(1, 0.1).volume == pytest.approx(core + sides + edges + corners)
    assert len(chamfered_box(1, 0.1).mesh().faces) == 44


def test_a_tapered_leg_is_narrow_at_the_foot():
    for leg in (tapered_leg((1, 2, 1), foot=0.5), tapered_leg((1, 2, 1), foot=0.5, round=True)):
        vertices = leg.mesh().vertices
        assert np.abs(vertices[vertices[:, 1] < -0.99]).max(axis=0)[0] == pytest.approx(0.25)
        assert np.abs(vertices[vertices[:, 1] > 0.99]).max(axis=0)[0] == pytest.approx(0.5)
    assert tapered_leg(1, foot=0.5).volume == pytest.approx((1 + 0.5 + 0.25) / 3)


def test_a_turned_leg_runs_through_its_profile():
    leg = turned_leg((2, 4, 2), profile=[(1, 0), (2, 1), (1, 2)], smooth=False, segments=64)
    vertices = leg.mesh().vertices
    middle = vertices[np.isclose(vertices[:, 1], 0)]
    np.testing.assert_allclose(np.hypot(middle[:, 0], middle[:, 2]), 1, atol=1e-12)
    ends = vertices[np.isclose(np.abs(vertices[:, 1]), 2)]
    assert np.hypot(ends[:, 0], ends[:, 2]).max() == pytest.approx(0.5)
    assert len(turned_leg(1, tolerance=1e-4).mesh().faces) > len(turned_leg(1).mesh().faces)


def test_slats_are_apart():
    fence = slats((1, 0.5, 0.1), 5, 0.05)
    assert fence.mesh().soundness().components == 5
    assert fence.volume == pytest.approx(0.05 * 0.8)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: rounded_box(1, 0.6), "rounded_box: 0.6 is more than half"),
        (lambda: rounded_box(1, 0), "rounded_box: radius=0"),
        (lambda: chamfered_box((1, 0.1, 1), 0.1), "chamfered_box: 0.1 is more than half"),
        (lambda: cushion((0.2, 1, 1), crown=0), "cushion: 0.5 is more than half"),
        (lambda: cushion(1, crown=1), "crown=1"),
        (lambda: tapered_leg(1, foot=1.5), "foot=1.5"),
        (lambda: turned_leg(1, profile=[(1, 0), (1, 0)]), "from the bottom up"),
        (lambda: turned_leg(1, profile=[(1, 0), (0, 1)], smooth=False), "reaches the axis"),
        (lambda: slats(1, 5, 0.3), "5 slats with gaps of 0.3"),
        (lambda: slats(1, 5, 0), "gaps of 0"),
        (lambda: slats(1, 5, 0.1, axis="w"), "slats: axis='w'"),
    ],
)
def test_bad_arguments_are_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()
