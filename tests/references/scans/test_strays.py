from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import shapewright as sw
from scanned import sampled, seen, strewn
from shapewright.modelling.solids import box, sphere
from shapewright.references.scans.strays import strays

FURNITURE = Path(__file__).resolve().parents[3].parent / "shared" / "data" / "references" / "furniture"
TABLE = box((1.0, 0.05, 0.6)) | box((0.05, 0.7, 0.05), at=(0.0, -0.35, 0.0))


@pytest.mark.parametrize("share", [0.005, 0.02, 0.05])
def test_most_points_that_lie_far_from_the_surface_are_strays_and_no_other_is(share):
    surface = seen(TABLE.mesh(), 8000).positions
    scan = strewn(seen(TABLE.mesh(), 8000), int(share * 8000)).positions
    found = strays(scan)
    off = cKDTree(surface).query(scan)[0]
    assert found[off > 0.06].mean() > 0.85
    assert not found[: len(surface)].any()


def test_a_small_part_that_stands_apart_is_no_stray():
    knob = sampled(sphere(0.01).mesh(), 60).positions + np.array([0.0, 0.0, 0.45])
    assert not strays(np.concatenate([sampled(TABLE.mesh(), 10_000).positions, knob])).any()


def test_points_of_uneven_density_are_no_strays():
    points = sampled(TABLE.mesh(), 40_000).positions
    kept = np.random.default_rng(1).random(len(points)) < np.where(points[:, 0] > 0.0, 1.0, 0.12)
    assert not strays(points[kept]).any()


def test_few_points_have_no_strays():
    assert not strays(np.eye(3)).any()


@pytest.mark.skipif(not FURNITURE.is_dir(), reason="needs the furniture of ../shared")
@pytest.mark.parametrize("path", sorted(FURNITURE.glob("*/*.ply"))[::9], ids=lambda path: path.stem)
def test_nothing_is_taken_from_furniture_that_is_sampled_all_over(path):
    (reference,) = sw.Collection.load(path)
    assert not strays(sampled(reference.shape).positions).any()
