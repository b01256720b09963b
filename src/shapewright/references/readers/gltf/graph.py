"""Where the nodes of a glTF scene stand, and which of them show a mesh."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

import msgspec
import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName
from shapewright.references.readers.gltf.document import VISIBILITY, Document, Node, at, extension
from shapewright.shapes import Floats


class _Visibility(msgspec.Struct, frozen=True):
    visible: bool = True


_MOST = 200_000
"""Places of nodes. A small file can announce any number, since a node may stand under several parents."""


@dataclass(frozen=True, eq=False)
class Place:
    """Where a node stands.

    Attributes:
        node: its number in the document.
        matrix: (4, 4), from its frame to that of the whole.
        listed: whether the scene that is shown has it.
        hidden: whether it is not visible, itself or by a node above.
        name: its own, or that of the nearest node above that has one.
    """

    node: int
    matrix: Floats
    listed: bool
    hidden: bool
    name: str = ""


@dataclass(frozen=True, eq=False)
class Graph:
    """The nodes of a document.

    Attributes:
        matrices: (N, 4, 4), from the frame of each node to that of the whole, in the first of its places.
        shown: where nodes with a mesh stand that the scene shows, in the order of the scene.
        notes: which meshes it does not show.
    """

    matrices: Floats
    shown: tuple[Place, ...]
    notes: tuple[str, ...]


def graph(document: Document) -> Graph:
    """The scene that is shown when the file is opened: the default one, else the first.

    Where the document has no scene, all its nodes are shown. A node that stands under several parents stands in several
    places. Raises UnreadableError for nodes that are their own ancestors, and where no scene shows a mesh.
    """
    nodes, scenes = document.nodes, document.scenes
    roots = _roots(nodes)
    default = 0 if document.scene is None else document.scene
    chosen = dict.fromkeys(at(scenes, default, "scene").nodes if scenes or document.scene is not None else roots)
    for node in chosen:
        at(nodes, node, "node")
    places = _places(nodes, roots, chosen)
    matrices = np.empty((len(nodes), 4, 4))
    for place in reversed(places):
        matrices[place.node] = place.matrix
    meshes = [place for place in places if nodes[place.node].mesh is not None]
    shown = tuple(place for place in meshes if place.listed and not place.hidden)
    hidden = sum(place.listed and place.hidden for place in meshes)
    unlisted = sum(not place.listed for place in meshes)
    where = f"not in the scene that opens, one of {len(scenes)}" if len(scenes) > 1 else "in no scene"
    left_out = [f"{count} x mesh left out: {what}" for count, what in ((hidden, "hidden"), (unlisted, where)) if count]
    if not shown and document.meshes:
        raise UnreadableError("no scene shows any of its meshes" if not left_out else
                              f"the scene shows no mesh; {'; '.join(left_out)}")  # fmt: skip
    scene = [] if scenes or not shown else ["it has no scene: all its nodes are shown"]
    return Graph(matrices, shown, (*left_out, *scene))


def trs(translation: Floats, rotation: Floats, scale: Floats) -> Floats:
    """Matrices (..., 4, 4) of a scale (..., 3), then a rotation x, y, z, w (..., 4), then a translation (..., 3).

    A rotation need not be of length 1; one of length 0 turns nothing.
    """
    rotation = _shortened(rotation, np.abs(rotation).max(axis=-1, keepdims=True))  # so that its square is no overflow
    rotation = _shortened(rotation, np.linalg.norm(rotation, axis=-1, keepdims=True))
    x, y, z, w = np.moveaxis(rotation, -1, 0)
    turn = np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=-1),
            np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=-1),
            np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=-1),
        ],
        axis=-2,
    )
    result = np.zeros((*rotation.shape[:-1], 4, 4))
    result[..., :3, :3] = turn * scale[..., None, :]
    result[..., :3, 3] = translation
    result[..., 3, 3] = 1.0
    return result


def _shortened(vectors: Floats, lengths: Floats) -> Floats:
    return np.divide(vectors, lengths, out=np.zeros_like(vectors), where=lengths > 0.0)


def _local(nodes: Sequence[Node]) -> Floats:
    """The matrices (N, 4, 4) of nodes in the frame of their parents."""
    translations = np.array([node.translation for node in nodes]).reshape(-1, 3)
    rotations = np.array([node.rotation for node in nodes]).reshape(-1, 4)
    result = trs(translations, rotations, np.array([node.scale for node in nodes]).reshape(-1, 3))
    for matrix, node in zip(result, nodes, strict=True):
        if node.matrix is not None:
            matrix[:] = np.reshape(node.matrix, (4, 4)).T
    return result


def _roots(nodes: Sequence[Node]) -> list[int]:
    """The nodes without a parent. Raises UnreadableError where following children from them ends nowhere."""
    waits = [0] * len(nodes)
    for described in nodes:
        for child in described.children:
            at(waits, child, "node")
            waits[child] += 1
    roots = [node for node, parents in enumerate(waits) if not parents]
    ready, count = list(roots), 0
    while ready:
        count += 1
        for child in nodes[ready.pop()].children:
            waits[child] -= 1
            if not waits[child]:
                ready.append(child)
    if count < len(nodes):
        raise UnreadableError(f"broken: a cycle, {len(nodes) - count} of its nodes stand below themselves")
    return roots


def _places(nodes: Sequence[Node], roots: Sequence[int], listed: Collection[int]) -> list[Place]:
    """Where all nodes stand, each before those below it."""
    places: list[Place] = []
    local = _local(nodes)
    visible = [extension(node.extensions, VISIBILITY, _Visibility) or _Visibility() for node in nodes]
    waiting = [(root, np.eye(4), False, False, "") for root in reversed(roots)]
    while waiting:
        node, above, shown, hidden, name = waiting.pop()
        shown, hidden = shown or node in listed, hidden or not visible[node].visible
        matrix, name = above @ local[node], PartName.of(nodes[node].name).name or name
        places.append(Place(node, matrix, shown, hidden, name))
        waiting.extend((child, matrix, shown, hidden, name) for child in reversed(nodes[node].children))
        if len(places) + len(waiting) > _MOST:
            raise UnreadableError(f"its nodes stand in more than {_MOST:,} places")
    return places
