"""What an author's function may return, turned into our Mesh or Drawing."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import Any

import numpy as np

from shapewright.shapes.conversion.naming import called, refusal
from shapewright.shapes.conversion.parts import Part
from shapewright.shapes.conversion.polygons import drawing_of
from shapewright.shapes.conversion.registry import converter_of
from shapewright.shapes.conversion.tables import coordinates, is_table, mesh_of, soup
from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, concatenate
from shapewright.shapes.points import Points
from shapewright.shapes.shape import ReferenceShape, Shape
from shapewright.shapes.views import Views

_TABLES = (("vertices", "faces"), ("verts", "faces"), ("points", "faces"), ("vertices", "triangles"))
"""Names under which objects and dicts hold vertices and faces."""
_PAIR = "for one mesh return the tuple (vertices, faces)"


def as_reference(value: Any) -> ReferenceShape:
    """What ``as_shape`` gives, views as they are, or points: of Points, or a point cloud of Open3D or trimesh.

    Raises TypeError and ValueError as ``as_shape`` does.
    """
    if isinstance(value, Views):
        return value
    if (points := _points(value)) is None:
        return as_shape(value)
    if not points.extent.max() > 0.0:
        raise ValueError("the points have no size: all lie at one place")
    return points


def as_shape(value: Any) -> Shape:
    """The Mesh or Drawing that a value stands for, with names as labels, and colours.

    It takes our own shapes, ``(vertices, faces)``, the objects of many libraries (``registry``), an object that has a
    method ``__shapewright__()``, and lists, iterators and dicts by name of these, nested.
    Raises TypeError for anything else, with the way out, ValueError for a shape that is empty or not finite.
    """
    shape = _convert(value)
    if isinstance(shape, Mesh):
        if not len(shape.faces):
            raise ValueError("the shape is empty: it has no faces")
        if not shape.extent.max() > 0.0:
            raise ValueError("the shape has no size: all its vertices coincide")
    return shape


def _convert(value: Any) -> Shape:
    if isinstance(value, Mesh | Drawing):
        return value
    if isinstance(value, Part):
        shape = _convert(value.value)
        return value.dressed(shape) if isinstance(shape, Mesh) else shape
    if value is None:
        raise TypeError("it returned nothing (None); end the function with `return shape`")
    if _points(value) is not None:
        kind, way_out = called(value), "return a mesh: points can be references alone"
        raise TypeError(f"it returned points ({kind}), which have no surface; {way_out}")
    if callable(own := getattr(value, "__shapewright__", None)) and not isinstance(value, type):
        return _convert(own())
    if not isinstance(value, np.ndarray) and (converter := converter_of(value)):  # libraries have arrays of their own
        return _convert(converter(value))
    if (tables := _tables(value)) is not None:
        return mesh_of(*tables)
    if (parts := _parts(value)) is not None:
        return _join(list(parts))
    if isinstance(value, str | bytes) or hasattr(value, "__fspath__"):
        raise refusal(value, "for the shape of a file return what a library loads of it, as trimesh.load(path) does")
    raise refusal(value)


def _tables(value: Any) -> tuple[Any, Any] | None:
    """The vertices and faces that a value holds; None for one that holds none."""
    for vertices, faces in _TABLES:
        if isinstance(value, Mapping) and value.keys() == {vertices, faces}:
            return value[vertices], value[faces]
        if not isinstance(value, Mapping) and hasattr(value, vertices) and hasattr(value, faces):
            found = getattr(value, vertices), getattr(value, faces)
            return None if any(callable(table) for table in found) else found
    if isinstance(value, tuple) and len(value) == 2 and (vectors := coordinates(value[0])) and is_table(value[1]):
        return vectors, value[1]
    if not isinstance(value, tuple) or not all(is_table(item) for item in value):
        return None
    if len(value) == 2:
        return value[0], value[1]
    if len(value) == 3 and (len(value[1]) == 0 or len(value[1][0]) == 2):  # as Blender's from_pydata
        return value[0], value[2]
    raise TypeError(f"it returned a tuple of {len(value)} tables; {_PAIR}")


def _parts(value: Any) -> Iterator[Shape] | None:
    """The shapes of what holds several; None for one that does not."""
    if isinstance(value, np.ndarray) or hasattr(value, "detach"):
        return _of_array(value)
    if isinstance(value, Mapping):
        return (_item(Part(part, str(name)), name) for name, part in value.items())
    if isinstance(value, tuple) and len(value) == 2 and isinstance(value[0], str):
        return (_item(Part(value[1], value[0]), value[0]) for _ in (0,))
    if isinstance(value, Set):
        raise refusal(value, "its order changes from run to run; return a list")
    if isinstance(value, str | bytes) or hasattr(value, "__fspath__"):
        return None
    if isinstance(value, list) and len(value) == 2 and all(is_table(item) and len(item) for item in value):
        raise refusal(value, f"it holds two tables; {_PAIR}")
    if isinstance(value, Iterable) and (isinstance(value, list | tuple | Iterator)):
        return (_item(part, number) for number, part in enumerate(value))
    return None


def _of_array(value: Any) -> Iterator[Shape]:
    """The triangles of an array (F, 3, 3), the parts of an array of objects."""
    form = tuple(value.shape)
    if len(form) == 3 and form[1:] == (3, 3):
        return iter([soup(value)])
    if isinstance(value, np.ndarray) and value.dtype == object and value.ndim == 1:
        return (_item(part, number) for number, part in enumerate(value))
    raise refusal(value, f"it is an array of the form {form}; return (vertices, faces)")


def _item(value: Any, key: object) -> Shape:
    try:
        return _convert(value)
    except (TypeError, ValueError) as error:
        kind = TypeError if isinstance(error, TypeError) else ValueError
        text = str(error)
        inner = text.removeprefix("at ") if text.startswith("at [") else f": {text}"
        raise kind(f"at [{key!r}]{inner}") from error


def _join(shapes: list[Shape]) -> Shape:
    meshes = [shape for shape in shapes if isinstance(shape, Mesh)]
    drawings = [shape for shape in shapes if isinstance(shape, Drawing)]
    if not shapes:
        raise ValueError("the shape is empty: it is a list without parts")
    if meshes and drawings:
        raise TypeError("it returned a list that mixes meshes and drawings; return one kind")
    return concatenate(meshes) if meshes else drawing_of([drawing.geometry for drawing in drawings])


def _points(value: Any) -> Points | None:
    """The points of a value that holds nothing else; None for any other."""
    if isinstance(value, Points):
        return value
    if hasattr(value, "points") and callable(getattr(value, "has_normals", None)):  # Open3D's PointCloud
        return Points(np.asarray(value.points), np.asarray(value.normals) if value.has_normals() else None)
    if type(value).__name__ == "PointCloud" and hasattr(value, "vertices"):  # trimesh's
        return Points(np.asarray(value.vertices))
    return None
