import numpy as np
import pytest

from shapewright.comparison.scans.laid import LOOSE, lay
from shapewright.comparison.scans.scan import Scan
from shapewright.comparison.scans.scan_difference import ScanDifference, scan_cost
from shapewright.modelling.drawing import circle
from shapewright.modelling.solids import box
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.shapes import Points


def table(height=0.7, leg=0.08, shelf=0.0):
    post = box((leg, height, leg), at=(0.4, 0, 0.3))
    whole = box((1, 0.06, 0.8), at=(0, height / 2, 0)) | post.mirror("x", keep=True).mirror("z", keep=True)
    return (whole | box((0.8, 0.05, 0.6), at=(0, -0.1, 0)) if shelf else whole).mesh()


def scan(mesh):
    cameras = side_cameras((-75.0, 0.0, 75.0), (20.0, 30.0, 20.0))
    points = Scanner(cameras).scan(mesh, np.random.default_rng(0))
    return Points(points.positions).normalised()


SCAN = Scan.of(scan(table()))
DIFFERENCE = ScanDifference(SCAN, lay(SCAN, table(), LOOSE).sides)


def test_the_right_replica_costs_least():
    costs = [DIFFERENCE(table(height)) for height in (0.5, 0.6, 0.65, 0.7, 0.75, 0.8, 0.9)]
    assert int(np.argmin(costs)) == 3
    assert costs[:4] == sorted(costs[:4], reverse=True)
    assert costs[3:] == sorted(costs[3:])


def test_what_stands_where_the_scan_shows_nothing_costs():
    assert DIFFERENCE(table(shelf=1.0)) > DIFFERENCE(table()) + 100.0


def test_residuals_are_points_and_then_pixels_of_the_sides():
    residual = DIFFERENCE.residual(table())
    assert residual is not None
    assert (len(residual) - 800) % 256 == 0
    assert DIFFERENCE(table()) == pytest.approx(float(np.abs(residual).sum()))


def test_nothing_else_can_be_compared():
    assert DIFFERENCE.residual(circle(1.0)) is None
    assert DIFFERENCE(circle(1.0)) == np.inf


def test_a_cost_needs_no_known_sides():
    assert scan_cost(scan(table()), table()) < scan_cost(scan(table()), table(0.5))
    assert scan_cost(Points(np.eye(3)), table()) == np.inf
