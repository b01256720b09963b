"""What an author's function may return, turned into our Mesh or Drawing: by duck type, without importing libraries."""

from __future__ import annotations

from functools import reduce
from typing import Any, cast

import numpy as np

from shapewright.shapes.drawing import Drawing
from shapewright.shapes.mesh import Mesh, concatenate
from shapewright.shapes.points import Points
from shapewright.shapes.shape import ReferenceShape, Shape

TESSELLATION = 5e-4
"""Share of the diagonal by which triangles may depart from a CAD surface: a tenth of a pixel of 64."""
_ACCEPTED = (
    "a Mesh, Drawing, Solid or Sketch, a trimesh.Trimesh or Scene, (vertices, faces), a manifold3d.Manifold or "
    "CrossSection, a shapely geometry, a build123d or CadQuery object, or a list of these"
)


def as_reference(value: Any) -> ReferenceShape:
    """What ``as_shape`` gives, or points: of Points, or a point cloud of Open3D or trimesh.

    Raises TypeError and ValueError as ``as_shape`` does.
    """
    if (points := _points(value)) is None:
        return as_shape(value)
    if not points.extent.max() > 0.0:
        raise ValueError("the points have no size: all lie at one place")
    return points


def as_shape(value: Any) -> Shape:
    """The Mesh or Drawing that a value stands for.

    Accepts what _ACCEPTED says. CAD objects are tessellated to TESSELLATION of their bounding box's diagonal.
    Raises TypeError for anything else, ValueError for a shape that is empty or not finite.
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
    if _points(value) is not None:
        raise TypeError(
            f"it returned points ({_name(value)}), which have no surface; return a mesh: points can be references alone"
        )
    if value is None:
        raise TypeError("it returned nothing (None); end the function with `return shape`")
    if isinstance(value, tuple) and len(value) == 2 and all(_is_table(item) for item in value):
        return _mesh(value[0], value[1])
    if isinstance(value, list | tuple) and not hasattr(value, "_fields"):  # a named tuple is one thing
        return _join([_convert(item) for item in value])
    if hasattr(value, "geom_type") and hasattr(value, "wkb"):
        return _drawing(value)
    for maker in ("mesh", "drawing"):
        if callable(getattr(value, maker, None)):
            return _convert(getattr(value, maker)())
    if callable(getattr(value, "to_mesh", None)) and hasattr(value, "num_tri"):
        mesh = value.to_mesh()
        return _mesh(np.asarray(mesh.vert_properties)[:, :3], mesh.tri_verts)
    if callable(getattr(value, "to_polygons", None)):
        import shapely

        rings: list[Any] = [shapely.Polygon(), *(shapely.Polygon(ring) for ring in value.to_polygons())]
        return _drawing(reduce(shapely.symmetric_difference, rings))
    if callable(getattr(value, "to_mesh", None)) and hasattr(value, "geometry"):
        return _convert(value.to_mesh())
    if hasattr(value, "vertices") and hasattr(value, "faces") and not callable(value.vertices):
        return _mesh(value.vertices, value.faces)
    if callable(getattr(value, "tessellate", None)):
        vertices, faces = value.tessellate(TESSELLATION * _diagonal(value))
        return _mesh([_coordinates(vertex) for vertex in vertices], faces)
    if callable(getattr(value, "vals", None)):
        return _join([_convert(item) for item in value.vals()])
    for wrapper in ("part", "toCompound"):
        inner = getattr(value, wrapper, None)
        if inner is not None:
            return _convert(inner() if callable(inner) and not hasattr(inner, "tessellate") else inner)
    raise TypeError(f"it returned {_name(value)}; return {_ACCEPTED}")


def _name(value: Any) -> str:
    return f"{type(value).__module__}.{type(value).__qualname__}".removeprefix("builtins.")


def _points(value: Any) -> Points | None:
    """The points of a value that holds nothing else; None for any other."""
    if isinstance(value, Points):
        return value
    if hasattr(value, "points") and callable(getattr(value, "has_normals", None)):  # Open3D's PointCloud
        return Points(np.asarray(value.points), np.asarray(value.normals) if value.has_normals() else None)
    if type(value).__name__ == "PointCloud" and hasattr(value, "vertices"):  # trimesh's
        return Points(np.asarray(value.vertices))
    return None


def _is_table(item: Any) -> bool:
    return isinstance(item, np.ndarray) or (isinstance(item, list | tuple) and (len(item) == 0 or np.ndim(item) == 2))


def _mesh(vertices: Any, faces: Any) -> Mesh:
    vertices, faces = np.asarray(vertices, dtype=np.float64), np.asarray(faces, dtype=np.int64)
    if faces.size == 0:
        raise ValueError("the shape is empty: it has no faces")
    if faces.ndim == 2 and faces.shape[1] == 4:
        faces = np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])
    return Mesh(vertices, faces)


def _drawing(geometry: Any) -> Drawing:
    import shapely

    parts = [part for part in shapely.get_parts(geometry) if part.area > 0.0]
    if not parts:
        raise ValueError("the drawing is empty: give lines a width, for example with .buffer(0.01)")
    if not np.isfinite(shapely.get_coordinates(parts)).all():
        raise ValueError("some coordinates of the drawing are not finite (NaN or infinity)")
    return Drawing(cast("shapely.Polygon | shapely.MultiPolygon", shapely.union_all(parts)))


def _join(shapes: list[Shape]) -> Shape:
    meshes = [shape for shape in shapes if isinstance(shape, Mesh)]
    drawings = [shape for shape in shapes if isinstance(shape, Drawing)]
    if not shapes:
        raise ValueError("the shape is empty: it is a list without parts")
    if meshes and drawings:
        raise TypeError("it returned a list that mixes meshes and drawings; return one kind")
    return concatenate(meshes) if meshes else _drawing([drawing.geometry for drawing in drawings])


def _diagonal(solid: Any) -> float:
    for name, size in (("bounding_box", "diagonal"), ("BoundingBox", "DiagonalLength")):
        if callable(getattr(solid, name, None)):
            return float(getattr(getattr(solid, name)(), size))
    return 1.0


def _coordinates(vertex: Any) -> tuple[float, float, float]:
    if hasattr(vertex, "toTuple"):
        vertex = vertex.toTuple()
    if hasattr(vertex, "X"):
        return (vertex.X, vertex.Y, vertex.Z)
    x, y, z = vertex
    return (float(x), float(y), float(z))
