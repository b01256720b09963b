"""Skins in glTF: joints that move the vertices of a mesh to where they stand in the file."""

from __future__ import annotations

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.gltf.accessors import Accessors
from shapewright.references.readers.gltf.document import Document, at
from shapewright.references.readers.gltf.primitives import Geometry
from shapewright.shapes import Floats


def joint_matrices(document: Document, index: int, matrices: Floats, accessors: Accessors) -> Floats:
    """(J, 4, 4), from the frame of a skinned mesh to that of the whole, for each joint of a skin.

    ``matrices`` (N, 4, 4) are those of the nodes. Raises UnreadableError for joints that are not there.
    """
    skin = at(document.skins, index, "skin")
    for joint in skin.joints:
        at(document.nodes, joint, "node")
    joints = matrices[skin.joints]
    if skin.inverse_bind_matrices is None:
        return joints
    inverse = accessors.floats(skin.inverse_bind_matrices, 16)
    if len(inverse) < len(joints):
        raise UnreadableError(f"broken: a skin has {len(joints)} joints, but {len(inverse)} inverse bind matrices")
    columns = inverse[: len(joints)].reshape(-1, 4, 4)
    return np.asarray(joints @ columns.transpose(0, 2, 1))


def posed(shape: Geometry, joints: Floats) -> Floats:
    """The vertices (V, 3) of a skinned geometry where its joints (J, 4, 4) put them.

    Weights that do not add up to 1 are divided by their sum; a vertex without weights follows its first joint. Raises
    UnreadableError for a joint that the skin does not have.
    """
    weights = np.maximum(shape.weights, 0.0)
    weights[weights.sum(axis=1) == 0.0, 0] = 1.0
    weights /= weights.sum(axis=1, keepdims=True)
    moving = weights > 0.0
    if (shape.joints[moving] >= len(joints)).any():
        raise UnreadableError(f"broken: a mesh refers to joint {shape.joints[moving].max()} of {len(joints)}")
    affine = joints[:, :3]
    result = np.zeros_like(shape.vertices)
    for joint, weight in zip(np.where(moving, shape.joints, 0).T, weights.T, strict=True):
        if weight.any():
            turned = np.einsum("vij,vj->vi", affine[joint, :, :3], shape.vertices) + affine[joint, :, 3]
            result += weight[:, None] * turned
    return result
