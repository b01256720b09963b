"""CadQuery's objects as procedures return them."""

import numpy as np
import pytest

from shapewright.shapes import Drawing, Mesh
from shapewright.shapes.conversion import as_shape
from shapewright.shapes.files import glb, read_glb

cq = pytest.importorskip("cadquery", reason="needs the extras; run `make test-adapters`")


def box(width=40.0):
    return cq.Workplane("XY").box(width, 30, 10)


def free_functions():
    from cadquery.func import box as solid
    from cadquery.func import cylinder

    return solid(40, 20, 10) - cylinder(6, 40)


def desk():
    made = cq.Assembly(name="desk").add(box(), name="top", color=cq.Color("red"), loc=cq.Location((0, 0, 50)))
    for i, x in enumerate((-15, 15)):
        made.add(
            cq.Workplane().box(4, 4, 40), name=f"leg{i}", color=cq.Color(0.5, 0.3, 0.1), loc=cq.Location((x, 0, 20))
        )
    return made


def cabinet():
    drawer = cq.Assembly(name="drawer", color=cq.Color("blue")).add(cq.Workplane().box(10, 10, 4), name="front")
    made = cq.Assembly(name="cabinet").add(box(), name="body").add(drawer, name="low", loc=cq.Location((0, 0, 20)))
    return made.add(drawer, name="high", loc=cq.Location((0, 0, 40), (0, 0, 1), 30))


SOLIDS = {
    "a workplane": (lambda: box().edges("|Z").fillet(3).faces(">Z").hole(8), 11420.7),
    "a workplane with two solids": (
        lambda: cq.Workplane().pushPoints([(0, 0), (80, 0)]).box(40, 10, 10, combine=False),
        8000,
    ),
    "a solid": (lambda: cq.Solid.makeCylinder(20, 20), 25132.7),
    "a compound": (
        lambda: cq.Compound.makeCompound(
            [cq.Solid.makeBox(4, 1, 1), cq.Solid.makeBox(1, 1, 1).moved(cq.Location((9, 0, 0)))]
        ),
        5,
    ),
    "free functions": (free_functions, 7738.1),
    "a value of the workplane": (lambda: box().val(), 12000),
    "the kernel's shape": (lambda: box().val().wrapped, 12000),
    "a list": (lambda: [box(), cq.Solid.makeBox(1, 1, 1).moved(cq.Location((99, 0, 0)))], 12001),
    "a dict": (lambda: {"body": box()}, 12000),
    "what tessellate gives": (lambda: box().val().tessellate(0.1), 12000),
    "an assembly": (desk, 12000 + 2 * 640),
    "an assembly in an assembly": (cabinet, 12000 + 2 * 400),
}


@pytest.mark.parametrize("form", SOLIDS)
def test_solids_become_sound_meshes_of_their_volume(form):
    make, volume = SOLIDS[form]
    mesh = as_shape(make())
    assert isinstance(mesh, Mesh) and mesh.soundness().closed and mesh.soundness().manifold
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0 == pytest.approx(volume, rel=0.02)


DRAWINGS = {
    "a sketch": (lambda: cq.Sketch().rect(40, 20).circle(5, mode="s"), 800 - 78.5),
    "a sketch of two areas": (lambda: cq.Sketch().rarray(30, 1, 2, 1).rect(10, 20), 400),
    "a sketch on a workplane": (lambda: cq.Workplane().placeSketch(cq.Sketch().rect(40, 20)), 800),
    "a finished sketch": (lambda: cq.Workplane("XZ").sketch().rect(40, 20).finalize(), 800),
    "a face": (lambda: cq.Face.makePlane(20, 40), 800),
    "faces": (lambda: [cq.Face.makePlane(10, 40), cq.Face.makePlane(20, 20)], 600),
}


@pytest.mark.parametrize("form", DRAWINGS)
def test_flat_shapes_become_drawings_of_their_area(form):
    make, area = DRAWINGS[form]
    drawing = as_shape(make())
    assert isinstance(drawing, Drawing) and drawing.geometry.area == pytest.approx(area, rel=0.005)


REFUSED = {
    "a face of a solid": (lambda: box().faces(">Z"), "end the chain with"),
    "edges of a solid": (lambda: box().edges("|Z"), "end the chain with"),
    "a plane on a solid": (lambda: box().faces(">Z").workplane(), "holds a place"),
    "an outline": (lambda: cq.Workplane().rect(40, 20), "extrude it"),
    "a wire": (lambda: cq.Wire.makeCircle(4, cq.Vector(), cq.Vector(0, 0, 1)), "extrude it"),
    "an empty workplane": (lambda: cq.Workplane(), "holds no shape"),
    "an open sketch": (lambda: cq.Sketch().segment((0, 0), (1, 0)), "assemble"),
    "an empty assembly": (lambda: cq.Assembly(name="x"), "no parts"),
    "a cut that leaves nothing": (lambda: box().cut(cq.Workplane().box(500, 500, 500)), "leave nothing"),
    "a vector": (lambda: cq.Vector(1, 2, 3), "Vector; return"),
}


@pytest.mark.parametrize("form", REFUSED)
def test_what_has_no_shape_is_refused_with_the_way_out(form):
    make, message = REFUSED[form]
    with pytest.raises((TypeError, ValueError), match=message):
        as_shape(make())


def test_names_and_colours_of_an_assembly_reach_the_exported_file():
    mesh = read_glb(glb(as_shape(desk())))
    assert mesh.label_names == ("top", "leg0", "leg1")
    colours = {label: tuple(row) for label, row in zip(mesh.labels, mesh.face_colours.tolist(), strict=True)}
    assert colours["top"] == (255, 0, 0, 255) and colours["leg1"] == pytest.approx((128, 76, 26, 255), abs=1)
    assert mesh.extent.tolist() == pytest.approx([40, 30, 55], rel=1e-6)


def test_parts_of_an_assembly_in_an_assembly_stand_in_their_places_with_both_names():
    mesh = as_shape(cabinet())
    assert mesh.label_names == ("body", "low/front", "high/front")
    high = mesh.vertices[mesh.faces[mesh.face_labels == 2]].reshape(-1, 3)
    assert high.min(axis=0).tolist() == pytest.approx([-6.83, -6.83, 38.0], abs=0.01)
    assert mesh.face_colours[mesh.face_labels == 1][0].tolist() == [0, 0, 255, 255]


def test_tessellation_goes_by_the_size_and_not_by_what_was_tessellated_before():
    counts = []
    for size in (0.01, 1.0, 1000.0):
        ball = cq.Workplane().sphere(size)
        ball.val().tessellate(0.01, 0.2)
        counts.append(len(as_shape(ball).faces))
    assert len(set(counts)) == 1 and 500 < counts[0] < 2000


def test_filleted_solids_and_balls_are_sound_and_built_alike_twice():
    for make in (lambda: box().edges().fillet(3), lambda: cq.Workplane().sphere(4)):
        first, second = as_shape(make()), as_shape(make())
        assert first.soundness().sound
        assert np.array_equal(first.vertices, second.vertices) and np.array_equal(first.faces, second.faces)
