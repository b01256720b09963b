"""Deformations of solids: where points go, how many facets that takes, and that the result is sound."""

import math

import numpy as np
import pytest

from shapewright.modelling.solids import box, cylinder, slats


def sound(solid):
    state = solid.mesh().soundness()
    assert state.sound, str(state)
    return solid


def at_height(solid, y):
    vertices = solid.mesh().vertices
    return vertices[np.isclose(vertices[:, 1], y)]


POST = box((0.2, 2, 0.1), at=(5, 1, 3))


def test_taper_keeps_lines_straight_and_needs_no_facets():
    tapered = sound(POST.taper(0.5))
    assert len(tapered.mesh().faces) == 12
    np.testing.assert_allclose(np.ptp(at_height(tapered, 2), axis=0), [0.1, 0, 0.05], atol=1e-12)
    np.testing.assert_allclose(np.ptp(at_height(tapered, 0), axis=0), [0.2, 0, 0.1], atol=1e-12)
    down = POST.taper((0.5, 1), "-y")
    np.testing.assert_allclose(np.ptp(at_height(down, 0), axis=0), [0.1, 0, 0.1], atol=1e-12)
    np.testing.assert_allclose(np.ptp(at_height(down, 2), axis=0), [0.2, 0, 0.1], atol=1e-12)
    along_x = POST.taper(0.5, "x").mesh().vertices
    assert np.ptp(along_x[along_x[:, 0] > 5][:, 1]) == pytest.approx(1)


def test_profile_is_a_bezier_curve_of_widths():
    waisted = sound(POST.profile(1, 0.2, 1, tolerance=1e-4))
    middle = waisted.mesh().vertices
    nearest = middle[np.abs(middle[:, 1] - 1) == np.abs(middle[:, 1] - 1).min()]
    t = nearest[0, 1] / 2
    assert np.ptp(nearest[:, 0]) == pytest.approx(0.2 * ((1 - t) ** 2 + 0.4 * t * (1 - t) + t**2))


def test_path_keeps_sections_and_their_level():
    swayed = sound(POST.path((0, 0, 0), (1, 0, 0), (0, 0, -0.5)))
    np.testing.assert_allclose(at_height(swayed, 2).mean(axis=0), [5, 2, 2.5], atol=1e-12)
    levels = np.unique(swayed.mesh().vertices[:, 1].round(9))
    assert len(levels) > 4
    for y in levels:
        np.testing.assert_allclose(np.ptp(at_height(swayed, y), axis=0), [0.2, 0, 0.1], atol=1e-8)
    assert swayed.volume == pytest.approx(POST.volume)
    sheared = POST.path((0, 0, 0), (0.5, 0, 0))
    assert len(sheared.mesh().faces) == 12
    assert POST.path((0, 0, 0), (0, 1, 0)).volume == pytest.approx(1.5 * POST.volume)


def test_twist_turns_by_the_right_hand():
    twisted = sound(POST.twist(90))
    np.testing.assert_allclose(np.ptp(at_height(twisted, 2), axis=0), [0.1, 0, 0.2], atol=1e-12)
    bar = box((2, 0.1, 0.1), at=(1, 0, 0)).twist(30, "x").mesh().vertices
    end = bar[(bar[:, 0] > 1.99) & (bar[:, 1] > 0) & (bar[:, 2] > 0)]
    angle = math.atan2(end[0, 2], end[0, 1]) if len(end) == 1 else math.nan
    assert math.degrees(angle) == pytest.approx(75)


def test_bend_keeps_the_length_of_the_axis():
    bent = sound(POST.bend(90, towards="x", tolerance=1e-5))
    radius = 2 / (math.pi / 2)
    np.testing.assert_allclose(bent.bounds[1], [5 + radius, radius + 0.1, 3.05], atol=1e-6)
    np.testing.assert_allclose(at_height(bent, 0)[:, [0, 2]].mean(axis=0), [5, 3], atol=1e-9)
    assert bent.volume == pytest.approx(POST.volume, rel=1e-4)
    back = POST.bend(90, towards="-x").bounds
    assert back[0, 0] == pytest.approx(5 - radius, abs=1e-6)
    assert POST.bend(-90, towards="x").bounds == pytest.approx(back)
    middle = box((2, 0.1, 0.5)).bend(60, "x", towards="y", fixed=0.5)
    assert middle.bounds[:, 0].sum() == pytest.approx(0, abs=1e-9)
    assert sound(middle).bounds[0, 1] == pytest.approx(-0.05, abs=1e-3)
    assert POST.bend(0) is POST


def test_bulge_moves_the_side_and_not_its_edges():
    dome = sound(box((1, 0.2, 1)).bulge(0.1))
    assert dome.bounds[1, 1] == pytest.approx(0.2, abs=1e-3)
    rim = dome.mesh().vertices[np.abs(dome.mesh().vertices[:, [0, 2]]).max(axis=1) == 0.5]
    assert set(np.abs(rim[:, 1]).round(12)) == {0.1}
    dent = sound(box((1, 0.2, 1)).bulge(-0.1, "-z"))
    assert dent.bounds[0, 2] == pytest.approx(-0.5) and dent.volume < 0.2


def test_deform_takes_any_function():
    wave = sound(box((4, 0.1, 1)).deform(lambda p: p + np.outer(np.sin(p[:, 0] * 3), [0, 0.2, 0]), tolerance=1e-3))
    assert wave.bounds[:, 1] == pytest.approx([-0.25, 0.25], abs=0.01)
    assert len(np.unique(wave.mesh().vertices[:, 2].round(9))) == 2  # no cuts where it stays straight
    with pytest.raises(ValueError, match="deform: the function must give finite points"):
        box(1).deform(lambda p: p[:, :2])
    with pytest.raises(ValueError, match="deform: the function must give finite points"):
        box(1).deform(lambda p: p * math.nan)


@pytest.mark.parametrize("tolerance", [0.02, 0.005, 0.001])
def test_facets_are_as_many_as_the_tolerance_asks_for(tolerance):
    """Chords of an arc of radius r and angle a stay within r (1 - cos(a / 2n))."""
    thin = box((0.01, 1, 0.01)).bend(90, tolerance=tolerance)
    radius, pieces = 1 / (math.pi / 2), len(np.unique(thin.mesh().vertices[:, 1].round(4))) // 2
    needed = math.ceil(math.pi / 4 / math.acos(1 - tolerance / radius))
    assert needed <= pieces <= 1.3 * needed + 1


def test_labels_and_holes_survive():
    ladder = slats((0.5, 1, 0.1), 5, 0.1, "y").label("rungs") | box((0.1, 1, 0.1)).label("pole")
    for made in (ladder.twist(60), ladder.bend(60), ladder.profile(1, 0.3, 1), ladder.taper(0.5)):
        assert set(sound(made).mesh().label_names) == {"rungs", "pole"}
    ring = (cylinder((1, 0.2, 1)) - cylinder((0.5, 1, 0.5))).bend(40, "x", towards="y", fixed=0.5)
    assert sound(ring).manifold.genus() == 1


def test_one_after_another():
    leg = box((0.1, 1, 0.1)).taper(0.5, "-y").path((0, 0, 0), (0, 0, 0), (0.2, 0, 0), axis="-y").twist(20).bend(20)
    assert sound(leg).volume < 0.01


def test_an_empty_solid_stays_empty():
    nothing = box(1) - box(2)
    with pytest.raises(ValueError, match="empty"):
        nothing.taper(0.5)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: POST.taper(0), "taper: its factors .* must be positive"),
        (lambda: POST.taper((1, 2, 3)), "taper: scale=.* one number or two"),
        (lambda: POST.profile(1), "profile: it takes at least two"),
        (lambda: POST.path((0, 0, 0)), "path: it takes at least two"),
        (lambda: POST.path((0, 0, 0), (0, -3, 0)), "path: .* fold the box back on itself"),
        (lambda: POST.path((0, 0, 0), (0, 0)), "path: offset="),
        (lambda: POST.twist(math.nan), "twist: degrees"),
        (lambda: POST.twist(10, "w"), "twist: axis='w'"),
        (lambda: POST.bend(10, "y", towards="-y"), "must be across"),
        (lambda: box(1).bend(180), "a radius of 0.3183, less than half the thickness"),
        (lambda: POST.bulge(-3), "pushes the side through"),
        (lambda: POST.taper(0.5, tolerance=0), "tolerance=0"),
    ],
)
def test_bad_arguments_are_named(make, message):
    with pytest.raises(ValueError, match=message):
        make()
