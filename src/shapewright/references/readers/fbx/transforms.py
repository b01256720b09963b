"""Where the models of an FBX scene stand: pivots, orders of rotation, and the ways to inherit a scale."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.fbx.document import Document, Key, Object
from shapewright.shapes import Floats

_ORDERS = ("xyz", "xzy", "yzx", "yxz", "zxy", "zyx", "xyz")
"""Which axis is turned about first, second and last, by the number of the order. The last one, spheric, is as XYZ."""
_ZERO, _ONE = (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)
_BY_PARTS, _WITHOUT_SCALE = 0, 2
"""Ways to inherit: the scale of the parent is multiplied axis by axis, or is not inherited. 1 multiplies matrices."""


@dataclass(frozen=True, eq=False)
class Place:
    """Where a model stands.

    Attributes:
        matrix: (4, 4), from its frame to that of the whole.
        unscaled: the same without its own scale.
        scale: (3,), what a child that multiplies scales axis by axis takes on.
        taken_on: (3,), the scale that a child takes on that ignores the one of this model.
    """

    matrix: Floats
    unscaled: Floats
    scale: Floats
    taken_on: Floats


ROOT = Place(np.eye(4), np.eye(4), np.ones(3), np.ones(3))


def places(document: Document) -> Mapping[Key, Place]:
    """Where each model stands. Raises UnreadableError for models that are below themselves.

    A model that is connected to no other stands in the scene. Of several parents the first counts.
    """
    models = {key: each for key, each in document.objects.items() if each.kind == "Model"}
    parent = {key: next((p for p in document.parents.get(key, ()) if p in models), None) for key in models}
    found: dict[Key, Place] = {}
    for key in models:
        line, each = list[Key](), key
        while each not in found:
            line.append(each)
            if len(line) > len(models):
                raise UnreadableError("broken: a cycle, models stand below themselves")
            above = parent[each]
            if above is None:
                break
            each = above
        for each in reversed(line):
            above = parent[each]
            found[each] = _below(ROOT if above is None else found[above], models[each])
    return found


def geometric(model: Object) -> Floats:
    """(4, 4), from the frame of the geometry of a model to that of the model."""
    turn = rotation(model.vector("GeometricRotation", _ZERO))
    return _affine(turn * model.vector("GeometricScaling", _ONE), model.vector("GeometricTranslation", _ZERO))


def rotation(degrees: Floats, order: int = 0) -> Floats:
    """(3, 3), by angles about the three axes, one after the other in the order of this number."""
    result = np.eye(3)
    for axis in _ORDERS[order] if 0 <= order < len(_ORDERS) else _ORDERS[0]:
        i = "xyz".index(axis)
        angle = np.radians(degrees[i])
        j, k = (i + 1) % 3, (i + 2) % 3
        turn = np.eye(3)
        turn[j, j] = turn[k, k] = np.cos(angle)
        turn[k, j], turn[j, k] = np.sin(angle), -np.sin(angle)
        result = turn @ result
    return result


def _below(parent: Place, model: Object) -> Place:
    turn, scale, shift = _local(model)
    way = int(model.number("InheritType", 1.0))
    if way not in (_BY_PARTS, _WITHOUT_SCALE):
        unscaled = parent.matrix @ _affine(turn, shift)
        return Place(parent.matrix @ _affine(turn * scale, shift), unscaled, scale, np.ones(3))
    taken_on = parent.scale if way == _BY_PARTS else parent.taken_on
    scale, shift = scale * taken_on, shift * parent.scale
    unscaled = parent.unscaled @ _affine(turn, shift)
    return Place(parent.unscaled @ _affine(turn * scale, shift), unscaled, scale, taken_on)


def _local(model: Object) -> tuple[Floats, Floats, Floats]:
    """The rotation (3, 3), the scale (3,) and then the translation (3,) of a model in the frame of its parent.

    The order is that of the FBX SDK: T Roff Rp Rpre R Rpost' Rp' Soff Sp S Sp', where ' is the inverse.
    """
    turn = rotation(model.vector("Lcl Rotation", _ZERO))
    if model.number("RotationActive", 1.0) and not model.number("RotationSpaceForLimitOnly", 0.0):
        turn = rotation(model.vector("Lcl Rotation", _ZERO), int(model.number("RotationOrder", 0.0)))
        before, behind = (rotation(model.vector(name, _ZERO)) for name in ("PreRotation", "PostRotation"))
        turn = before @ turn @ behind.T
    scale = model.vector("Lcl Scaling", _ONE)
    pivot, scaled_about = model.vector("RotationPivot", _ZERO), model.vector("ScalingPivot", _ZERO)
    inner = scaled_about - scale * scaled_about + model.vector("ScalingOffset", _ZERO) - pivot
    shift = turn @ inner + pivot + model.vector("RotationOffset", _ZERO) + model.vector("Lcl Translation", _ZERO)
    return turn, scale, shift


def _affine(linear: Floats, shift: Floats) -> Floats:
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = linear, shift
    return result
