"""Controllers of COLLADA: morphs at the weights of the file, and skins that the joints of the scene move."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.collada.geometry import Geometry, names, read_geometry, rows, source
from shapewright.references.readers.collada.markup import Document, Element, child, children, floats, integers
from shapewright.shapes import Floats, Ints

FindJoint = Callable[[str], Floats | None]
"""The matrix (4, 4) of the joint of this name, from its frame to that of the whole; None where it is not there."""

_DEEPEST = 16


@dataclass(frozen=True, eq=False)
class Posed:
    """What a controller makes of a mesh.

    Attributes:
        geometry: the mesh.
        is_placed: whether it is in the frame of the whole, where joints have put it, and not in that of its node.
    """

    geometry: Geometry
    is_placed: bool


def controlled(document: Document, url: str | None, find: FindJoint, depth: int = 0) -> Posed | None:
    """The mesh that a controller or a geometry of this URL shows; None for one of another file.

    Raises UnreadableError, with the reason.
    """
    bare = (url or "").strip().removeprefix("#")
    found = document.by_id.get(bare)
    if found is not None and found.tag == "geometry":
        return Posed(read_geometry(document, found), is_placed=False)
    controller = document.target(url, "controller")
    if controller is None:
        return None
    inner = next(iter(children(controller, "skin", "morph")), None)
    if inner is None or depth > _DEEPEST:
        raise UnreadableError("broken: a controller that controls nothing, or itself")
    base = controlled(document, inner.get("source"), find, depth + 1)
    if base is None:
        return None
    if inner.tag == "morph":
        return replace(base, geometry=_morphed(document, inner, base.geometry, depth))
    return _skinned(document, inner, base.geometry, find)


def _morphed(document: Document, morph: Element, base: Geometry, depth: int) -> Geometry:
    """The mesh between its targets, by their weights."""
    targets = child(morph, "targets")
    listed, weighed = (
        None if targets is None else source(document, targets, name) for name in ("MORPH_TARGET", "MORPH_WEIGHT")
    )
    if listed is None or weighed is None:
        return base
    weights = rows(document, weighed, 1)[:, 0]
    urls = names(document, listed)
    if len(urls) != len(weights):
        raise UnreadableError(f"broken: a morph of {len(urls)} targets and {len(weights)} weights")
    relative = morph.get("method", "NORMALIZED").upper() == "RELATIVE"
    vertices = base.vertices * (1.0 if relative else 1.0 - weights.sum())
    for url, weight in zip(urls, weights, strict=True):
        if weight:
            target = controlled(document, f"#{url.removeprefix('#')}", lambda _: None, depth + 1)
            assert target is not None, "an id within the file"
            if len(target.geometry.vertices) != len(vertices):
                raise UnreadableError("broken: a morph whose targets have other vertices")
            vertices = vertices + weight * target.geometry.vertices
    return replace(base, vertices=vertices)


def _skinned(document: Document, skin: Element, base: Geometry, find: FindJoint) -> Posed:
    """The mesh where the joints put it; in the pose that it was bound in where one of them is not there."""
    shape = child(skin, "bind_shape_matrix")
    bind = np.eye(4).ravel() if shape is None else floats(shape)
    if len(bind) != 16:
        raise UnreadableError("broken: a bind shape matrix that is none")
    bind = bind.reshape(4, 4)
    bound = base.vertices @ bind[:3, :3].T + bind[:3, 3]
    joints = _joints(document, skin, find)
    if joints is None:
        left_out = {**base.left_out, "pose of a skin without joints": 1}
        return Posed(replace(base, vertices=bound, left_out=left_out), is_placed=False)
    vertex, joint, weight = _weights(document, skin, len(bound), len(joints))
    total = np.bincount(vertex, weight, len(bound))
    free = np.flatnonzero(total <= 0.0)
    weight = weight / np.where(total > 0.0, total, 1.0)[vertex]
    moved = np.einsum("wij,wj->wi", joints[joint, :3, :3], bound[vertex]) + joints[joint, :3, 3]
    vertices = np.stack([np.bincount(vertex, weight * along, len(bound)) for along in moved.T], axis=1).astype(
        np.float64
    )
    vertices[free] = bound[free]
    return Posed(replace(base, vertices=vertices), is_placed=True)


def _joints(document: Document, skin: Element, find: FindJoint) -> Floats | None:
    """(J, 4, 4), from the bound shape to the whole; None where a joint is not there."""
    inputs = child(skin, "joints")
    named = None if inputs is None else source(document, inputs, "JOINT")
    inverse = None if inputs is None else source(document, inputs, "INV_BIND_MATRIX")
    if named is None or inverse is None:
        return None
    found = [find(name) for name in names(document, named)]
    matrices = rows(document, inverse, 16).reshape(-1, 4, 4)
    if len(matrices) != len(found):
        raise UnreadableError(f"broken: a skin of {len(found)} joints and {len(matrices)} inverse bind matrices")
    there = [matrix for matrix in found if matrix is not None]
    return None if len(there) < len(found) or not there else np.asarray(np.stack(there) @ matrices)


def _weights(document: Document, skin: Element, vertex_count: int, joint_count: int) -> tuple[Ints, Ints, Floats]:
    """The vertex, the joint and the weight (W,) of each influence."""
    weighed = child(skin, "vertex_weights")
    if weighed is None:
        raise UnreadableError("broken: a skin without weights")
    offsets = {each.get("semantic"): int(each.get("offset", "0")) for each in children(weighed, "input")}
    described = source(document, weighed, "WEIGHT")
    counts, influences = integers(child(weighed, "vcount")), integers(child(weighed, "v"))
    stride = 1 + max(offsets.values(), default=0)
    if described is None or "JOINT" not in offsets or (counts < 0).any():
        raise UnreadableError("broken: the weights of a skin")
    if len(counts) > vertex_count or counts.sum() * stride != len(influences):
        raise UnreadableError(f"broken: a skin of {len(counts)} vertices and {len(influences)} indices of weights")
    table = influences.reshape(-1, stride)
    joint, number = table[:, offsets["JOINT"]], table[:, offsets["WEIGHT"]]
    values = rows(document, described, 1)[:, 0]
    vertex = np.repeat(np.arange(len(counts)), counts)
    bound = joint >= 0  # -1 stands for the bound shape itself, which counts where nothing else does
    vertex, joint, number = vertex[bound], joint[bound], number[bound]
    if len(joint) and (joint.max() >= joint_count or number.max() >= len(values) or number.min() < 0):
        raise UnreadableError("broken: a skin refers to joints or weights that are not there")
    return vertex, joint, np.maximum(values[number], 0.0)
