import numpy as np
import pytest
import shapely
from shapely import affinity

from shapewright.comparison import outline
from shapewright.shapes import Drawing


def ring() -> Drawing:
    return Drawing(shapely.Point(0, 0).buffer(1.0).difference(shapely.Point(0, 0).buffer(0.5)))


def letter() -> shapely.Geometry:
    """The letter F: no symmetry."""
    return shapely.unary_union([shapely.box(0, 0, 1, 6), shapely.box(0, 5, 4, 6), shapely.box(0, 3, 3, 4)])


def test_a_silhouette_covers_pixel_centres():
    image = outline.silhouette(Drawing(shapely.box(3, 5, 5, 6)))
    rows, columns = np.nonzero(image)
    assert (rows.min(), rows.max(), columns.min(), columns.max()) == (96, 159, 64, 191)
    assert image.sum() == 64 * 128
    assert outline.silhouette(Drawing(letter()))[:128].sum() < outline.silhouette(Drawing(letter()))[128:].sum()


def test_holes_overlaps_and_crumbs():
    area = outline.silhouette(ring()).sum() / 64**2
    assert area == pytest.approx(np.pi * 0.75, rel=0.01)
    overlapping = shapely.GeometryCollection([shapely.box(0, 0, 2, 1), shapely.box(1, 0, 3, 1), shapely.Point(9, 9)])
    apart = Drawing(shapely.MultiPolygon([shapely.box(0, 0, 1, 1), shapely.box(2, 0, 3, 1)]))
    assert outline.silhouette(Drawing(shapely.GeometryCollection(overlapping.geoms[:2]))).mean() == pytest.approx(
        128 * 42.67 / 256**2, rel=0.02
    )
    assert np.isfinite(outline.descriptor(apart).fourier).all()


def test_zernike_moments_of_a_disc():
    moments = outline.descriptor(Drawing(shapely.Point(3, 4).buffer(2.0, quad_segs=64))).zernike
    assert moments.shape == (35,)
    assert np.abs(moments).max() < 0.03  # all polynomials but the first have no mean over the disc


def test_turns_count_only_upright():
    drawing = Drawing(letter())
    turned = Drawing(affinity.rotate(letter(), 90))
    mirrored = Drawing(affinity.scale(letter(), -1, 1))
    for other in (turned, mirrored):
        assert outline.distance(drawing, other) < 0.05
        assert outline.distance(drawing, other, "upright") > 1.0


def test_place_and_size_do_not_matter():
    moved = Drawing(affinity.translate(affinity.scale(letter(), 7, 7), 100, -3))
    for align in ("free", "upright"):
        assert outline.distance(Drawing(letter()), moved, align) < 0.01


def test_matrices():
    drawings = [Drawing(letter()), ring(), Drawing(shapely.box(0, 0, 1, 1))]
    for align in ("free", "upright"):
        matrix = outline.distances(outline.descriptors(drawings), align=align)
        assert matrix.shape == (3, 3)
        assert np.array_equal(matrix, matrix.T)
        assert not matrix.diagonal().any()
        assert (matrix + np.eye(3) > 0.1).all()
        assert np.array_equal(outline.distances(drawings[:1], drawings, align), matrix[:1])
    assert outline.distances([]).shape == (0, 0)


def test_errors():
    with pytest.raises(ValueError, match="too thin"):
        outline.descriptor(Drawing(shapely.box(0, 0, 1000, 0.001)))
    with pytest.raises(ValueError, match="align"):
        outline.distance(ring(), ring(), align="sideways")  # type: ignore[arg-type]
