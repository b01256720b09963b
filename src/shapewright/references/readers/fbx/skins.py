"""Skins of FBX: bones that move the vertices of a mesh to where they stand in the file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.document import Document, Key, Object
from shapewright.references.readers.fbx.geometry import Geometry
from shapewright.references.readers.fbx.transforms import ROOT, Place
from shapewright.references.readers.polygons import check_indices
from shapewright.shapes import Floats


def posed(document: Document, shape: Geometry, places: Mapping[Key, Place], own: Floats, inner: Floats) -> Floats:
    """The vertices (V, 3) of a mesh in the frame of the whole.

    Bones put them there, where it has a skin; ``own`` (4, 4) does where it has none, and where no bone moves a vertex.
    ``inner`` (4, 4) goes from the frame of the geometry to that of its model.
    """
    result = shape.vertices @ own[:3, :3].T + own[:3, 3]
    moved, total = np.zeros_like(result), np.zeros(len(result))
    for skin in document.below(shape.key.key, "Deformer", "Skin"):
        for cluster in document.below(skin.key, "Deformer", "Cluster"):
            bone = next((places[each.key] for each in document.below(cluster.key, "Model")), None)
            if bone is None and cluster.key in document.of_root:
                bone = ROOT
            indices, weights = cluster.node.integers("Indexes"), cluster.node.floats("Weights")
            if bone is None or not len(indices):
                continue
            if len(indices) != len(weights):
                raise UnreadableError(f"broken: a cluster of {len(indices)} vertices and {len(weights)} weights")
            check_indices(indices, len(result))
            matrix = bone.matrix @ _matrix(cluster, "Transform") @ inner
            points = shape.vertices[indices] @ matrix[:3, :3].T + matrix[:3, 3]
            np.add.at(moved, indices, weights[:, None] * points)
            np.add.at(total, indices, weights)
    held = total > 0.0
    result[held] = moved[held] / total[held, None]
    return result


def is_by_dual_quaternions(document: Document, shape: Object) -> bool:
    """Whether the file wants a skin to be moved in a way that keeps its volume, which ``posed`` does not."""
    skins = document.below(shape.key, "Deformer", "Skin")
    kinds = [kind for skin in skins if (kind := skin.node.child("SkinningType")) is not None]
    return any(kind.text(0) in ("DualQuaternion", "Blend") for kind in kinds)


def _matrix(cluster: Object, name: str) -> Floats:
    """A matrix (4, 4), which the file stores column by column."""
    values = cluster.node.floats(name)
    if len(values) != 16:
        raise UnreadableError(f"broken: the matrix {name} of a cluster has {len(values)} numbers")
    return values.reshape(4, 4).T
