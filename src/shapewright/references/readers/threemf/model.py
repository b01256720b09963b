"""One model part of a 3MF package: its objects, and what it builds."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.polygons import check_indices
from shapewright.references.readers.text import numbers, utf8
from shapewright.references.readers.threemf.markup import Element, outline
from shapewright.references.readers.threemf.number_blocks import Cut, cut
from shapewright.shapes import Floats, Ints

_CORES = (
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/2013/01",  # the draft, version 0.93
    "",
)
_LATTICE = "/3dmanufacturing/beamlattice/"
_SLICES = "/3dmanufacturing/slice/"
_DISPLAYED = ("/3dmanufacturing/material/", "/3dmanufacturing/production/", "/3dmanufacturing/trianglesets/")
"""Extensions that change no place of a triangle, or whose places are read."""
_UNITS = {"micron": 1e-3, "millimeter": 1.0, "centimeter": 10.0, "inch": 25.4, "foot": 304.8, "meter": 1000.0}
"""Millimetres (3MF core specification, "ST_Unit")."""
_ENCRYPTED = b"%3McF"
"""What a part begins with that the secure content extension encrypts or compresses."""
_DIGITS = 20
_SHOWN = 200


@dataclass(frozen=True, eq=False)
class Use:
    """A build item or a component: an object, and where it stands.

    Attributes:
        number: of the object.
        path: the part with the object, None for the same part.
        matrix: (4, 4), from the frame of the object to that of the user.
    """

    number: int
    path: str | None
    matrix: Floats


@dataclass(frozen=True, eq=False)
class Object:
    """An object of a part.

    Attributes:
        name: what it is called, empty without a name.
        material: of its triangles, where they have no other one; empty where it is not named.
        kind: "model", "surface", or a type of what supports it while it is made.
        vertices: (V, 3) of its own mesh.
        faces: (F, 3) of its own mesh.
        parts: its components.
        has_beams: whether a lattice of beams belongs to it.
        is_sketch: whether its mesh is too coarse to stand for the slices that it has.
        others: elements of extensions that are not known, in words; one of them can be its whole form.
    """

    name: str
    material: str
    kind: str
    vertices: Floats
    faces: Ints
    parts: tuple[Use, ...]
    has_beams: bool
    is_sketch: bool
    others: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Model:
    """A model part.

    Attributes:
        unit: millimetres of its unit.
        objects: by their numbers.
        items: what is built.
    """

    unit: float
    objects: dict[int, Object]
    items: tuple[Use, ...]


def read_model(data: bytes) -> Model:
    """The objects and the items of a part's bytes.

    Raises UnreadableError where the XML is broken, and where it requires an extension that is not read.
    """
    if data.startswith(_ENCRYPTED):
        raise UnreadableError("it is encrypted (the secure content extension of 3MF); save it without")
    parts = cut(utf8(data))
    elements = outline(parts.outline)
    root = elements[0]
    if root.name != "model" or root.space not in _CORES:
        raise UnreadableError(f"broken: a model part that begins with <{root.name} xmlns={root.space!r}>, so no 3MF")
    _refuse_unknown(root)
    unit = root.attributes.get("unit", "millimeter").strip()
    if unit not in _UNITS:
        raise UnreadableError(f"broken: it is in {unit[:60]!r}, which is no unit of 3MF")
    objects: dict[int, Object] = {}
    materials = _materials(elements)
    for start, stop in _runs(elements):
        element = elements[start]
        number = _whole(element, "id")
        if number in objects:
            raise UnreadableError(f"broken: two objects have the id {number}")
        objects[number] = _object(element, elements[start + 1 : stop], parts, materials)
    items = (_use(each) for each in elements if each.depth == 2 and each.name == "item" and each.space == root.space)
    return Model(_UNITS[unit], objects, tuple(items))


def _refuse_unknown(root: Element) -> None:
    known = (*_DISPLAYED, _LATTICE, _SLICES)
    for prefix in root.attributes.get("requiredextensions", "").split():
        space = root.prefixes.get(prefix, prefix)
        if not any(each in space for each in known):
            raise UnreadableError(f"it needs the extension {space[:_SHOWN]}, which is not read; save it without")


def _runs(elements: Sequence[Element]) -> Iterator[tuple[int, int]]:
    """Where each object begins among the elements, and where what is behind it begins."""
    start, space = None, elements[0].space
    for i, element in enumerate([*elements, elements[0]]):
        if element.depth <= 2:
            if start is not None:
                yield start, i
            start = i if (element.depth, element.name, element.space) == (2, "object", space) else None


def _materials(elements: Sequence[Element]) -> dict[tuple[str, str], str]:
    """The names of base materials, by the id of their group and their index in it."""
    names: dict[tuple[str, str], str] = {}
    group, index = "", 0
    for each in elements:
        if each.name == "basematerials" and each.space == elements[0].space:
            group, index = each.attributes.get("id", ""), 0
        elif each.name == "base" and each.space == elements[0].space:
            names[group, str(index)] = each.attributes.get("name", "")
            index += 1
    return names


def _object(element: Element, below: Sequence[Element], parts: Cut, materials: Mapping[tuple[str, str], str]) -> Object:
    vertices, faces = np.empty((0, 3)), np.empty((0, 3))
    own = [each for each in below if each.space == element.space]
    for each in own:
        if each.name == "vertices":
            vertices = parts.rows(int(each.attributes["block"]), b"vertex", (b"x", b"y", b"z"))
        elif each.name == "triangles":
            faces = parts.rows(int(each.attributes["block"]), b"triangle", (b"v1", b"v2", b"v3"))
    if not np.isfinite(faces).all() or not np.array_equal(faces, np.rint(faces)):
        raise UnreadableError("broken: triangles with corners that are no whole numbers")
    corners = faces.astype(np.int64)
    check_indices(corners.reshape(-1), len(vertices))
    foreign = [each for each in below if each.space != element.space]
    looks = element.attributes.get("pid", ""), element.attributes.get("pindex", "0")
    return Object(
        name=element.attributes.get("name", ""),
        material=materials.get(looks, ""),
        kind=element.attributes.get("type", "model"),
        vertices=vertices,
        faces=corners,
        parts=tuple(_use(each) for each in own if each.name == "component"),
        has_beams=any(_LATTICE in each.space for each in foreign),
        is_sketch=element.attributes.get("meshresolution") == "lowres",
        others=tuple(
            f"<{each.name}> of {each.space[:_SHOWN]}"
            for each in foreign
            if not any(known in each.space for known in (*_DISPLAYED, _LATTICE, _SLICES))
        ),
    )


def _use(element: Element) -> Use:
    text = element.attributes.get("transform")
    matrix = np.eye(4)
    if text is not None:
        values = numbers(text.encode())
        if len(values) != 12:
            raise UnreadableError(f"broken: a transform of {len(values)} numbers, not 12")
        matrix[:3] = values.reshape(4, 3).T
    return Use(_whole(element, "objectid"), element.attributes.get("path"), matrix)


def _whole(element: Element, attribute: str) -> int:
    text = element.attributes.get(attribute, "").strip()
    if not (text.isascii() and text.isdecimal() and len(text) < _DIGITS):
        raise UnreadableError(f"broken: <{element.name}> has {attribute}={text[:60]!r}, which is no number")
    return int(text)
