"""The meshes of a COLLADA file: sources of numbers, and the triangles, polygons, strips and fans that refer to them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.collada.markup import Document, Element, child, children, floats, integers, words
from shapewright.references.readers.polygons import Polygons, check_indices, triangulate, triangulate_with_holes
from shapewright.shapes import Floats, Ints

_OTHERS = {"lines": "lines", "linestrips": "line strip"}
_FORMS = ("convex_mesh", "spline", "brep")
_ARRAYS = ("float_array", "Name_array", "IDREF_array", "SIDREF_array", "int_array")


@dataclass(frozen=True, eq=False)
class Geometry:
    """A mesh in its own frame.

    Attributes:
        vertices: (V, 3).
        faces: (F, 3).
        left_out: how often what was left out, in words.
        materials: what each stretch of faces calls its material, with its length.
    """

    vertices: Floats
    faces: Ints
    left_out: Mapping[str, int]
    materials: tuple[tuple[str, int], ...] = ()


def read_geometry(document: Document, geometry: Element) -> Geometry:
    """The mesh of a ``geometry`` element. Raises UnreadableError, with the reason."""
    mesh = child(geometry, "mesh")
    if mesh is None:
        form = next((each.tag for each in geometry if each.tag in _FORMS), "geometry of an unknown form")
        return Geometry(np.empty((0, 3)), np.empty((0, 3), np.int64), {form.replace("_", " "): 1})
    vertices = _positions(document, mesh)
    left_out: Counter[str] = Counter()
    faces, materials = [np.empty((0, 3), np.int64)], list[tuple[str, int]]()
    for primitive in mesh:
        if primitive.tag in _OTHERS:
            left_out[_OTHERS[primitive.tag]] += 1
        elif primitive.tag in ("triangles", "polylist", "polygons", "tristrips", "trifans"):
            faces.append(_faces(primitive, vertices))
            materials.append((primitive.get("material", ""), len(faces[-1])))
    return Geometry(vertices, np.concatenate(faces), left_out, tuple(materials))


def source(document: Document, inputs: Element, semantic: str) -> Element | None:
    """The ``source`` element of an input of this meaning among the children; None where there is none."""
    found = next((each for each in children(inputs, "input") if each.get("semantic") == semantic), None)
    if found is None:
        return None
    target = document.target(found.get("source"), "source")
    if target is None:
        raise UnreadableError(f"it needs {found.get('source')[:200]}, numbers of another file")
    return target


def rows(document: Document, described: Element, width: int) -> Floats:
    """The numbers (N, width) of a source, by its accessor. Raises UnreadableError where they are not all there."""
    accessor = _accessor(described)
    array = _array(document, described, accessor)
    values = floats(array)
    _expect(len(values), array)
    count, stride, offset = (_whole(accessor, name, usual) for name, usual in _ACCESSOR)
    columns = _columns(accessor, width)
    if count and offset + (count - 1) * stride + max(columns) >= len(values):
        raise UnreadableError(f"broken: an accessor of {count} rows goes beyond {len(values)} numbers")
    starts = offset + stride * np.arange(count)
    return np.asarray(values[starts[:, None] + np.array(columns)])


def names(document: Document, described: Element) -> list[str]:
    """The words of a source of names."""
    array = _array(document, described, _accessor(described))
    found = words(array).split()
    _expect(len(found), array)
    return found


_ACCESSOR = (("count", 0), ("stride", 1), ("offset", 0))


def _accessor(described: Element) -> Element:
    common = child(described, "technique_common")
    accessor = None if common is None else child(common, "accessor")
    if accessor is None:
        raise UnreadableError("broken: a source without an accessor")
    return accessor


def _array(document: Document, described: Element, accessor: Element) -> Element:
    name = (accessor.get("source") or "").removeprefix("#")
    array = document.by_id.get(name)
    if array is None or array.tag not in _ARRAYS:
        array = next(iter(children(described, *_ARRAYS)), None)
    if array is None:
        raise UnreadableError("broken: a source without an array")
    return array


def _whole(element: Element, name: str, usual: int) -> int:
    text = element.get(name, str(usual)).strip()
    if not text.isdecimal() or len(text) > 15:
        raise UnreadableError(f"broken: {element.tag} has the {name} {text[:60]!r}")
    return int(text)


def _expect(found: int, array: Element) -> None:
    announced = _whole(array, "count", found)
    if found != announced:
        raise UnreadableError(f"broken: {array.tag} announces {announced} values, but has {found}")


def _columns(accessor: Element, width: int) -> list[int]:
    """Which numbers of a row are meant: those of the parameters that have a name, since one without is passed over."""
    params = children(accessor, "param")
    if width == 16:
        return list(range(16))
    named = [i for i, param in enumerate(params) if param.get("name")]
    by_name = {params[i].get("name").upper(): i for i in named}
    if width == 3 and {"X", "Y", "Z"} <= set(by_name):
        return [by_name[axis] for axis in "XYZ"]
    columns = named or list(range(max(len(params), min(_whole(accessor, "stride", 1), width))))
    if len(columns) < width:
        raise UnreadableError(f"broken: positions or weights of {len(columns)} numbers, not of {width}")
    return columns[:width]


def _positions(document: Document, mesh: Element) -> Floats:
    vertices = child(mesh, "vertices")
    described = None if vertices is None else source(document, vertices, "POSITION")
    return np.empty((0, 3)) if described is None else rows(document, described, 3)


def _faces(primitive: Element, vertices: Floats) -> Ints:
    """The triangles (F, 3) of a primitive."""
    inputs = children(primitive, "input")
    offsets = [_whole(each, "offset", 0) for each in inputs]
    vertex = next((o for o, each in zip(offsets, inputs, strict=True) if each.get("semantic") == "VERTEX"), None)
    stretches = children(primitive, "p")
    holed = children(primitive, "ph")
    if vertex is None:
        if stretches or holed:
            raise UnreadableError(f"broken: {primitive.tag} without positions")
        return np.empty((0, 3), np.int64)
    loops = [_corners(p, 1 + max(offsets), vertex) for p in stretches]
    corners = np.concatenate([np.empty(0, np.int64), *loops])
    lengths = np.array([len(loop) for loop in loops], dtype=np.int64)
    count = _whole(primitive, "count", len(lengths))
    check_indices(corners, len(vertices))
    if primitive.tag == "triangles":
        _match(len(corners), 3 * count, primitive)
        return corners.reshape(-1, 3)
    if primitive.tag == "polylist":
        lengths = integers(child(primitive, "vcount"))
        _match(len(lengths), count, primitive)
        if (lengths < 0).any():
            raise UnreadableError("broken: a polygon with a negative number of corners")
        _match(len(corners), int(lengths.sum()), primitive)
    if primitive.tag in ("polylist", "polygons"):
        around = triangulate(Polygons(vertices, corners, lengths))
        return np.concatenate([around, *(_with_holes(ph, vertices, 1 + max(offsets), vertex) for ph in holed)])
    cut = _of_strip if primitive.tag == "tristrips" else _of_fan
    return np.concatenate([np.empty((0, 3), np.int64), *(cut(loop) for loop in loops)])


def _corners(p: Element, stride: int, vertex: int) -> Ints:
    indices = integers(p)
    if len(indices) % stride:
        raise UnreadableError(f"broken: {len(indices)} indices, which is no multiple of its {stride} inputs")
    return indices[vertex::stride]


def _match(found: int, announced: int, primitive: Element) -> None:
    if found != announced:
        raise UnreadableError(f"broken: {primitive.tag} need {announced} corners or counts, but have {found}")


def _with_holes(ph: Element, vertices: Floats, stride: int, vertex: int) -> Ints:
    loops = [_corners(each, stride, vertex) for each in children(ph, "p", "h")]
    for loop in loops:
        check_indices(loop, len(vertices))
    return triangulate_with_holes(vertices, loops)


def _of_strip(corners: Ints) -> Ints:
    faces = np.stack([corners[:-2], corners[1:-1], corners[2:]], axis=1)
    faces[1::2, :2] = faces[1::2, 1::-1]
    return faces


def _of_fan(corners: Ints) -> Ints:
    return np.stack(np.broadcast_arrays(corners[:1], corners[1:-1], corners[2:]), axis=1)
