"""Extrusions, revolutions, lofts and sweeps: volumes against formulas, and all of them sound."""

import math

import numpy as np
import pytest

from shapewright.modelling.solids import bezier, ellipse, extrude, loft, rectangle, revolve, spline, sweep

L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]


def sound(solid):
    state = solid.mesh().soundness()
    assert state.sound, str(state)
    return solid


def test_extrude_keeps_double_precision():
    third = 1 / 3
    assert sound(extrude(rectangle(third, third), third)).volume == pytest.approx(third**3, rel=1e-14)
    assert extrude(L_SHAPE, 1).volume == pytest.approx(3, rel=1e-14)


@pytest.mark.parametrize("plan", [L_SHAPE, [rectangle(2, 2), ellipse(1, 1)], rectangle(1, 0.5, radius=0.1)])
def test_extrusions_of_all_kinds_are_sound(plan):
    for options in ({}, {"twist": 200}, {"taper": 0.3}, {"taper": (0.5, 2)}, {"twist": -60, "taper": 0.5}):
        sound(extrude(plan, 1.5, **options))


def test_a_twist_turns_against_the_clock_seen_from_above():
    bar = extrude([(0, -0.1), (1, -0.1), (1, 0.1), (0, 0.1)], 1, twist=90).mesh().vertices
    assert bar[bar[:, 1] > 0.49][:, 2].min() == pytest.approx(-1)


def test_revolve_closes_on_the_axis_and_around():
    cone = sound(revolve([(0, 0), (1, 0), (0, 2)], segments=48))
    assert cone.volume == pytest.approx(24 * math.sin(2 * math.pi / 48) * 2 / 3)
    sound(revolve([(0, 0), (1, 0), (0, 1), (1, 2), (0, 2)]))  # touches the axis in between
    sound(revolve([(0.5, 0), (1, 0), (1, 1)]))
    for degrees in (10, 90, 359):
        part = sound(revolve([(0, 0), (1, 0), (0, 2)], degrees=degrees, segments=72))
        assert part.volume == pytest.approx(math.pi * 2 / 3 * degrees / 360, rel=0.02)


def test_loft_joins_point_by_point_or_by_angle():
    frustum = sound(loft([rectangle(2, 2), rectangle(1, 1)], [0, 3]))
    assert frustum.volume == pytest.approx(3 * (4 + 2 + 1) / 3)
    transition = sound(loft([rectangle(1, 1), ellipse(1, 1, segments=32)], [0, 1]))
    bottom = transition.mesh().vertices
    corners = bottom[np.isclose(bottom[:, 1], 0)]
    assert {tuple(corner) for corner in np.abs(corners[:, [0, 2]]).round(9) if corner.min() > 0.49} == {(0.5, 0.5)}
    assert np.isclose(bottom[:, 1], 1).sum() >= 32
    assert 16 * math.sin(math.pi / 16) / 4 < transition.volume < 1
    moved = loft([rectangle(1, 1) + 5, ellipse(1, 1, segments=7)], [0, 1])
    assert sound(moved).bounds[1, 0] == pytest.approx(5.5)


def test_a_smooth_loft_runs_through_its_sections():
    plans = [ellipse(0.5, 0.5), ellipse(1, 1), ellipse(0.5, 0.5)]
    straight, curved = loft(plans, [0, 1, 2]), sound(loft(plans, [0, 1, 2], smooth_between=True))
    assert curved.volume > 1.05 * straight.volume
    assert curved.bounds[1].tolist() == pytest.approx([0.5, 2, 0.5], rel=1e-6)
    finer = loft(plans, [0, 1, 2], smooth_between=True, tolerance=1e-4)
    assert len(finer.mesh().faces) > 3 * len(curved.mesh().faces)


def test_a_sweep_along_a_straight_line_is_an_extrusion():
    post = sound(sweep(rectangle(1, 0.5), [(0, 0, 0), (0, 3, 0)]))
    np.testing.assert_allclose(post.bounds, [[-0.5, 0, -0.25], [0.5, 3, 0.25]], atol=1e-12)
    beam = sweep(rectangle(1, 0.5), [(0, 0, 0), (0, 0, -3)])  # v is up, u to the right
    np.testing.assert_allclose(beam.bounds, [[-0.5, -0.25, -3], [0.5, 0.25, 0]], atol=1e-12)


def test_corners_are_mitred():
    elbow = sound(sweep(rectangle(0.2, 0.2), [(0, 0, 0), (0, 1, 0), (1, 1, 0)]))
    assert elbow.volume == pytest.approx(0.04 * 2)
    np.testing.assert_allclose(elbow.bounds, [[-0.1, 0, -0.1], [1, 1.1, 0.1]], atol=1e-12)


def test_a_path_that_returns_makes_a_ring():
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 0)]
    frame = sound(sweep(rectangle(0.1, 0.2), square))
    assert frame.volume == pytest.approx(4 * 0.02)
    assert frame.manifold.genus() == 1
    hoop = sound(sweep(ellipse(0.1, 0.3), spline((1, 0, 0), (0, 0.5, 1), (-1, 0, 0), (0, 0.5, -1), closed=True)))
    assert hoop.manifold.genus() == 1
    knot = sweep(rectangle(0.1, 0.2), spline((1, 0, 0), (0, 0.9, 0.6), (-0.8, 0, 0.2), (0, -0.9, -1), closed=True))
    assert sound(knot).manifold.genus() == 1


def test_a_curved_path_carries_its_section_upright_to_it():
    path = bezier((0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 1, 1))
    tube = sound(sweep(ellipse(0.2, 0.2, segments=24), path))
    length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
    assert tube.volume == pytest.approx(12 * math.sin(math.pi / 12) * 0.01 * length, rel=1e-6)


def test_scale_and_twist_along_the_path():
    horn = sound(sweep(ellipse(0.2, 0.2), [(0, 0, 0), (0, 1, 0)], scale=(1, 3)))
    assert horn.volume == pytest.approx(16 * math.sin(math.pi / 16) * 0.01 * (1 + 3 + 9) / 3)
    belly = sweep(ellipse(0.2, 0.2), [(0, 0, 0), (0, 1, 0)], scale=(1, 4, 1))
    assert sound(belly).bounds[1, 0] == pytest.approx(0.25, rel=0.01)
    drill = sound(sweep(rectangle(0.2, 0.1), [(0, 0, 0), (0, 1, 0)], twist=90))
    top = drill.mesh().vertices[drill.mesh().vertices[:, 1] > 0.999]
    np.testing.assert_allclose(np.abs(top[:, [0, 2]]).max(axis=0), [0.05, 0.1], atol=1e-12)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: loft([rectangle(1, 1)], [0]), "two or more"),
        (lambda: loft([rectangle(1, 1)] * 2, [0, 0]), "must rise"),
        (lambda: loft([rectangle(1, 1), [rectangle(2, 2), rectangle(1, 1)]], [0, 1]), "must be one ring"),
        (lambda: loft([rectangle(1, 1), L_SHAPE, ellipse(1, 1)], [0, 1, 2]), "seen whole from their middle"),
        (lambda: sweep(rectangle(1, 1), [(0, 0, 0)]), "at least two"),
        (lambda: sweep(rectangle(1, 1), [(0, 0, 0), (0, 0, 0)]), "are one"),
        (lambda: sweep(rectangle(1, 1), [(0, 0, 0), (0, 1, 0), (0, 0.5, 0)]), "turns straight back"),
        (lambda: sweep(rectangle(1, 1), [(0, 0, 0), (0, 1, 0)], scale=(1, 0)), "scale=0 must be positive"),
        (lambda: sweep(rectangle(1, 1), [(0, 0, 0), (0, 9, 0), (9, 9, 0), (0, 0, 0)], twist=90), "takes no twist"),
        (lambda: extrude(L_SHAPE, 1, taper=(1, 2, 3)), "one number or two"),
    ],
)
def test_bad_arguments_are_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()
