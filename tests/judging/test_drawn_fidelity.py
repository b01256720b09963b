"""The judge of drawings: one value, and where the two differ."""

import math

import numpy as np
import pytest
import shapely
from shapely import affinity

import shapewright as sw
from shapewright.judging.drawn_fidelity import DrawnFidelity, Likeness
from shapewright.modelling import solids
from shapewright.modelling.drawing import box, circle
from shapewright.references.readers.pictures import read_picture
from shapewright.references.readers.svg import read_svg
from shapewright.rendering.ink import png
from shapewright.threads import in_threads

TOP, LEG = box((1, 0.06), at=(0, 0.57)), box((0.06, 0.6), at=(0.45, 0.3))
TABLE, ONE_LEG = (TOP | LEG.mirror("x", keep=True)).drawing(), (TOP | LEG).drawing()
THIN = (box((1, 0.006), at=(0, 0.6)) | box((0.006, 0.6), at=(0.45, 0.3)).mirror("x", keep=True)).drawing()
CLOSE, REPLICATED = 0.35, 0.65


def value(replica, reference=TABLE):
    return DrawnFidelity(reference).evidence(replica).value


def area(sketch):
    return sketch.drawing().geometry


def test_the_region_is_where_the_leg_is():
    found = DrawnFidelity(TABLE).evidence(ONE_LEG)
    assert len(found.missing) == 1 and found.surplus == () and found.value < CLOSE
    low, high = found.missing[0].low, found.missing[0].high
    assert low == pytest.approx((-0.48, -0.3, 0.0), abs=0.015) and high == pytest.approx((-0.42, 0.23, 0.0), abs=0.015)
    assert found.missing[0].share == pytest.approx(0.06 * 0.53 / TABLE.geometry.area, rel=0.05)
    assert DrawnFidelity(ONE_LEG).evidence(TABLE).surplus == found.missing


def test_a_thin_bar_too_much_is_not_the_same():
    barred = sw.Drawing(TABLE.geometry | area(box((0.9, 0.015), at=(0, 0.2))))
    assert value(barred) < CLOSE


@pytest.mark.parametrize("sides", [(1, -1), (1.25, 1), (1, 1.25)])
def test_on_its_head_and_stretched_is_different(sides):
    assert value(sw.Drawing(affinity.scale(TABLE.geometry, *sides))) < CLOSE


def test_mirrored_is_not_the_same():
    assert value(sw.Drawing(affinity.scale(ONE_LEG.geometry, -1, 1)), ONE_LEG) < CLOSE


def test_a_thin_line_may_stand_beside_its_place():
    moved = (box((1, 0.006), at=(0, 0.6)) | box((0.006, 0.6), at=(0.445, 0.3)).mirror("x", keep=True)).drawing()
    likeness = DrawnFidelity(THIN).likeness(moved)
    assert likeness.iou < 0.7 and likeness.depth == 0.0 and value(moved, THIN) > REPLICATED


def test_of_two_replicas_without_regions_the_nearer_one_is_better():
    near, far = (sw.Drawing(TABLE.geometry.buffer(by, join_style="mitre")) for by in (0.002, 0.006))
    assert value(TABLE) > value(near) > value(far) > REPLICATED


def test_proportions_count_from_a_tenth_on():
    assert Likeness(1, 0, 0, 0.1).value == Likeness(1, 0, 0, 0).value > 0.95 > CLOSE > Likeness(1, 0, 0, 0.223).value


def test_flaws_of_real_drawings_do_not_count():
    noise = np.random.default_rng(0)
    fine = shapely.segmentize(TABLE.geometry, 0.01)
    shifts = {tuple(corner): noise.normal(0, 0.003, 2) for corner in shapely.get_coordinates(fine)}
    noisy = shapely.transform(fine, lambda points: points + [shifts[tuple(point)] for point in points])
    doubled = shapely.MultiPolygon([TABLE.geometry, TABLE.geometry])
    crack = TABLE.geometry - area(box((0.001, 0.06), at=(0.1, 0.57)))
    speck = TABLE.geometry | area(circle(0.004)).buffer(0)
    for flawed in (noisy.buffer(0), doubled, crack, speck):
        assert value(sw.Drawing(flawed)) > REPLICATED
    assert value(read_picture(png(TABLE))[0]) > REPLICATED


@pytest.mark.parametrize("path", ["M0 0H9V9H0ZM3 3H6V6H3Z", "M0 0H9V9H0ZM3 3V6H6V3Z"])
def test_a_hole_is_a_hole_by_either_rule(path):
    ring = (box(9) - box(3)).drawing()
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path fill-rule="evenodd" d="{path}"/></svg>'
    assert value(read_svg(svg.encode())[0], ring) > 0.95
    assert value(box(9).drawing(), ring) < CLOSE


def test_a_mesh_is_no_evidence():
    judge = DrawnFidelity(TABLE)
    assert math.isnan(judge.evidence(None).value) and math.isnan(judge.evidence(solids.box(1).mesh()).value)


def test_any_thread_may_ask_of_a_drawing_first():
    judge, replicas = DrawnFidelity(TABLE), [TABLE, ONE_LEG, TABLE, ONE_LEG]
    assert in_threads(judge.evidence, replicas, 4) == [DrawnFidelity(TABLE).evidence(replica) for replica in replicas]
