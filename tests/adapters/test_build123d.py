"""build123d's objects as procedures return them."""

import numpy as np
import pytest

from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.conversion import as_shape
from shapewright.shapes.files import glb, read_glb

bd = pytest.importorskip("build123d", reason="needs the extras; run `make test-adapters`")


def built_part():
    with bd.BuildPart() as part:
        bd.Box(40, 30, 10)
        bd.Hole(4)
    return part


def built_sketch(plane="XY"):
    with bd.BuildSketch(getattr(bd.Plane, plane)) as sketch:
        bd.Rectangle(40, 20)
        bd.Circle(5, mode=bd.Mode.SUBTRACT)
    return sketch


def built_line():
    with bd.BuildLine() as line:
        bd.Polyline((0, 0), (40, 0), (40, 20))
    return line


def labelled(shape, label, colour=None):
    shape.label = label
    if colour:
        shape.color = bd.Color(colour)
    return shape


def table():
    top = labelled(bd.Pos(0, 0, 50) * bd.Box(40, 30, 4), "top", "burlywood")
    legs = [labelled(bd.Pos(x, 0, 24) * bd.Box(4, 4, 48), f"leg {i}") for i, x in enumerate((-15, 15))]
    return bd.Compound(label="table", children=[top, *legs])


SOLIDS = {
    "a builder": (built_part, 12000 - 502.7),
    "the part of a builder": (lambda: built_part().part, 12000 - 502.7),
    "algebra": (lambda: bd.Box(40, 30, 10) - bd.Cylinder(4, 20), 12000 - 502.7),
    "a moved part": (lambda: bd.Pos(0, 0, 20) * bd.Sphere(8) + bd.Box(40, 30, 10), 12000 + 2133),
    "a list": (lambda: [bd.Box(40, 30, 10), bd.Pos(0, 0, 30) * bd.Box(1, 1, 1)], 12001),
    "a shape list": (lambda: (bd.Box(40, 30, 10) + bd.Pos(0, 0, 30) * bd.Box(1, 1, 1)).solids(), 12001),
    "a solid": (lambda: bd.Box(40, 30, 10).solid(), 12000),
    "the kernel's shape": (lambda: bd.Box(40, 30, 10).wrapped, 12000),
    "a part at many locations": (lambda: bd.GridLocations(20, 20, 2, 2) * bd.Box(10, 5, 5), 1000),
    "an extrusion": (lambda: bd.extrude(bd.Rectangle(40, 20), amount=10), 8000),
    "a revolution": (lambda: bd.revolve(bd.Plane.XZ * bd.Pos(20, 0) * bd.Rectangle(10, 20), bd.Axis.Z), 25132.7),
    "a dict": (lambda: {"top": bd.Box(40, 30, 4), "pin": bd.Pos(0, 0, 9) * bd.Box(1, 1, 1)}, 4801),
    "what tessellate gives": (lambda: bd.Box(40, 30, 10).tessellate(0.1), 12000),
    "a compound with children": (table, 4800 + 2 * 768),
}


@pytest.mark.parametrize("form", SOLIDS)
def test_solids_become_sound_meshes_of_their_volume(form):
    make, volume = SOLIDS[form]
    mesh = as_shape(make())
    assert isinstance(mesh, Mesh) and mesh.soundness().closed and mesh.soundness().manifold
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0 == pytest.approx(volume, rel=0.02)


DRAWINGS = {
    "a sketch": (lambda: bd.Rectangle(40, 20) - bd.Circle(5), 721.5),
    "a builder of a sketch": (built_sketch, 721.5),
    "the sketch of a builder": (lambda: built_sketch().sketch, 721.5),
    "a sketch seen from the front": (lambda: built_sketch("XZ"), 721.5),
    "a sketch seen from the right": (lambda: built_sketch("YZ"), 721.5),
    "a face": (lambda: bd.make_face(bd.Polyline((0, 0), (40, 0), (40, 20), (0, 20), close=True)), 800),
    "a line with a width": (lambda: bd.trace(bd.Polyline((0, 0), (40, 0), (40, 20)), line_width=2), 120),
    "sketches": (lambda: [bd.Rectangle(40, 20), bd.Pos(50, 0) * bd.Circle(5)], 878.5),
    "text": (lambda: bd.Text("I", font_size=10), None),
}


@pytest.mark.parametrize("form", DRAWINGS)
def test_flat_shapes_become_drawings_of_their_area(form):
    make, area = DRAWINGS[form]
    drawing = as_shape(make())
    assert isinstance(drawing, Drawing)
    if area:
        assert drawing.geometry.area == pytest.approx(area, rel=0.01)


@pytest.mark.parametrize("plane", ["XY", "XZ", "YZ"])
def test_a_sketch_is_drawn_as_its_plane_is_looked_at(plane):
    l_shape = getattr(bd.Plane, plane) * (bd.Rectangle(40, 20) - bd.Pos(15, 5) * bd.Rectangle(10, 10))
    drawing = as_shape(l_shape)
    assert drawing.bounds.tolist() == [[-20, -10], [20, 10]]
    assert drawing.geometry.centroid.x < 0.0 and drawing.geometry.centroid.y < 0.0


REFUSED = {
    "a line": (lambda: bd.Polyline((0, 0), (40, 0), (40, 20)), "trace"),
    "a builder of lines": (built_line, "trace"),
    "an edge": (lambda: bd.Line((0, 0), (1, 0)), "trace"),
    "a vertex": (lambda: bd.Vertex(0, 0, 0), "trace"),
    "a cut that leaves nothing": (lambda: bd.Box(40, 30, 10) - bd.Box(500, 500, 500), "leave nothing"),
    "a location": (lambda: bd.Location((1, 2, 3)), "Location; return"),
    "a path": (lambda: "bracket.stl", "for the shape of a file"),
}


@pytest.mark.parametrize("form", REFUSED)
def test_what_has_no_shape_is_refused_with_the_way_out(form):
    make, message = REFUSED[form]
    with pytest.raises((TypeError, ValueError), match=message):
        as_shape(make())


def test_labels_and_colours_of_children_reach_the_exported_file():
    mesh = read_glb(glb(as_shape(table())))
    assert set(mesh.label_names) == {"top", "leg 0", "leg 1"}
    rows = mesh.face_colours[[label == "top" for label in mesh.labels]]
    assert rows.tolist()[0] == [222, 184, 135, 255]


def test_children_stand_where_their_compound_stands():
    inner = bd.Pos(100, 0, 0) * table()
    outer = bd.Compound(label="room", children=[inner, labelled(bd.Box(1, 1, 1), "mat")])
    mesh = as_shape(bd.Pos(0, 7, 0) * outer)
    assert mesh.label_names == ("table/top", "table/leg 0", "table/leg 1", "mat")
    leg = mesh.vertices[mesh.faces[mesh.face_labels == 1]].reshape(-1, 3)
    assert leg.mean(axis=0).tolist() == pytest.approx([85, 7, 24], abs=0.01)
