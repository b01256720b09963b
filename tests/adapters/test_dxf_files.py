"""DXF as ezdxf, CadQuery and build123d write it, read as drawings."""

from math import pi

import pytest

ezdxf = pytest.importorskip("ezdxf", reason="the extra cad is not installed")

import numpy as np  # noqa: E402

import shapewright as sw  # noqa: E402
from shapewright.references.errors import UnreadableError  # noqa: E402
from shapewright.references.readers.formats import contents  # noqa: E402
from shapewright.shapes import Drawing  # noqa: E402

SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10)]


@pytest.fixture
def paper():
    return ezdxf.new("R2010", setup=True)


def saved(paper, tmp_path, **how):
    paper.saveas(tmp_path / "a.dxf", **how)
    return tmp_path / "a.dxf"


def lines(space, corners, gap=0.0, **how):
    for (x, y), end in zip(corners, [*corners[1:], corners[0]], strict=True):
        space.add_line((x + gap, y), end, dxfattribs=how)


def polyline(space):
    space.add_lwpolyline(SQUARE, close=True)


def old_polyline(space):
    space.add_polyline2d(SQUARE, close=True)


def slot(space):
    space.add_lwpolyline([(0, 0, 0), (10, 0, 1), (10, 10, 0), (0, 10, 1)], format="xyb", close=True)


def arcs(space):
    space.add_line((0, 0), (10, 0))
    space.add_arc((10, 5), 5, -90, 90)
    space.add_line((10, 10), (0, 10))
    space.add_arc((0, 5), 5, 90, 270)


def spline(space):
    space.add_spline(fit_points=[(5, 0), (0, 5), (-5, 0), (0, -5), (5, 0)])


def in_a_block(space):
    block = space.doc.blocks.new("part")
    block.add_lwpolyline(SQUARE, close=True)
    space.add_blockref("part", (3, 4), dxfattribs={"xscale": 2.0})


def crossing(space):
    for offset in (0, 10):
        space.add_line((-3, offset), (13, offset))
        space.add_line((offset, -3), (offset, 13))


CAPS = 100 + 25 * pi


@pytest.mark.parametrize(
    ("draw", "area"),
    [
        (polyline, 100),
        (old_polyline, 100),
        (slot, CAPS),
        (arcs, CAPS),
        (lambda space: lines(space, SQUARE), 100),
        (lambda space: lines(space, SQUARE, gap=1e-6), 100),
        (lambda space: (lines(space, SQUARE), lines(space, SQUARE[::-1])), 100),
        (lambda space: (polyline(space), polyline(space)), 100),
        (lambda space: space.add_circle((5, 5), 5), 25 * pi),
        (lambda space: (polyline(space), space.add_circle((5, 5), 2)), 100 - 4 * pi),
        (lambda space: [space.add_circle((5, 5), radius) for radius in (1, 2, 3)], 6 * pi),
        (lambda space: space.add_circle((5, 5), 5, dxfattribs={"extrusion": (0, 0, -1)}), 25 * pi),
        (lambda space: space.add_ellipse((0, 0), (4, 0), 0.5), 8 * pi),
        (lambda space: (lines(space, SQUARE), space.add_line((0, 5), (10, 5))), 100),
        (in_a_block, 200),
        (crossing, 100),
    ],
)
def test_closed_outlines_are_areas_and_those_within_are_holes(paper, tmp_path, draw, area):
    draw(paper.modelspace())
    found = contents(saved(paper, tmp_path)).shape
    assert isinstance(found, Drawing) and found.geometry.area == pytest.approx(area, rel=2e-3)


def test_a_spline_is_as_round_as_its_points(paper, tmp_path):
    spline(paper.modelspace())
    found = contents(saved(paper, tmp_path)).shape
    assert 50 < found.geometry.area < 25 * pi * 1.1 and found.bounds == pytest.approx(
        np.array([[-5, -5], [5, 5]]), abs=0.5
    )


@pytest.mark.parametrize("version", ["R12", "R2000", "R2007", "R2018"])
@pytest.mark.parametrize("form", ["asc", "bin"])
def test_every_version_as_text_and_binary_is_the_same_drawing(tmp_path, version, form):
    paper = ezdxf.new(version)
    arcs(paper.modelspace())
    assert contents(saved(paper, tmp_path, fmt=form)).shape.geometry.area == pytest.approx(CAPS, rel=2e-3)


def test_what_is_no_outline_is_left_out_with_a_note(paper, tmp_path):
    space = paper.modelspace()
    polyline(space)
    space.add_text("M8")
    space.add_line((20, 0), (30, 0))
    paper.layers.add("centre").off()
    space.add_circle((5, 5), 2, dxfattribs={"layer": "centre"})
    space.add_circle((5, 5), 2, dxfattribs={"layer": "Defpoints"})
    found = contents(saved(paper, tmp_path))
    assert found.shape.geometry.area == pytest.approx(100)
    assert sorted(found.notes) == [
        "1 lines left out, which enclose nothing",
        "1 x TEXT left out",
        "2 x hidden left out",
    ]


@pytest.mark.parametrize(("unit", "metres"), [(4, 1e-3), (1, 0.0254), (6, 1.0), (0, None)])
def test_the_unit_is_that_of_the_file(paper, tmp_path, unit, metres):
    paper.units = unit
    polyline(paper.modelspace())
    assert contents(saved(paper, tmp_path)).unit == (metres and pytest.approx(metres))


def test_what_is_no_closed_drawing_is_refused_with_the_reason(paper, tmp_path):
    paper.modelspace().add_line((0, 0), (1, 1))
    path = saved(paper, tmp_path)
    with pytest.raises(UnreadableError, match="no closed outline"):
        contents(path)
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(UnreadableError, match="cut short"):
        contents(path)


def test_a_sketch_that_cadquery_writes_comes_back(tmp_path):
    cadquery = pytest.importorskip("cadquery", reason="the extra cadquery is not installed")
    plate = cadquery.Workplane("XY").rect(40, 20).extrude(1).edges("|Z").fillet(3).faces(">Z").workplane().hole(8)
    cadquery.exporters.export(plate.section(-0.5), str(tmp_path / "a.dxf"))
    found = sw.Collection.load(tmp_path)["a"].shape
    assert isinstance(found, Drawing)
    area = (800 - (4 - pi) * 9 - 16 * pi) / 40**2
    assert found.geometry.area == pytest.approx(area, rel=3e-3)


def test_a_sketch_that_build123d_writes_comes_back(tmp_path):
    build123d = pytest.importorskip("build123d", reason="the extra build123d is not installed")
    sketch = build123d.RectangleRounded(40, 20, 3) - build123d.Circle(4)
    exporter = build123d.ExportDXF(unit=build123d.Unit.MM)
    exporter.add_shape(sketch)
    exporter.write(str(tmp_path / "a.dxf"))
    found = contents(tmp_path / "a.dxf")
    assert found.shape.geometry.area == pytest.approx(800 - (4 - pi) * 9 - 16 * pi, rel=3e-3)
    assert found.unit == pytest.approx(1e-3)
