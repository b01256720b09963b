"""Objects of pyvista, vedo and meshio, and what Open3D's look like."""

from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from shapewright.shapes.conversion import as_shape

WHY = "needs the extras; run `make test-adapters`"
BOX = trimesh.creation.box((4, 3, 1))


def volume(mesh):
    a, b, c = mesh.triangles.transpose(1, 0, 2)
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


@pytest.mark.parametrize(
    ("make", "expected"),
    [
        (lambda pv: pv.Box((0, 4, 0, 3, 0, 1)), 12.0),
        (lambda pv: pv.Cylinder(radius=2, height=1), 12.56),
        (lambda pv: pv.ImageData(dimensions=(5, 4, 2)), 12.0),
        (lambda pv: pv.ImageData(dimensions=(5, 4, 2)).cast_to_unstructured_grid(), 12.0),
        (lambda pv: pv.Box((0, 4, 0, 3, 0, 1)).triangulate().strip(), 12.0),
        (lambda pv: pv.Box((0, 4, 0, 3, 0, 1)) + pv.Box((5, 6, 0, 1, 0, 1)), 13.0),
    ],
)
def test_pyvista(make, expected):
    assert abs(volume(as_shape(make(pytest.importorskip("pyvista", reason=WHY))))) == pytest.approx(expected, rel=0.01)


def test_blocks_of_pyvista_keep_their_names():
    pv = pytest.importorskip("pyvista", reason=WHY)
    assert as_shape(pv.MultiBlock({"top": pv.Box(), "knob": pv.Sphere()})).label_names == ("top", "knob")


def test_vedo_with_colours_and_moved():
    vedo = pytest.importorskip("vedo", reason=WHY)
    both = vedo.Assembly(vedo.Box(size=(4, 3, 1)).c((1.0, 0.0, 0.5)), vedo.Box(size=(1, 1, 1)).x(9))
    mesh = as_shape(both)
    assert abs(volume(mesh)) == pytest.approx(13.0) and mesh.bounds[1, 0] == pytest.approx(9.5)
    assert mesh.face_colours[0].tolist() == [255, 0, 128, 255]
    with pytest.raises(TypeError, match="no faces"):
        as_shape(vedo.Points([[0, 0, 0], [1, 1, 1]]))


@pytest.mark.parametrize(
    "cells",
    [
        [("triangle", BOX.faces)],
        [("vertex", [[0]]), ("triangle", BOX.faces)],
        [("quad", [[0, 2, 6, 4], [1, 5, 7, 3]]), ("triangle", BOX.faces)],
        [("hexahedron", [[0, 4, 6, 2, 1, 5, 7, 3]])],
        [("tetra", [[0, 4, 2, 1], [4, 6, 2, 7], [4, 1, 5, 7], [2, 1, 7, 3], [1, 4, 2, 7]])],
    ],
)
def test_meshio_takes_faces_and_the_outside_of_volumes(cells):
    meshio = pytest.importorskip("meshio", reason=WHY)
    mesh = as_shape(meshio.Mesh(BOX.vertices, [(kind, np.array(rows)) for kind, rows in cells]))
    if cells[0][0] != "quad":
        assert volume(mesh) == pytest.approx(12.0) and mesh.soundness().closed


def test_meshio_without_faces_is_refused():
    meshio = pytest.importorskip("meshio", reason=WHY)
    with pytest.raises(ValueError, match="of cells it has line"):
        as_shape(meshio.Mesh(BOX.vertices, [("line", [[0, 1]])]))


def test_open3d_by_what_its_objects_have():
    """Not the library, which is large."""
    legacy = type("TriangleMesh", (SimpleNamespace,), {"__module__": "open3d.cpu.pybind.geometry"})
    made = legacy(
        vertices=BOX.vertices,
        triangles=BOX.faces,
        vertex_colors=np.tile([1.0, 0, 0], (8, 1)),
        has_vertex_colors=lambda: True,
    )
    mesh = as_shape(made)
    assert volume(mesh) == pytest.approx(12.0) and mesh.face_colours[0].tolist() == [255, 0, 0, 255]
