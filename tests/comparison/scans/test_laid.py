import numpy as np
import pytest

from shapewright.comparison.scans.laid import lay
from shapewright.comparison.scans.scan import Scan
from shapewright.modelling.solids import box
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.shapes import Points, concatenate

SIDES = side_cameras((-75.0, 0.0, 75.0), (25.0, 30.0, 25.0))
BOX = box((1.0, 0.6, 0.8)).mesh()


def scan(mesh=BOX, sensors=False):
    points = Scanner(SIDES).scan(mesh, np.random.default_rng(0)).normalised()
    return Scan.of(points if sensors else Points(points.positions))


@pytest.mark.parametrize("sensors", [False, True])
def test_what_was_not_seen_is_no_surplus(sensors):
    laid = lay(scan(sensors=sensors), BOX)
    assert laid.missing.mean() < 0.004
    assert (laid.surplus[laid.seen] > 0.03).mean() < 0.02
    assert 0.25 < 1.0 - laid.seen.mean() < 0.6  # back and underside


def test_noise_makes_a_scan_no_larger():
    laid = lay(scan(), BOX)
    assert laid.scale > 1.01
    inside = laid.in_scan(np.array([0.5, 0.3, 0.4]))
    assert np.allclose(inside * laid.scale + laid.shift, [0.5, 0.3, 0.4])


def test_a_part_in_front_of_what_was_seen_is_surplus():
    knob = box((0.2, 0.2, 0.2), at=(0.0, 0.0, 0.5)).mesh()
    laid = lay(scan(), concatenate([BOX, knob]))
    assert (laid.surplus[laid.seen] > 0.05).any()
    assert np.abs(laid.samples[laid.seen][laid.surplus[laid.seen] > 0.05][:, :2]).max() < 0.15


def test_a_part_on_the_side_that_nobody_saw_is_none():
    knob = box((0.2, 0.2, 0.04), at=(0.0, 0.0, -0.42)).mesh()
    laid = lay(scan(), concatenate([BOX, knob]))
    assert (laid.surplus[laid.seen] > 0.05).mean() < 0.01


def test_what_was_scanned_and_is_not_there_is_missing():
    knob = box((0.2, 0.2, 0.2), at=(0.0, 0.0, 0.5)).mesh()
    laid = lay(scan(concatenate([BOX, knob])), BOX)
    assert (laid.missing > 0.05).any()
