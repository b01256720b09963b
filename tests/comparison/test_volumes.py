import math
from pathlib import Path

import numpy as np
import pytest

from shapewright.comparison.volumes import Volume, intersection_over_union
from shapewright.modelling.solids import box, sphere
from shapewright.references import Collection
from shapewright.shapes import Mesh, concatenate

FURNITURE = Path(__file__).resolve().parents[2].parent / "shared" / "data" / "references" / "furniture"
RNG = np.random.default_rng(0)


def overlap(first, second):
    return intersection_over_union(Volume.of(first), Volume.of(second))


def cube(at=(0, 0, 0), size=(1, 1, 1), steps=8):
    """A box in a frame from -1 to 1 that two specks hold, so that its size and its place count."""
    return concatenate([fine(size, at, steps), *(fine((1e-4,) * 3, (x, x, x), 1) for x in (-1, 1))])


def fine(size, at, steps):
    """A box whose sides are cut into steps x steps squares."""
    u, v = np.divmod(np.arange(steps**2), steps)
    corners = np.stack([[u, v], [u + 1, v], [u + 1, v + 1], [u, v + 1]]).transpose(2, 0, 1) / steps - 0.5
    squares = np.stack([corners[..., 0], corners[..., 1], np.full(corners.shape[:2], 0.5)], axis=-1)
    sides = [np.roll(squares * [1, 1, sign], axis, axis=2)[:, ::sign] for axis in range(3) for sign in (1, -1)]
    vertices = np.concatenate(sides).reshape(-1, 3) * size + at
    fours = np.arange(len(vertices)).reshape(-1, 4)
    return Mesh(vertices, np.concatenate([fours[:, [0, 1, 2]], fours[:, [0, 2, 3]]]))


def some(share, mesh):
    return RNG.random(len(mesh.faces)) < share


def without(share, mesh):
    return Mesh(mesh.vertices, mesh.faces[~some(share, mesh)])


def inverted(share, mesh):
    return Mesh(mesh.vertices, np.where(some(share, mesh)[:, None], mesh.faces[:, ::-1], mesh.faces))


def doubled(share, mesh, way):
    return Mesh(mesh.vertices, np.concatenate([mesh.faces, mesh.faces[some(share, mesh)][:, ::way]]))


def with_inner_faces(mesh, count=40):
    faces = Mesh(RNG.uniform(-0.2, 0.2, (3 * count, 3)), np.arange(3 * count).reshape(-1, 3))
    return concatenate([mesh, faces])


@pytest.mark.parametrize(("second", "truth"), [
    (cube(at=(0.5, 0, 0)), 1 / 3),
    (cube(at=(0, 0.1, 0)), 9 / 11),
    (cube(size=(1, 1, 0.5)), 0.5),
    (cube(at=(0, 0, 0.9), size=(0.1, 0.1, 0.1)), 0.0),
    (cube(steps=1), 1.0),
])  # fmt: skip
def test_overlap_of_boxes_is_the_analytic_one(second, truth):
    assert overlap(cube(), second) == pytest.approx(truth, abs=0.005)
    assert overlap(second, cube()) == overlap(cube(), second)


def test_a_ball_fills_pi_sixths_of_its_cube():
    ball = Volume.of(sphere(1, segments=128).mesh())
    assert ball.share == pytest.approx(math.pi / 6, rel=0.005)
    assert intersection_over_union(ball, Volume.of(box((3, 3, 3)).mesh())) == pytest.approx(math.pi / 6, rel=0.005)


def test_thin_boards_are_told_apart():
    boards = [cube(size=(1, thick, 1)) for thick in (0.04, 0.05)]
    assert overlap(*boards) == pytest.approx(0.8, abs=0.01)


@pytest.mark.parametrize("soup", [
    inverted(1, cube()),
    inverted(0.1, cube()),
    inverted(0.5, cube()),
    without(0.05, cube()),
    doubled(0.2, cube(), 1),
    doubled(0.2, cube(), -1),
    doubled(1, cube(), 1),
    doubled(1, cube(), -1),
    with_inner_faces(cube()),
    concatenate([cube(), fine((0.5, 0.5, 0.5), (0, 0, 0), 4)]),
    Mesh(cube().vertices, cube().faces[(cube().triangles[:, :, 1] != -0.5).any(axis=1)]),
], ids=[
    "all inverted", "some inverted", "half inverted", "5 % missing", "some doubled", "some two-sided", "all doubled",
    "all two-sided", "inner faces", "inner box", "no underside",
])  # fmt: skip
def test_a_soup_has_the_volume_of_the_box_that_it_means(soup):
    assert overlap(cube(), soup) == pytest.approx(1.0, abs=0.015)
    assert overlap(cube(at=(0.5, 0, 0)), soup) == pytest.approx(1 / 3, abs=0.015)


def test_parts_may_overlap_touch_and_be_inside_out():
    whole = cube(size=(1.5, 1, 1), at=(0.25, 0, 0))
    for part in (
        fine((1, 1, 1), (0.5, 0, 0), 8),
        fine((0.5, 1, 1), (0.75, 0, 0), 4),
        fine((0.93, 1, 1), (0.535, 0, 0), 3),
    ):
        assert overlap(whole, concatenate([cube(), part])) == pytest.approx(1.0, abs=0.01)
    inside_out = inverted(1, fine((0.93, 0.99, 0.99), (0.535, 0, 0), 3))
    assert overlap(whole, concatenate([cube(), inside_out])) == pytest.approx(1.0, abs=0.02)


def test_what_encloses_nothing_has_no_overlap():
    sheet = Mesh(np.array([[0, 0, 0], [1, 0, 0], [1, 0.1, 1], [0, 0, 1.0]]), np.array([[0, 1, 2], [0, 2, 3]]))
    upright = Mesh(sheet.vertices[:, [1, 2, 0]] + [0.5, 0, 0], sheet.faces)
    for nothing in (sheet, concatenate([sheet, upright]), doubled(1, sheet, -1)):
        assert math.isnan(overlap(cube(), nothing)) and math.isnan(overlap(nothing, cube()))
        assert math.isnan(Volume.of(nothing).share)


@pytest.mark.skipif(not FURNITURE.is_dir(), reason="needs ../shared/data/references")
def test_soups_of_real_furniture_have_a_volume_that_flaws_leave_alone():
    chairs = [reference.shape for reference in Collection.load(FURNITURE / "chair")]
    volumes = [Volume.of(chair) for chair in chairs]
    assert np.isnan([volume.share for volume in volumes]).sum() <= 1
    assert all(intersection_over_union(volume, volume) == 1.0 for volume in volumes if not math.isnan(volume.share))
    kept = [intersection_over_union(volumes[i], Volume.of(inverted(1, chairs[i]))) for i in range(6)]
    assert min(kept) > 0.98
