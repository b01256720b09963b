from pathlib import Path

import numpy as np
import pytest

import shapewright as sw
from scanned import sampled, seen, strewn
from shapewright.modelling.solids import box, cylinder
from shapewright.references import Orientation
from shapewright.references.scans.floor import floor, up_by_floor

FURNITURE = Path(__file__).resolve().parents[3].parent / "shared" / "data" / "references" / "furniture"


def table():
    legs = [box((0.05, 0.6, 0.05), at=(x, -0.33, z)) for x in (-0.45, 0.45) for z in (-0.25, 0.25)]
    whole = box((1.0, 0.06, 0.6))
    for leg in legs:
        whole = whole | leg
    return whole


def chair():
    legs = [box((0.05, 0.45, 0.05), at=(x, -0.24, z)) for x in (-0.2, 0.2) for z in (-0.2, 0.2)]
    whole = box((0.5, 0.05, 0.5)) | box((0.5, 0.5, 0.04), at=(0, 0.27, -0.23))
    for leg in legs:
        whole = whole | leg
    return whole


BED = box((0.6, 0.15, 1.0)) | box((0.6, 0.35, 0.04), at=(0, 0.1, -0.48)) | box((0.4, 0.06, 0.2), at=(0, 0.1, -0.3))
LAMP = cylinder((0.5, 0.02, 0.5), at=(0, -0.5, 0)) | cylinder((0.03, 1.0, 0.03))
LAMP = LAMP | cylinder((0.4, 0.25, 0.4), at=(0, 0.5, 0))
CUPBOARD = box((0.8, 1.0, 0.4))
THINGS = {"table": table(), "chair": chair(), "bed": BED, "lamp": LAMP, "cupboard": CUPBOARD}


@pytest.mark.parametrize("half", [0.8, 1.5, 3.0])
@pytest.mark.parametrize("thing", ["table", "chair", "cupboard"])
def test_a_floor_is_found_and_the_thing_on_it_stays_whole(thing, half):
    mesh = THINGS[thing].mesh().normalised()
    positions = seen(mesh, 20_000, floor=half).positions
    found = floor(positions)
    heights = positions[:, 1] - mesh.bounds[0, 1]
    assert found is not None
    assert not found[heights > 0.02].any()
    assert found[np.abs(heights) < 0.005].mean() > 0.97
    assert np.ptp(positions[~found][:, 1]) == pytest.approx(mesh.extent[1], rel=0.05)


@pytest.mark.parametrize("degrees", [5.0, 12.0])
def test_a_floor_may_lean_and_lie_among_strays(degrees):
    turn = np.radians(degrees)
    matrix = np.array([[np.cos(turn), -np.sin(turn), 0], [np.sin(turn), np.cos(turn), 0], [0, 0, 1]])
    scan = strewn(seen(THINGS["chair"].mesh(), 20_000, floor=1.0), 200)
    level = floor(scan.positions)
    leaning = floor(scan.transformed(matrix).positions)
    assert level is not None and leaning is not None
    assert (level != leaning).mean() < 0.01


def test_a_thing_on_a_floor_beside_a_wall_of_its_width_is_found():
    scan = seen(THINGS["cupboard"].mesh(), 20_000, floor=1.0)
    found = floor(scan.chosen(scan.positions[:, 2] > -0.22).positions)
    assert found is not None and found.mean() > 0.3


@pytest.mark.parametrize("thing", THINGS)
def test_no_part_of_a_thing_is_a_floor(thing):
    mesh = THINGS[thing].mesh().normalised()
    assert floor(sampled(mesh).positions) is None
    assert floor(seen(mesh).positions) is None


def test_a_mattress_that_is_seen_from_above_alone_is_no_floor():
    positions = sampled(BED.mesh().normalised(), 20_000).positions
    assert floor(positions[positions[:, 1] > np.median(positions[:, 1])]) is None


def test_a_plate_with_nothing_on_it_and_no_plane_at_all_are_no_floor():
    rng = np.random.default_rng(0)
    plate = rng.uniform(-1, 1, (5000, 3)) * [1.0, 0.001, 1.0]
    assert floor(plate) is None
    assert floor(rng.normal(size=(5000, 3))) is None


@pytest.mark.parametrize("axis", ["x", "y", "z", "-x", "-y", "-z"])
def test_the_floor_tells_which_axis_points_up(axis):
    scan = seen(THINGS["chair"].mesh(), 20_000, floor=1.0)
    assert up_by_floor(scan.positions @ Orientation.of(axis).matrix) == axis


def test_without_a_floor_no_axis_is_told():
    assert up_by_floor(seen(THINGS["chair"].mesh()).positions) is None


@pytest.mark.skipif(not FURNITURE.is_dir(), reason="needs the furniture of ../shared")
@pytest.mark.parametrize("path", sorted(FURNITURE.glob("*/*.ply"))[::9], ids=lambda path: path.stem)
def test_nothing_is_taken_from_furniture(path):
    (reference,) = sw.Collection.load(path)
    for points in (sampled(reference.shape), seen(reference.shape)):
        assert floor(points.positions) is None
        assert up_by_floor(points.positions) is None
