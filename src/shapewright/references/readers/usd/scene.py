"""A USD file, read into the triangles of the stage that it shows."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.parts import PartName, Parts
from shapewright.references.readers.polygons import Polygons, triangulate
from shapewright.references.readers.scene_parts import Piece, Scene, join, placed, refuse_too_many
from shapewright.references.readers.usd import primitives
from shapewright.references.readers.usd.layers import check_layers, told
from shapewright.shapes import Floats, Ints

_MOST = 200_000
"""Places of shapes. A small file can announce any number, since an instance may stand within many."""
_SHOWN = 100
_DEEPEST = 16
"""Instancers within instancers."""
_SHAPES = ("Mesh", "Cube", "Sphere", "Cylinder", "Cylinder_1", "Cone", "Capsule", "Capsule_1", "Plane")


@dataclass
class _Found:
    """What the walk over a stage has found so far."""

    pieces: list[Piece] = field(default_factory=list)
    names: list[tuple[PartName, int]] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)
    triangles: int = 0


def read_usd(path: Path, _: bytes) -> Scene:
    """The triangles of a USD file or package, in its own unit and axes.

    Meshes and exact shapes stand where the stage shows them at its first time: with the variants that are selected,
    with instances and instancers, and with skins as their joints stand. Guides and proxies, what is invisible, curves,
    points and looks are left out; of a subdivided mesh its cage is read. Layers that it refers to are looked for in its
    own folder. Raises UnreadableError, with the reason, and where usd-core is missing.
    """
    try:
        from pxr import Sdf, Tf, Usd, UsdGeom, UsdSkel
    except ImportError as error:
        raise UnreadableError("USD, which needs usd-core: pip install 'shapewright[usd]'") from error
    with _quiet():
        try:
            stage = Usd.Stage.Open(check_layers(Sdf, path), Usd.Stage.LoadAll)
            time = _first_time(Usd, stage)
            _pose(Usd, UsdSkel, stage, time)
            found = _Found()
            _walk(_Walk(Usd, UsdGeom, time, UsdGeom.XformCache(time)), stage.GetPseudoRoot(), np.eye(4), found, 0)
        except Tf.ErrorException as error:
            raise UnreadableError(f"broken: {told(error)}") from error
        except (
            TypeError,
            UnicodeError,
        ) as error:  # of a value that the library cannot hand over, such as a background that is empty
            raise UnreadableError(f"broken: a value of a wrong type: {str(error)[:_SHOWN]}") from error
        found.left_out["reference that leads nowhere"] += len(stage.GetCompositionErrors())
        unit, up = (_stated(read, stage) for read in (UsdGeom.GetStageMetersPerUnit, UsdGeom.GetStageUpAxis))
    notes = tuple(f"{count} x {what} left out" for what, count in found.left_out.items() if count)
    unit = float(unit) if unit and 0.0 < unit < np.inf else None
    up = str(up).lower() if str(up) in ("X", "Y", "Z") else None
    return Scene(*join(found.pieces), notes, unit, up, Parts.of(found.names))


@contextmanager
def _quiet() -> Iterator[None]:
    """Within it the library prints no warnings."""
    from pxr import UsdUtils

    delegate = UsdUtils.CoalescingDiagnosticDelegate()
    try:
        yield
    finally:
        with suppress(UnicodeError):  # they quote what they find
            delegate.TakeUncoalescedDiagnostics()


def _stated(read: Callable[[Any], Any], stage: Any) -> Any:
    """What a stage states, None where it is of a wrong type."""
    try:
        return read(stage)
    except Exception:  # noqa: BLE001 - of a type of the library's own
        return None


def _first_time(usd: Any, stage: Any) -> Any:
    return usd.TimeCode(stage.GetStartTimeCode()) if stage.HasAuthoredTimeCodeRange() else usd.TimeCode.EarliestTime()


def _pose(usd: Any, skel: Any, stage: Any, time: Any) -> None:
    """Put skinned meshes where their joints stand, in a layer beside the file."""
    from pxr import Gf

    roots = [prim for prim in stage.Traverse() if prim.IsA(skel.Root)]
    if roots:
        stage.SetEditTarget(stage.GetSessionLayer())
        for root in roots:
            skel.BakeSkinning(skel.Root(root), Gf.Interval(time.GetValue(), time.GetValue()))


@dataclass(frozen=True)
class _Walk:
    """What a walk needs: the modules ``Usd`` and ``UsdGeom``, the time, and where prims stand at it."""

    usd: Any
    geom: Any
    time: Any
    places: Any

    def matrix(self, prim: Any) -> Floats:
        """(4, 4), from the frame of a prim to that of the stage."""
        return np.array(self.places.GetLocalToWorldTransform(prim)).T

    def value(self, attribute: Any) -> Any:
        return attribute.Get(self.time)


def _walk(walk: _Walk, root: Any, matrix: Floats, found: _Found, depth: int) -> None:
    """Add what a prim and all below it show; ``matrix`` (4, 4) goes from the frame of the stage to where it is."""
    prims = iter(walk.usd.PrimRange(root, walk.usd.TraverseInstanceProxies()))
    for prim in prims:
        kind = str(prim.GetTypeName())
        if not prim.IsA(walk.geom.Imageable):
            continue
        seen = walk.geom.Imageable(prim)
        if prim.IsA(walk.geom.Boundable) and kind:
            if seen.ComputePurpose() in (walk.geom.Tokens.guide, walk.geom.Tokens.proxy):
                found.left_out[f"{seen.ComputePurpose()} shape"] += 1
            elif seen.ComputeVisibility(walk.time) == walk.geom.Tokens.invisible:
                found.left_out["shape that is invisible"] += 1
            elif kind == "PointInstancer":
                _instances(walk, prim, matrix, found, depth)
            elif kind in _SHAPES:
                vertices, faces = _shape(walk, prim, kind, found)
                found.triangles += len(faces)
                refuse_too_many(found.triangles)
                found.pieces.append(placed(vertices, faces, matrix @ walk.matrix(prim)))
                found.names.append((_name(prim), len(faces)))
            elif prim.IsA(walk.geom.Gprim):
                found.left_out[kind] += 1
        if kind == "PointInstancer":
            prims.PruneChildren()


def _instances(walk: _Walk, prim: Any, matrix: Floats, found: _Found, depth: int) -> None:
    """Add what an instancer shows: each of its prototypes at each place."""
    if depth > _DEEPEST:
        raise UnreadableError("broken: instancers within themselves")
    instancer = walk.geom.PointInstancer(prim)
    indices = np.array(walk.value(instancer.GetProtoIndicesAttr()) or [], dtype=np.int64)
    targets = instancer.GetPrototypesRel().GetForwardedTargets()
    matrices = instancer.ComputeInstanceTransformsAtTime(
        walk.time, walk.time, applyMask=walk.geom.PointInstancer.IgnoreMask
    )
    mask = list(instancer.ComputeMaskAtTime(walk.time))
    if len(matrices) != len(indices):
        raise UnreadableError(f"broken: an instancer of {len(indices)} indices and {len(matrices)} places")
    if len(indices) and not 0 <= indices.min() <= indices.max() < len(targets):
        raise UnreadableError(f"broken: an instancer refers to prototype {indices.max()} of {len(targets)}")
    where = matrix @ walk.matrix(prim)
    stood = np.array(matrices).reshape(-1, 4, 4).transpose(0, 2, 1)
    for number, target in enumerate(targets):
        prototype = prim.GetStage().GetPrimAtPath(target)
        chosen = [i for i in np.flatnonzero(indices == number) if not mask or mask[i]]
        if not prototype or not chosen:
            continue
        inner = _Found()
        _walk(walk, prototype, np.linalg.pinv(walk.matrix(prototype)).astype(np.float64), inner, depth + 1)
        found.left_out.update(inner.left_out)
        found.triangles += inner.triangles * len(chosen)
        refuse_too_many(found.triangles)
        if len(found.pieces) + len(inner.pieces) * len(chosen) > _MOST:
            raise UnreadableError(f"its shapes stand in more than {_MOST:,} places")
        for place in stood[chosen]:
            found.pieces += [placed(*piece, where @ place) for piece in inner.pieces]
            found.names += inner.names


def _shape(walk: _Walk, prim: Any, kind: str, found: _Found) -> Piece:
    """The triangles of a shape in its own frame."""
    if kind == "Mesh":
        return _mesh(walk, walk.geom.Mesh(prim), found)

    def number(name: str) -> float:
        return float(walk.value(prim.GetAttribute(name)))

    if kind == "Cube":
        return primitives.cuboid(np.full(3, number("size")))
    if kind == "Sphere":
        return primitives.sphere(number("radius"))
    axis = str(walk.value(prim.GetAttribute("axis")))
    if kind == "Plane":
        return primitives.along(axis, primitives.plane(np.array([number("width"), number("length")])))
    height = number("height")
    two = kind.endswith("_1")
    bottom, top = (number(f"radius{end}" if two else "radius") for end in ("Bottom", "Top"))
    round_: Callable[[float, float, float], Piece] = (
        primitives.capsule if kind.startswith("Capsule") else primitives.frustum
    )
    return primitives.along(axis, round_(bottom, 0.0 if kind == "Cone" else top, height))


def _mesh(walk: _Walk, mesh: Any, found: _Found) -> Piece:
    points = np.array(walk.value(mesh.GetPointsAttr()) or [], dtype=np.float64).reshape(-1, 3)
    counts, corners = (
        _whole(walk.value(mesh.GetFaceVertexCountsAttr())),
        _whole(walk.value(mesh.GetFaceVertexIndicesAttr())),
    )
    if (counts < 0).any() or counts.sum() != len(corners):
        raise UnreadableError(f"broken: a mesh of {counts.sum()} corners has {len(corners)}")
    holes = _whole(walk.value(mesh.GetHoleIndicesAttr()))
    open_ = np.isin(np.arange(len(counts)), holes)
    scheme = mesh.GetSubdivisionSchemeAttr()
    if scheme.HasAuthoredValue() and walk.value(scheme) != walk.geom.Tokens.none and len(counts):
        found.left_out["subdivision of a mesh"] += 1
    faces = triangulate(Polygons(points, corners[np.repeat(~open_, counts)], counts[~open_]))
    left_handed = walk.value(mesh.GetOrientationAttr()) == walk.geom.Tokens.leftHanded
    return points, faces[:, ::-1] if left_handed else faces


def _whole(values: Any) -> Ints:
    return np.array(values if values is not None else [], dtype=np.int64)


def _name(prim: Any) -> PartName:
    from pxr import UsdShade

    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
    return PartName.of(str(prim.GetName()), str(material.GetPrim().GetName()) if material else None)
