import subprocess
import sys

import pytest

import shapewright as sw
from shapewright.shapes.conversion import as_shape, registry


class Wall:
    """As of another library: neither faces nor vertices."""

    def __init__(self, length):
        self.length = length


@pytest.fixture
def registered(monkeypatch):
    monkeypatch.setattr(registry, "_registered", {})


def tetrahedron(size):
    return [[0, 0, 0], [size, 0, 0], [0, size, 0], [0, 0, size]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]


def test_a_registered_function_converts_the_objects_of_a_package_and_of_classes_that_extend_its(registered):
    @sw.register(__name__)
    def _(wall):
        return {"wall": tetrahedron(wall.length)}

    class LongWall(Wall):
        __module__ = "elsewhere.walls"

    assert as_shape([Wall(2.0), LongWall(5.0)]).label_names == ("wall",)
    assert as_shape(LongWall(5.0)).extent.max() == 5.0


def test_the_longest_package_name_decides_and_goes_before_what_is_built_in(registered):
    import trimesh

    sw.register("trimesh")(lambda _: tetrahedron(1.0))
    sw.register("trimesh.base")(lambda _: tetrahedron(7.0))
    assert as_shape(trimesh.creation.box()).extent.max() == 7.0


def test_without_a_function_an_object_is_refused(registered):
    with pytest.raises(TypeError, match="Wall"):
        as_shape(Wall(1.0))


def test_conversion_loads_none_of_the_libraries_that_it_knows():
    cad = ["cadquery", "build123d", "OCP"]
    libraries = [*cad, "trimesh", "manifold3d", "shapely", "pyvista", "vedo", "meshio", "open3d"]
    program = f"import sys, shapewright; print([x for x in {libraries!r} if x in sys.modules])"
    assert subprocess.check_output([sys.executable, "-c", program], text=True).strip() == "[]"
