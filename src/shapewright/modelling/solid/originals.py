"""Where faces come from: manifold3d keeps the ids of originals, and of faces, through booleans.

An original is a part that bears a label. A face id is given only where several rules of a grammar made one original:
then ids tell which rule made which face.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from manifold3d import Manifold, Mesh64
from numpy.typing import NDArray

from shapewright.shapes import Floats, Ints, Mesh

NO_ID = 1 << 30
FACE_ID = NO_ID + 1
"""Face ids that are given start here: more triangles than this are in no mesh. manifold3d keeps 32 bits of them."""


def manifold_of(
    points: Floats, faces: Ints, owners: Ints, originals: Sequence[int], face_ids: NDArray[np.uint64] | None = None
) -> Manifold:
    """A manifold whose face i (of F, 3) comes from the original ``originals[owners[i]]`` of manifold3d.

    face_ids: (F,) or None. manifold3d keeps them through booleans, and keeps edges between different ones.
    """
    order = np.argsort(owners, kind="stable")
    ends = np.searchsorted(owners[order], np.arange(len(originals) + 1))
    return Manifold(
        Mesh64(
            np.array(points),  # a copy: manifold3d's own arrays are read-only, and it takes none such
            np.ascontiguousarray(faces[order], dtype=np.uint64),
            run_index=(3 * ends).astype(np.uint64),
            run_original_id=np.asarray(originals, dtype=np.uint32),
            face_id=None if face_ids is None else face_ids[order],
        )
    )


def has_ids(rules: Mapping[int, str]) -> bool:
    """Whether some of these rules are those of a face id, not of an original."""
    return any(key >= FACE_ID for key in rules)


def given_ids(mesh: Mesh64) -> NDArray[np.uint64]:
    """The face ids (F,) that were given to faces, and NO_ID for the others.

    To a face without a given id manifold3d gives the index of a triangle of its plane.
    """
    return np.maximum(np.array(mesh.face_id, dtype=np.uint64), np.uint64(NO_ID))


def with_points(mesh: Mesh64, points: Floats, ids: bool) -> Manifold:
    """The manifold of a mesh with other coordinates. ids: whether faces were given ids."""
    return Manifold(
        Mesh64(
            np.ascontiguousarray(points),
            np.array(mesh.tri_verts),
            run_index=np.array(mesh.run_index, dtype=np.uint64),
            run_original_id=np.array(mesh.run_original_id, dtype=np.uint32),
            face_id=given_ids(mesh) if ids else None,
        )
    )


def rule_ids(mesh: Mesh, originals: Sequence[int]) -> tuple[dict[int, str], NDArray[np.uint64] | None]:
    """The rules by original, or where one was made by several by the face ids, which then are the second result."""
    if mesh.face_labels is None or mesh.face_rules is None:
        return {}, None
    count = len(mesh.rule_names)
    if count == 1:
        return dict.fromkeys(originals, mesh.rule_names[0]), None
    labels, rules = np.divmod(np.flatnonzero(np.bincount(mesh.face_labels * count + mesh.face_rules)), count)
    if len(set(labels.tolist())) == len(labels):
        return {originals[label]: mesh.rule_names[rule] for label, rule in zip(labels, rules, strict=True)}, None
    first = FACE_ID + Manifold.reserve_ids(count)
    return {first + i: name for i, name in enumerate(mesh.rule_names)}, (first + mesh.face_rules).astype(np.uint64)


def owners_of(mesh: Mesh64) -> Ints:
    """(F,): the run that each face belongs to."""
    return np.repeat(np.arange(len(mesh.run_original_id)), np.diff(mesh.run_index) // 3)


def triangles(manifold: Manifold, labels: Mapping[int, str], rules: Mapping[int, str]) -> Mesh:
    """The triangles of a manifold. labels: by original. rules: by original or by face id."""
    mesh = manifold.to_mesh64()
    originals, owners = np.array(mesh.run_original_id), owners_of(mesh)
    by_label = _named(labels, originals, owners)
    if has_ids(rules):
        ids = given_ids(mesh)
        originals, owners = np.unique(np.where(ids >= FACE_ID, ids, originals[owners]), return_inverse=True)
    by_rule = _named(rules, originals, owners)
    return Mesh(mesh.vert_properties[:, :3], mesh.tri_verts.astype(np.int64), *by_label, *by_rule)


def _named(names: Mapping[int, str], keys: NDArray[Any], owners: Ints) -> tuple[Ints | None, tuple[str, ...]]:
    """For each face the index of ``names[keys[owner]]``, -1 where there is none, and the names that faces have."""
    found = [names.get(key) for key in keys.tolist()]
    used = {name for name, count in zip(found, np.bincount(owners, minlength=len(found)), strict=True) if count}
    kept = tuple(dict.fromkeys(name for name in names.values() if name in used))
    index: dict[str | None, int] = {name: i for i, name in enumerate(kept)}
    return (np.array([index.get(name, -1) for name in found], dtype=np.int64)[owners] if kept else None), kept
