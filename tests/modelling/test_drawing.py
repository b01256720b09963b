import math
from typing import Annotated

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright import Range
from shapewright.modelling.drawing import Sketch, arc, box, circle, ellipse, line, polygon, polyline, spline, union
from shapewright.shapes.conversion import as_shape


def holes(sketch):
    return sum(len(part.interiors) for part in shapely.get_parts(sketch.geometry))


def test_shapes_fill_the_size_that_they_are_given():
    for sketch in (box((2, 1), at=(3, 4)), box((2, 1), at=(3, 4), radius=0.5), ellipse((2, 1), at=(3, 4))):
        assert sketch.bounds == pytest.approx(np.array([[2, 3.5], [4, 4.5]]))
    assert box(2).area == 4
    assert box((2, 1), radius=0.5).area == pytest.approx(1 + math.pi / 4, rel=0.01)
    assert box(1, radius=0.5).area == pytest.approx(math.pi / 4, rel=0.01)
    assert circle(2, segments=256).area == pytest.approx(math.pi, rel=1e-3)


def test_a_width_draws_the_rim_inside_the_outline():
    for whole, rim in (
        (box((2, 1)), box((2, 1), width=0.1)),
        (circle(2), circle(2, width=0.1)),
        (ellipse((2, 1)), ellipse((2, 1), width=0.1)),
        (polygon([(0, 0), (1, 0), (0, 1)]), polygon([(0, 0), (1, 0), (0, 1)], width=0.1)),
    ):
        assert rim.bounds == pytest.approx(whole.bounds)
        assert holes(rim) == 1 and 0 < rim.area < whole.area
        assert rim.fill().area == pytest.approx(whole.area)
    assert box((2, 1), width=0.1).area == pytest.approx(2 - 1.8 * 0.8)


def test_lines_have_flat_ends_or_round_ones():
    flat, round_ = line((0, 0), (1, 0), width=0.2), line((0, 0), (1, 0), width=0.2, round=True)
    assert flat.bounds == pytest.approx(np.array([[0, -0.1], [1, 0.1]])) and flat.area == pytest.approx(0.2)
    assert round_.bounds == pytest.approx(np.array([[-0.1, -0.1], [1.1, 0.1]]))
    corner = polyline([(0, 0), (1, 0), (1, 1)], width=0.2)
    assert corner.bounds == pytest.approx(np.array([[0, -0.1], [1.1, 1]])) and corner.area == pytest.approx(0.4)
    frame = polyline([(0, 0), (1, 0), (1, 1), (0, 1)], width=0.2, closed=True)
    assert frame.area == pytest.approx(1.2**2 - 0.8**2) and holes(frame) == 1
    smooth = polyline(spline((0, 0), (1, 0.5), (2, 0)), width=0.1)
    assert smooth.area == pytest.approx(0.1 * shapely.LineString(spline((0, 0), (1, 0.5), (2, 0))).length, rel=0.02)


def test_an_arc_runs_counter_clockwise_from_one_angle_to_the_other():
    quarter = arc(2, 0, 90, width=0.2)
    assert quarter.bounds == pytest.approx(np.array([[0, 0], [1.1, 1.1]]), abs=0.02)
    assert quarter.area == pytest.approx(0.2 * math.pi / 2, rel=0.01)
    ring = arc((2, 2), 0, 360, width=0.2, at=(5, 0))
    assert holes(ring) == 1 and ring.bounds.mean(axis=0) == pytest.approx([5, 0], abs=0.01)


def test_union_cut_and_intersection():
    a, b = box(2), box(2, at=(1, 0))
    assert [(a | b).area, (a - b).area, (a & b).area] == pytest.approx([6, 2, 2])
    assert union(a, b, box(1, at=(5, 5))).area == pytest.approx(7) and union().area == 0
    assert holes(a - circle(1)) == 1
    assert polygon([(0, 0), (4, 0), (4, 4), (0, 4)], [(1, 1), (3, 1), (3, 3), (1, 3)]).area == pytest.approx(12)
    assert polygon([(0, 0), (1, 1), (1, 0), (0, 1)]).area == pytest.approx(0.5)  # a bow tie, filled by even and odd


def test_moves():
    bar = box((0.2, 1), at=(1, 0.5))
    assert bar.translate((1, 2)).bounds == pytest.approx(bar.bounds + np.array([1, 2]))
    assert bar.rotate(90).bounds == pytest.approx(np.array([[-1, 0.9], [0, 1.1]]))
    assert bar.rotate(90, about=(1, 0.5)).bounds == pytest.approx(np.array([[0.5, 0.4], [1.5, 0.6]]))
    assert bar.scale((2, 1)).bounds == pytest.approx(np.array([[1.8, 0], [2.2, 1]]))
    assert bar.scale(2, about=(1, 0)).bounds == pytest.approx(np.array([[0.8, 0], [1.2, 2]]))
    assert bar.mirror("x").bounds == pytest.approx(np.array([[-1.1, 0], [-0.9, 1]]))
    assert bar.mirror("y").bounds == pytest.approx(np.array([[0.9, -1], [1.1, 0]]))
    assert bar.mirror("x", keep=True).area == pytest.approx(2 * bar.area)
    assert bar.mirror("x", about=(1, 0)).bounds == pytest.approx(bar.bounds)
    assert bar.array(3, step=(0.5, 0)).bounds[1, 0] == pytest.approx(2.1)
    assert bar.polar_array(4).area == pytest.approx(4 * bar.area)
    assert bar.grow(0.1).area == pytest.approx(0.4 * 1.2) and bar.grow(-0.05).area == pytest.approx(0.1 * 0.9)
    assert bar.bounds == pytest.approx(np.array([[0.9, 0], [1.1, 1]]))


@sw.procedure
def gate(bars: Annotated[int, Range(1, 3)] = 3):
    return box((1, 0.8), width=0.1) | box((0.05, 0.8), at=(-0.3, 0)).array(bars, (0.3, 0))


def test_a_procedure_may_return_a_sketch():
    shape = gate(bars=2)
    assert isinstance(shape, sw.Drawing) and shape.bounds == pytest.approx(np.array([[-0.5, -0.4], [0.5, 0.4]]))
    assert isinstance(as_shape([box(1), box(1, at=(3, 0))]), sw.Drawing)
    assert isinstance(as_shape(Sketch(shapely.box(0, 0, 1, 1))), sw.Drawing)
    with pytest.raises(ValueError, match="area"):
        as_shape(box(1) - box(2))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: box((1, -1)), "box: size=.* must be positive"),
        (lambda: box(1, radius=0.6), r"box: radius=0.6 must lie in 0..0.5"),
        (lambda: box(1, at=(0, 0, 0)), r"box: at=.* must be two numbers"),
        (lambda: circle(0), "circle: size"),
        (lambda: line((0, 0), (1, 0), width=0), "polyline: width"),
        (lambda: polyline([(0, 0)], 0.1), "polyline: it takes at least 2"),
        (lambda: polygon([(0, 0), (1, math.nan), (1, 1)]), "polygon: it takes at least 3 finite"),
        (lambda: arc(1, 90, 0, 0.1), "arc: start=90, end=0: end must be greater"),
        (lambda: box(1).mirror("z"), "mirror: axis='z'"),
        (lambda: box(1).scale(0), "scale: factor"),
        (lambda: box(1).array(0, (1, 0)), "array: count=0"),
        (lambda: box(1, width=-1), "box: width"),
    ],
)
def test_errors_name_the_function_and_the_argument(make, message):
    with pytest.raises(ValueError, match=message):
        make()


def test_parts_that_touch_but_for_rounding_are_one():
    stem = box((0.2, 0.7), at=(0, 0.35)) | box((1, 0.1), at=(0, 0.7 + 0.1 / 2 + 1e-15))
    assert stem.drawing().geometry.geom_type == "Polygon"


def test_only_sketches_are_joined_to_sketches():
    with pytest.raises(TypeError):
        box(1) | 3
