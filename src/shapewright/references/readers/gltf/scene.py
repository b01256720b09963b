"""A glTF file, read into the triangles of the scene that it shows."""

from __future__ import annotations

from functools import cache, lru_cache
from pathlib import Path

import msgspec
import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.gltf import draco
from shapewright.references.readers.gltf.accessors import Accessors, accessors
from shapewright.references.readers.gltf.buffers import views
from shapewright.references.readers.gltf.container import unpack
from shapewright.references.readers.gltf.document import (
    INSTANCES,
    Document,
    Node,
    Primitive,
    at,
    extension,
    material_name,
    parse,
)
from shapewright.references.readers.gltf.graph import graph, trs
from shapewright.references.readers.gltf.primitives import Geometry, geometry, has_triangles, size
from shapewright.references.readers.gltf.skins import joint_matrices, posed
from shapewright.references.readers.scene_parts import Piece, Scene, join, placed, refuse_too_many
from shapewright.shapes import Floats


class _Instances(msgspec.Struct, rename="camel", frozen=True):
    attributes: dict[str, int] = {}


_USUAL = {"TRANSLATION": (0.0, 0.0, 0.0), "ROTATION": (0.0, 0.0, 0.0, 1.0), "SCALE": (1.0, 1.0, 1.0)}
"""What of an instance counts where it is not told."""

_KEPT = 4
"""Streams of Draco that are held at once."""


def read_gltf(path: Path, data: bytes) -> Scene:
    """The triangles of a glTF file's bytes, Y up, in metres.

    Meshes stand where the scene shows them: by their nodes, their instances, or the joints of their skin; morph targets
    count as their default weights say. Points and lines, looks and motion are left out. Parts
    have the name of their node, or of the next one above, or of their mesh. Files beside it are looked
    for in its own folder. Raises UnreadableError, with the reason.
    """
    container = unpack(data)
    document, unknown = parse(container.text)
    read_view = views(document, path.parent, container.binary)
    arrays = accessors(document, read_view)
    shown = graph(document)
    places = [(place.matrix, document.nodes[place.node], place.name) for place in shown.shown]
    copies = [(matrix @ _instances(node, arrays), node, name) for matrix, node, name in places]
    primitives = [(p, len(matrices)) for matrices, node, _ in copies for p in _primitives(document, node)]
    refuse_too_many(sum(count * size(p, arrays) for p, count in primitives if has_triangles(p)))
    others = sum(count for p, count in primitives if not has_triangles(p))

    @lru_cache(_KEPT)
    def stream(view: int) -> draco.Decoded:
        return draco.decode(read_view(view))

    @cache
    def joints_of(skin: int) -> Floats:
        return joint_matrices(document, skin, shown.matrices, arrays)

    @cache
    def geometries(mesh: int, morph: tuple[float, ...]) -> list[tuple[Geometry, PartName]]:
        found = at(document.meshes, mesh, "mesh")
        shown = [p for p in found.primitives if has_triangles(p)]
        return [
            (geometry(p, morph, arrays, stream), PartName.of(found.name, material_name(document, p.material)))
            for p in shown
        ]

    pieces, names, spare = list[Piece](), list[tuple[PartName, int]](), 0
    elsewhere = within = 0
    for matrices, node, name in copies:
        joints = None if node.skin is None else joints_of(node.skin)
        for part, called in geometries(*_mesh(document, node)):
            spare += part.spare * len(matrices)
            elsewhere += part.elsewhere
            within += part.within
            if joints is not None and part.joints.size:
                pieces.append((posed(part, joints), part.faces))
            else:
                pieces += (placed(part.vertices, part.faces, matrix) for matrix in matrices)
            copied = 1 if joints is not None and part.joints.size else len(matrices)
            names.append((PartName(name or called.name, called.material), copied * len(part.faces)))
    vertices, faces = join(pieces)
    if others and not len(faces):
        raise UnreadableError("no triangles, only points or lines")
    notes = [f"{others} x primitive left out: points, lines, or without positions"] if others else []
    notes += [f"{spare} x corner left out: no whole triangle"] if spare else []
    notes += [f"{elsewhere} x mesh with positions elsewhere than the file says of them"] if elsewhere else []
    notes += [f"{within} x mesh whose positions or indices begin within a number"] if within else []
    notes = [*container.notes, *unknown, *shown.notes, *notes]
    return Scene(vertices, faces, tuple(notes), unit=1.0, up="y", parts=Parts.of(names))


def _mesh(document: Document, node: Node) -> tuple[int, tuple[float, ...]]:
    """The mesh of a node that has one, and the weights of its morph targets."""
    assert node.mesh is not None
    weights = at(document.meshes, node.mesh, "mesh").weights if node.weights is None else node.weights
    return node.mesh, tuple(weights)


def _primitives(document: Document, node: Node) -> list[Primitive]:
    return at(document.meshes, _mesh(document, node)[0], "mesh").primitives


def _instances(node: Node, arrays: Accessors) -> Floats:
    """The matrices (I, 4, 4) of the copies of a node's mesh, in the frame of the node; one where it has no copies."""
    instances = extension(node.extensions, INSTANCES, _Instances)
    if instances is None or not instances.attributes:
        return np.eye(4)[None]
    if node.skin is not None:
        raise UnreadableError("a mesh with a skin and with instances, which no rule places")
    given = {name: instances.attributes.get(name) for name in _USUAL}
    counts = {at(arrays.described, index, "accessor").count for index in instances.attributes.values()}
    if len(counts) > 1:
        raise UnreadableError(f"broken: attributes of instances of {', '.join(map(str, sorted(counts)))} elements")
    refuse_too_many(max(counts))
    return trs(
        *(
            np.tile(usual, (*counts, 1)) if (index := given[name]) is None else arrays.floats(index, len(usual))
            for name, usual in _USUAL.items()
        )
    )
