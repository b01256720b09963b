import numpy as np
import pytest
import shapely

from shapewright.comparison.gaps import Boundary, Gaps, Surface
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes import Drawing, Mesh


def between(a, b, seed=0):
    return Surface(a, seed).gaps(Surface(b, seed))


def sheets(*heights):
    """Squares of side 1, one over the other; two far specks hold the frame."""
    square = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
    speck = np.array([[0.5, -1, 0.5], [0.5, -1, 0.501], [0.501, -1, 0.5], [0.5, -1, 0.5]])
    places = [*(np.add(square, [0, height, 0]) for height in heights), speck, np.subtract([1, 0, 1], speck)]
    fours = np.arange(4 * len(places)).reshape(-1, 4)
    return Mesh(np.concatenate(places), np.concatenate([fours[:, :3], fours[:, [0, 2, 3]]]))


def test_a_sheet_that_moves_is_as_far_as_it_moved():
    moved = between(sheets(0), sheets(0.03))  # of a frame two high: 1.5 %
    assert moved.chamfer == pytest.approx(0.015, abs=1e-4)
    assert moved.f_score(0.0149) < 0.01 and moved.f_score(0.0151) > 0.99


def test_f_score_is_the_harmonic_mean_of_what_either_has_of_the_other():
    gaps = between(sheets(0), sheets(0, 0.5))  # all of the first, half of the second
    assert gaps.f_score(0.01) == pytest.approx(2 / 3, abs=0.02)
    assert between(sheets(0, 0.5), sheets(0)).f_score(0.01) == pytest.approx(2 / 3, abs=0.02)
    assert gaps.chamfer == pytest.approx(0.25 / 4, abs=0.003)
    assert Gaps(np.ones(3), np.ones(4)).f_score(0.5) == 0.0


def test_equal_shapes_have_no_gaps_whatever_their_size_place_and_points():
    shape = (box((1, 0.1, 1)) | cylinder((0.3, 0.8, 0.3))).mesh()
    larger = Mesh(shape.vertices * 7 + [3, -2, 5], shape.faces)
    gaps = Surface(shape, 0).gaps(Surface(larger, 1))
    assert gaps.chamfer < 1e-12 and gaps.f_score(0.01) == 1.0


def test_chamfer_knows_how_far_apart_surfaces_are():
    board = box((1, 0.1, 1)).mesh()
    thicker, stick = (between(board, box(size).mesh()).chamfer for size in ((1, 0.3, 1), (0.1, 1, 0.1)))
    assert 0.03 < thicker < 0.1 < stick
    pillar = cylinder((1, 1, 1)).mesh()
    assert between(board, pillar).chamfer == pytest.approx(between(pillar, board).chamfer, abs=1e-12)
    assert between(board, pillar, 1).chamfer != between(board, pillar).chamfer == between(board, pillar).chamfer


def test_a_surface_without_area_is_refused():
    with pytest.raises(ValueError, match="no area"):
        Surface(Mesh(np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0]]), np.array([[0, 1, 2]])))


def outlines(a, b):
    return Boundary(Drawing(a)).gaps(Boundary(Drawing(b)))


def test_outlines_are_measured_in_place_and_with_their_holes():
    square = shapely.box(0, 0, 1, 1)
    framed = [square.difference(shapely.box(d, d, 1 - d, 1 - d)) for d in (0.1, 0.115)]
    moved = outlines(*framed)  # the outer outline is the same, 4 of 7.2; the inner one moves by .015
    assert moved.chamfer == pytest.approx(0.015 * (3.2 / 7.2 + 3.08 / 7.08) / 2, abs=0.002)
    assert moved.f_score(0.01) == pytest.approx(4 / 7.14, abs=0.01) and moved.f_score(0.02) > 0.99
    several = shapely.MultiPolygon([shapely.box(0, 0, 0.2, 1), shapely.box(0.8, 0, 1, 1)])
    gaps = outlines(several, shapely.affinity.translate(shapely.reverse(several), 5, 2))
    assert gaps.chamfer < 0.001 and gaps.f_score(0.01) == 1.0
