"""An FBX file, read into the triangles of the scene that it shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import numpy as np

from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.fbx.document import Document, Key, Object, parse
from shapewright.references.readers.fbx.geometry import Geometry, is_mesh, read_geometry
from shapewright.references.readers.fbx.skins import is_by_dual_quaternions, posed
from shapewright.references.readers.fbx.transforms import geometric, places
from shapewright.references.readers.scene_parts import Piece, Scene, join, placed, refuse_too_many
from shapewright.shapes import Floats

_CENTIMETRE = 1e-2
_AXES = ("UpAxis", "FrontAxis", "CoordAxis")
_USUAL = {"UpAxis": 1.0, "FrontAxis": 2.0, "CoordAxis": 0.0}
"""Which axis points up, to the front and to the right where a file does not tell."""
_LEFT_OUT = ("Line", "NurbsSurface", "NurbsCurve", "Nurbs", "Nurb", "TrimNurbsSurface", "Patch", "Boundary")


def read_fbx(path: Path, data: bytes) -> Scene:
    """The triangles of an FBX file's bytes, in its own unit and axes.

    Meshes stand where the models of the scene show them, skins where their bones put them, blend shapes at the weights
    of the file. Curves and patches, materials, lights, cameras and motion are left out. Raises UnreadableError, with
    the reason.
    """
    del path  # it may refer to textures and caches beside it, which are not looked at
    document = parse(data)
    stand = places(document)
    shown = list(_shown(document))
    hidden, lower = _hidden(document), _lower_levels(document)
    left_out: Counter[str] = Counter()

    @cache
    def geometry(key: Key) -> Geometry:
        return read_geometry(document, document.objects[key])

    @cache
    def first(key: Key) -> tuple[Floats, Floats]:
        """A geometry as its first model shows it, and where that would put it without a skin."""
        model = next(model for model, shape in shown if shape.key == key)
        inner = geometric(model)
        own = stand[model.key].matrix @ inner
        return posed(document, geometry(key), stand, own, inner), own

    pieces, names, triangles = list[Piece](), list[tuple[PartName, int]](), 0
    for model, shape in shown:
        if model.key in hidden or model.key in lower:
            left_out["mesh that is hidden" if model.key in hidden else "lower level of detail"] += 1
        elif is_mesh(shape):
            faces = geometry(shape.key).faces
            triangles += len(faces)
            refuse_too_many(triangles)
            left_out["dual quaternion of skins"] += is_by_dual_quaternions(document, shape)
            vertices, at_first = first(shape.key)
            own = stand[model.key].matrix @ geometric(model)
            if not np.array_equal(own, at_first):
                vertices = placed(vertices, faces, own @ np.linalg.pinv(at_first))[0]
            pieces.append((vertices, placed(vertices[:0], faces, own)[1]))
            names += _names(document, model, geometry(shape.key))
        elif shape.form in _LEFT_OUT:
            left_out[f"{shape.form} without polygons"] += 1
    notes = tuple(f"{count} x {what} left out" for what, count in left_out.items() if count)
    vertices, faces = join(pieces)
    axes = _axes(document.settings)
    if np.linalg.det(axes) < 0.0:  # left-handed: the front axis is turned over
        mirror = np.eye(4)
        mirror[:3, :3] -= 2.0 * np.outer(axes[1], axes[1])
        vertices, faces = placed(vertices, faces, mirror)
    unit = document.settings.number("UnitScaleFactor", 1.0) * _CENTIMETRE
    return Scene(vertices, faces, notes, unit if 0.0 < unit < np.inf else None, _named(axes[0]), Parts.of(names))


def _shown(document: Document) -> Iterator[tuple[Object, Object]]:
    """Models with the geometries that they show. Before version 7 a model holds its geometry."""
    for model in document.objects.values():
        if model.kind == "Model":
            if model.node.child("Vertices") is not None or model.form in _LEFT_OUT:
                yield model, model
            yield from ((model, shape) for shape in document.below(model.key, "Geometry") if shape.form != "Shape")


def _names(document: Document, model: Object, shape: Geometry) -> Iterator[tuple[PartName, int]]:
    """The name of a model with that of a material, for each stretch of faces that has both."""
    materials = [each.name for each in document.below(model.key, "Material")]
    starts = np.flatnonzero(np.diff(shape.materials, prepend=-1))
    for start, count in zip(starts, np.diff([*starts, len(shape.materials)]), strict=True):
        number = int(shape.materials[start])
        yield PartName.of(model.name, materials[number] if 0 <= number < len(materials) else ""), int(count)


def _hidden(document: Document) -> set[Key]:
    """The models that are not visible, themselves or by one above; also those of a layer that is not shown."""
    layers = [each for each in document.objects.values() if each.kind in ("CollectionExclusive", "DisplayLayer")]
    unseen = {
        model.key for layer in layers if not layer.number("Show", 1.0) for model in document.sources.get(layer.key, ())
    }
    models = [each for each in document.objects.values() if each.kind == "Model"]
    unseen |= {model.key for model in models if not model.number("Visibility", 1.0)}
    heirs = {model.key for model in models if model.number("Visibility Inheritance", 1.0)}
    return _with_all_below(document, unseen, heirs)


def _lower_levels(document: Document) -> set[Key]:
    """The models that groups of levels of detail show from afar: all but the first of each group."""
    groups = [each for each in document.objects.values() if each.kind == "Model" and each.form == "LodGroup"]
    lower = {level.key for group in groups for level in document.below(group.key, "Model")[1:]}
    return _with_all_below(document, lower, None)


def _with_all_below(document: Document, top: set[Key], heirs: set[Key] | None) -> set[Key]:
    found, waiting = set(top), list(top)
    while waiting:
        for model in document.below(waiting.pop(), "Model"):
            if model.key not in found and (heirs is None or model.key in heirs):
                found.add(model.key)
                waiting.append(model.key)
    return found


def _axes(settings: Object) -> Floats:
    """(3, 3): the axes that point up, to the front and to the right."""
    axes = [settings.number(name, _USUAL[name]) for name in _AXES]
    signs = [settings.number(f"{name}Sign", 1.0) for name in _AXES]
    if sorted(axes) != [0.0, 1.0, 2.0] or not all(signs):
        return np.eye(3)[[1, 2, 0]]
    return np.eye(3)[np.array(axes, dtype=np.int64)] * np.sign(signs)[:, None]


def _named(axis: Floats) -> str:
    i = int(np.abs(axis).argmax())
    return ("-" if axis[i] < 0.0 else "") + "xyz"[i]
