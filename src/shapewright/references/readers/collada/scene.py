"""A COLLADA file, read into the triangles of the scene that it shows."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.collada.controllers import controlled
from shapewright.references.readers.collada.geometry import Geometry, read_geometry
from shapewright.references.readers.collada.markup import Document, Element, child, children, floats, parse, words
from shapewright.references.readers.scene_parts import Piece, Scene, join, placed, refuse_too_many
from shapewright.shapes import Floats

_MOST = 200_000
"""Places of nodes. A small file can announce any number, since a node may be instanced by many."""
_DEEPEST = 200
_SIZES = {"matrix": 16, "translate": 3, "rotate": 4, "scale": 3, "lookat": 9}


@dataclass(frozen=True, eq=False)
class _Place:
    """A node, where it stands (4, 4), whether it is hidden, itself or by one above, and the nearest name."""

    node: Element
    matrix: Floats
    hidden: bool
    name: PartName


def read_collada(path: Path, data: bytes) -> Scene:
    """The triangles of the bytes of a .dae or .zae file, in its own unit and axes.

    Meshes stand where the nodes of the scene show them, skins where their joints put them, and morphs at the weights of
    the file. Points and lines, materials, lights, cameras and motion are left out. Raises UnreadableError, with the
    reason.
    """
    del path  # it may refer to other documents, which are left out with a note
    document = parse(data)
    left_out: Counter[str] = Counter()
    places = _places(document, _shown(document), left_out)
    joints = _named(places)

    @cache
    def geometry(element: Element) -> Geometry:
        return read_geometry(document, element)

    pieces, names, triangles = list[Piece](), list[tuple[PartName, int]](), 0
    for place in places:
        for instance in children(place.node, "instance_geometry", "instance_controller"):
            if place.hidden:
                left_out["mesh that is hidden"] += 1
                continue
            matrix = place.matrix
            if instance.tag == "instance_geometry":
                element = document.target(instance.get("url"), "geometry")
                found = None if element is None else geometry(element)
            else:
                posed = controlled(document, instance.get("url"), joints.get)
                found = None if posed is None else posed.geometry
                matrix = np.eye(4) if posed is not None and posed.is_placed else matrix
            if found is None:
                left_out["mesh of another file"] += 1
                continue
            left_out.update(found.left_out)
            triangles += len(found.faces)
            refuse_too_many(triangles)
            pieces.append(placed(found.vertices, found.faces, matrix))
            called = _materials(document, instance)
            for symbol, count in found.materials:
                names.append((PartName.of(place.name.name, called.get(symbol, symbol)), count))
    notes = tuple(f"{count} x {what} left out" for what, count in left_out.items())
    return Scene(*join(pieces), notes, document.unit, document.up, Parts.of(names))


def _shown(document: Document) -> Element:
    """The scene that the file shows: the one that it names, else the first."""
    named = child(document.root, "scene")
    instance = None if named is None else child(named, "instance_visual_scene")
    if instance is not None:
        found = document.target(instance.get("url"), "visual_scene")
        if found is None:
            raise UnreadableError(f"it shows a scene of another file, {instance.get('url', '')[:200]}")
        return found
    library = child(document.root, "library_visual_scenes")
    found = None if library is None else child(library, "visual_scene")
    if found is None:
        raise UnreadableError("it has no scene, so nothing says what is shown")
    return found


def _places(document: Document, scene: Element, left_out: Counter[str]) -> list[_Place]:
    """Where all nodes stand, with those that they are instances of."""
    places: list[_Place] = []
    roots = [(node, np.eye(4), False, PartName(), 0) for node in children(scene, "node")]
    waiting = roots[::-1]
    while waiting:
        node, above, hidden, name, depth = waiting.pop()
        matrix = above @ _local(node)
        hidden = hidden or _is_hidden(node)
        own = PartName.of(node.get("name"))
        name = own if own.name else name
        places.append(_Place(node, matrix, hidden, name))
        below = []
        for each in children(node, "node", "instance_node"):
            target = each if each.tag == "node" else document.target(each.get("url"), "node")
            if target is None:
                left_out["node of another file"] += 1
            else:
                below.append((target, matrix, hidden, name, depth + 1))
        waiting.extend(below[::-1])
        if depth > _DEEPEST:
            raise UnreadableError(f"broken: its nodes are more than {_DEEPEST} levels deep, or stand below themselves")
        if len(places) + len(waiting) > _MOST:
            raise UnreadableError(f"its nodes stand in more than {_MOST:,} places")
    return places


def _materials(document: Document, instance: Element) -> dict[str, str]:
    """The names of materials by what the mesh of an instance calls them."""
    found: dict[str, str] = {}
    for bound in instance.iter("instance_material"):
        material = document.by_id.get((bound.get("target") or "").removeprefix("#"))
        if material is not None:
            found[bound.get("symbol", "")] = material.get("name") or material.get("id")
    return found


def _named(places: list[_Place]) -> dict[str, Floats]:
    """The matrices of nodes by what skins call them: their scoped ids, else their ids, else their names."""
    found: dict[str, Floats] = {}
    for key in ("sid", "id", "name"):
        for place in places:
            found.setdefault(place.node.get(key, ""), place.matrix)
    return found


def _is_hidden(node: Element) -> bool:
    """Whether a program has written that a node is not visible, which the format itself has no word for."""
    techniques = (each for extra in children(node, "extra") for each in children(extra, "technique"))
    said = (words(child(technique, "visibility")).strip().lower() for technique in techniques)
    return any(word in ("0", "false", "0.0") for word in said)


def _local(node: Element) -> Floats:
    """The matrix (4, 4) of a node: its transformations in their order."""
    result = np.eye(4)
    for step in node:
        if step.tag == "skew":
            raise UnreadableError("a node with a skew, which is not read; export it with matrices")
        if step.tag in _SIZES:
            values = floats(step)
            if len(values) != _SIZES[step.tag]:
                raise UnreadableError(f"broken: a {step.tag} of {len(values)} numbers, not of {_SIZES[step.tag]}")
            result = result @ _step(step.tag, values)
    return result


def _step(kind: str, values: Floats) -> Floats:
    result = np.eye(4)
    if kind == "matrix":
        return values.reshape(4, 4)
    if kind == "translate":
        result[:3, 3] = values
    elif kind == "scale":
        result[:3, :3] = np.diag(values)
    elif kind == "rotate":
        result[:3, :3] = _rotation(values[:3], np.radians(values[3]))
    else:
        eye, interest, up = values.reshape(3, 3)
        back = _unit(eye - interest)
        right = _unit(np.cross(up, back))
        result[:3] = np.stack([right, np.cross(back, right), back, eye], axis=1)
    return result


def _rotation(axis: Floats, angle: float) -> Floats:
    """(3, 3), by Rodrigues; an axis of length 0 turns nothing."""
    x, y, z = _unit(axis)
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + np.sin(angle) * across + (1.0 - np.cos(angle)) * (across @ across))


def _unit(vector: Floats) -> Floats:
    length = float(np.linalg.norm(vector))
    return vector / length if length > 0.0 else vector
