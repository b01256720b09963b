"""One file of a collection, read into the triangles, points or drawing that it holds, in its own units and axes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.other_kinds import refusal
from shapewright.references.parts import Parts
from shapewright.references.readers.cad.dxf import read_dxf
from shapewright.references.readers.cad.step import read_iges, read_step
from shapewright.references.readers.clouds.cloud import Cloud, usable
from shapewright.references.readers.clouds.columns import read_pts, read_xyz
from shapewright.references.readers.clouds.e57 import read_e57
from shapewright.references.readers.clouds.gaussians import read_splat
from shapewright.references.readers.clouds.las import read_las
from shapewright.references.readers.clouds.pcd import read_pcd
from shapewright.references.readers.collada.scene import read_collada
from shapewright.references.readers.contents import Contents, held
from shapewright.references.readers.fbx.scene import read_fbx
from shapewright.references.readers.gltf.scene import read_gltf
from shapewright.references.readers.obj import read_obj
from shapewright.references.readers.off import read_off
from shapewright.references.readers.pictures import KINDS as PICTURES
from shapewright.references.readers.pictures import read_picture
from shapewright.references.readers.ply import read_ply
from shapewright.references.readers.polygons import Polygons, check_indices, triangulate
from shapewright.references.readers.scene_parts import Scene
from shapewright.references.readers.stl import read_stl
from shapewright.references.readers.svg import read_svg
from shapewright.references.readers.threemf.build import read_3mf
from shapewright.references.readers.usd.scene import read_usd
from shapewright.shapes import Drawing, Floats, Ints, Mesh, ReferenceShape, Views

_POLYGONS: dict[str, Callable[[bytes], Polygons | Cloud]] = {
    ".obj": read_obj,
    ".off": read_off,
    ".ply": read_ply,
    ".stl": read_stl,
}
_SCENES: dict[str, Callable[[Path, bytes], Scene]] = {
    ".glb": read_gltf,
    ".gltf": read_gltf,
    ".3mf": read_3mf,
    ".dae": read_collada,
    ".zae": read_collada,
    ".fbx": read_fbx,
    **dict.fromkeys((".step", ".stp"), read_step),
    **dict.fromkeys((".iges", ".igs"), read_iges),
    **dict.fromkeys((".usd", ".usda", ".usdc", ".usdz"), read_usd),
}
_CLOUDS: dict[str, Callable[[bytes], Cloud]] = {
    ".xyz": read_xyz,
    ".xyzn": read_xyz,
    ".xyzrgb": read_xyz,
    ".pts": read_pts,
    ".pcd": read_pcd,
    ".splat": read_splat,
}
_CLOUD_FILES: dict[str, Callable[[Path, bytes], Cloud]] = {".las": read_las, ".laz": read_las, ".e57": read_e57}
_Drawn = tuple[Drawing, tuple[str, ...]] | tuple[Drawing, tuple[str, ...], float | None]
"""A drawing, notes, and a unit in metres where the format has one."""
_DRAWINGS: dict[str, Callable[[bytes], _Drawn]] = {
    ".dxf": read_dxf,
    ".svg": read_svg,
    ".svgz": read_svg,
    **dict.fromkeys(PICTURES, read_picture),
}
MESH_FORMATS = ("OBJ", "PLY", "STL", "OFF", "GLB", "glTF", "3MF", "DAE", "FBX", "USD", "STEP", "IGES")
"""Formats of meshes that are read, as people write them."""
MESHES = (*_POLYGONS, *_SCENES)
CLOUDS = (*_CLOUDS, *_CLOUD_FILES)
"""Extensions of files that hold points alone; PLY, OBJ and OFF without faces do as well."""
EXTENSIONS = tuple(sorted((*MESHES, *CLOUDS, *_DRAWINGS)))

_FETCH = "where git-annex or DVC keeps the files, fetch them with `git annex get` or `dvc pull`"
_LEAST_AREA = 1e-12
"""Share of the squared extent: a shape whose triangles all cover less shows in no picture."""
_LARGEST = 1e307  # sums of coordinates have to stay below the largest number, 1.8e308
_AT_ONCE = 100_000
"""Triangles whose areas are held in memory at once, 30 MB of them."""


def read(path: Path) -> tuple[ReferenceShape, tuple[str, ...]]:
    """The shape of ``contents`` and its notes; raises UnreadableError as it does."""
    found = contents(path)
    return found.shape, found.notes


def contents(path: Path, view: bool = False, mask: Path | None = None) -> Contents:
    """The triangles of a file in one mesh, its points or its drawing; with notes on what was left out, its unit and up.

    view: whether a picture is read as one of an object, a drawing as its silhouette. mask: see ``read_view``.

    Polygons are triangulated and scenes flattened. Names of parts and materials become labels; textures are ignored.
    Triangles stay unchanged, inward, doubled or flat. The reader leaves out vertices that no triangle uses and, with a
    note, triangles with a corner that is not finite. Raises UnreadableError, with the reason, where nothing remains
    that could be seen.
    """
    kind = path.suffix.lower()
    if kind not in EXTENSIONS:
        raise UnreadableError(refusal(path) or f"not a kind of file that is read ({' '.join(EXTENSIONS)})")
    try:
        data = path.read_bytes()
    except OSError as error:
        if path.is_symlink() and not path.exists():
            raise UnreadableError(f"a link to a file that is not there; {_FETCH}") from error
        raise UnreadableError(str(error.strerror).lower()) from error
    if not data:
        raise UnreadableError("the file is empty")
    if data.startswith(b"version https://git-lfs"):
        raise UnreadableError("a pointer of Git LFS, not the file itself; fetch it with `git lfs pull`")
    if data.startswith(b"/annex/objects/"):
        raise UnreadableError(f"a pointer of git-annex, not the file itself; {_FETCH}")
    try:
        if view and kind in _DRAWINGS:
            return _view(kind, data, mask)
        if kind in _DRAWINGS:
            return Contents(*_DRAWINGS[kind](data))
        if kind in _CLOUDS or kind in _CLOUD_FILES:
            return _points(_CLOUDS[kind](data) if kind in _CLOUDS else _CLOUD_FILES[kind](path, data))
        if kind in _POLYGONS:
            polygons = _polygons(kind, data)
            data = b""  # large text need not be held any longer
            if isinstance(polygons, Cloud):
                return _points(polygons)
            vertices, notes = polygons.vertices, (*polygons.notes, *_few(polygons))
            scene = Scene(vertices, triangulate(polygons), notes, parts=polygons.parts_of_triangles)
        else:
            scene = _SCENES[kind](path, data)
    except (UnreadableError, MemoryError):
        raise
    except Exception as error:  # a broken file can make a parser fail in any way
        raise UnreadableError(f"broken: {type(error).__name__}: {error}") from error
    try:
        mesh, lost = sound(scene.vertices, scene.faces, scene.parts)
    except UnreadableError as error:
        raise UnreadableError("; ".join([str(error), *scene.notes])) from error
    return Contents(mesh, (*scene.notes, *lost), scene.unit, scene.up)


def _view(kind: str, data: bytes, mask: Path | None) -> Contents:
    from shapewright.references.readers.views.reader import read_view, view_of  # numba loads slowly

    if kind in PICTURES:
        seen, notes = read_view(data, mask.read_bytes() if mask else None)
    else:
        drawing, notes = _DRAWINGS[kind](data)[:2]
        seen = view_of(drawing)
    return Contents(Views((seen,)), notes)


def _points(cloud: Cloud) -> Contents:
    points, notes = usable(cloud)
    return Contents(points, notes, cloud.unit, cloud.up)


def _polygons(kind: str, data: bytes) -> Polygons | Cloud:
    """The polygons or points of a file. Raises UnreadableError, which says what the file holds in place of polygons."""
    try:
        polygons = _POLYGONS[kind](data)
        if isinstance(polygons, Cloud) or len(polygons.counts):
            return polygons
        why = "it has no polygons"
    except UnreadableError as error:
        polygons, why = None, str(error)
    inside = held(data)
    if inside in ("text", "unknown data") or inside.split()[-1].lower() == kind[1:]:
        if polygons is None:
            raise UnreadableError(why)
        return polygons
    raise UnreadableError(f"{why}; it holds {inside}")


def _few(polygons: Polygons) -> tuple[str, ...]:
    few = int(np.count_nonzero(polygons.counts < 3))
    return (f"{few} of {len(polygons.counts)} polygons left out: fewer than three corners",) if few else ()


def sound(vertices: Floats, faces: Ints, parts: Parts | None = None) -> tuple[Mesh, tuple[str, ...]]:
    """Triangles that can be seen and measured, with the notes of ``read``; raises UnreadableError as it does.

    parts: those of the faces, which become labels.
    """
    if not len(faces):
        raise UnreadableError("no triangles, only points or lines" if len(vertices) else "it holds no triangles")
    check_indices(faces, len(vertices))
    everywhere = bool(np.isfinite(vertices).all())
    ends = np.ones(len(vertices), dtype=bool) if everywhere else np.asarray(np.isfinite(vertices).all(axis=1))
    finite = np.ones(len(faces), dtype=bool) if everywhere else ends[faces].all(axis=1)
    if not finite.any():
        raise UnreadableError("no triangle has finite corners: all use NaN or infinity")
    used = np.zeros(len(vertices), dtype=bool)
    used[faces if everywhere else faces[finite]] = True
    whole = bool(used.all() and finite.all())
    mesh = Mesh(vertices, faces) if whole else Mesh(vertices[used], (np.cumsum(used) - 1)[faces[finite]])
    bounds = mesh.bounds
    size = float((bounds[1] - bounds[0]).max()) if np.abs(bounds).max() < _LARGEST else np.inf
    if not np.finfo(np.float64).tiny < size < np.inf:
        raise UnreadableError("all its triangles lie at one point" if size < 1.0 else "too large to measure")
    if not any(_seen(mesh, size, start) for start in range(0, len(mesh.faces), _AT_ONCE)):
        raise UnreadableError("its triangles have no area: all are lines or points")
    lost = len(faces) - len(mesh.faces)
    mesh = parts.labelled(mesh, np.flatnonzero(finite)) if parts else mesh
    return mesh, (f"{lost} of {len(faces)} triangles left out: a corner is not finite",) if lost else ()


def _seen(mesh: Mesh, size: float, start: int) -> bool:
    """Whether one of the triangles from ``start`` on has an area that shows, in a mesh of this size."""
    edges = np.diff(mesh.vertices[mesh.faces[start : start + _AT_ONCE]], axis=1) / size
    return bool(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).max() >= _LEAST_AREA)
