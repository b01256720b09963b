"""Public scenes, read by pycollada and ufbx as second readers, and what may explain a difference."""

import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read

SAME = 1e-4
"""Share of the size by which bounds may differ, and of the area."""
_UFBX = """
import json, os, sys
import numpy as np, ufbx
matrix = lambda m: np.array([[*m.c0], [*m.c1], [*m.c2], [*m.c3]]).T
found, area, points = 0, 0.0, [np.empty((0, 3))]
for node in ufbx.load_file(sys.argv[1], evaluate_skinning=True).nodes:
    mesh = node.mesh
    if not mesh or not node.visible:
        continue
    position = mesh.skinned_position
    values = np.array([tuple(value) for value in position.values], dtype=float).reshape(-1, 3)
    corners = np.array(list(position.indices), dtype=int)
    if mesh.skinned_is_local:
        world = matrix(node.geometry_to_world)
        values = values @ world[:, :3].T + world[:, 3]
    holes = list(mesh.face_hole)
    for i, face in enumerate(mesh.faces):
        if face.num_indices > 2 and not (holes and holes[i]):
            loop = values[corners[face.index_begin : face.index_begin + face.num_indices]]
            found += len(loop) - 2
            points.append(loop)
            area += float(np.linalg.norm(np.cross(loop[1:-1] - loop[0], loop[2:] - loop[0]).sum(axis=0))) / 2
points = np.concatenate(points)
bounds = [points.min(axis=0).tolist(), points.max(axis=0).tolist()] if found else None
print(json.dumps([found, bounds, area]), flush=True)
os._exit(0)
"""
"""ufbx 0.0.5 crashes on some files, and where its objects are freed, so it runs in a process of its own."""

_EXPLAINED = {
    ".dae": r"announces \d+ values",
    ".fbx": r"of version|damaged|cut short|no number|not understood|tells them apart|matrix Transform|level",
}
"""Reasons of ours for files that the second reader reads all the same."""
_NOTED = r"lower level of detail|that is hidden|dual quaternion"
"""Notes of ours on what ufbx does in another way: it shows all levels of detail, and layers that are hidden."""


def ours(path: Path):
    """How many triangles, their bounds (2, 3), their area, and the notes; or the reason."""
    try:
        mesh, notes = read(path)
    except UnreadableError as error:
        return str(error)
    corners = mesh.triangles
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return len(corners), mesh.bounds, float(np.linalg.norm(normals, axis=1).sum()) / 2, notes


def theirs(path: Path):
    """The same by the second reader, without notes; None where it fails or finds nothing."""
    return _of_ufbx(path) if path.suffix.lower() == ".fbx" else _of_pycollada(path)


def _of_ufbx(path: Path):
    done = subprocess.run([sys.executable, "-c", _UFBX, os.fspath(path)], capture_output=True, text=True, timeout=60)
    try:
        count, bounds, area = json.loads(done.stdout)
    except ValueError:
        return None
    return (count, np.array(bounds), area) if count else None


def _of_pycollada(path: Path):
    import collada

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            scene = collada.Collada(os.fspath(path), ignore=[collada.DaeError]).scene
            bound = [*scene.objects("geometry"), *(skin.geometry for skin in scene.objects("controller"))]
            primitives = [primitive for each in bound for primitive in each.primitives()]
    except Exception:  # noqa: BLE001 - whatever it raises, there is nothing to compare
        return None
    found = [np.empty((0, 3, 3))]
    for primitive in primitives:
        flat = primitive.triangleset() if hasattr(primitive, "triangleset") else primitive
        if type(flat).__name__ == "BoundTriangleSet" and len(flat):
            found.append(np.asarray(flat.vertex)[np.asarray(flat.vertex_index)])
    corners = np.concatenate(found)
    if not len(corners):
        return None
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    points = corners.reshape(-1, 3)
    bounds = np.stack([points.min(axis=0), points.max(axis=0)])
    return len(corners), bounds, float(np.linalg.norm(normals, axis=1).sum()) / 2


def unexplained(path: Path) -> str | None:
    """In what both readers differ without a known reason; None where they agree or one finds nothing."""
    other = theirs(path)
    if other is None:
        return None
    mine, kind = ours(path), {".zae": ".dae"}.get(path.suffix.lower(), path.suffix.lower())
    if isinstance(mine, str):
        return None if re.search(_EXPLAINED[kind], mine) else f"refused: {mine}"
    if any(re.search(_NOTED, note) for note in mine[3]) or (kind == ".dae" and _has_skins(path)):
        return None
    size = float(np.ptp(np.concatenate([mine[1], other[1]]), axis=0).max())
    told = []
    if mine[0] != other[0]:
        told.append(f"triangles {mine[0]} / {other[0]}")
    if not np.allclose(mine[1], other[1], rtol=0, atol=SAME * size):
        told.append(f"bounds {mine[1].tolist()} / {other[1].tolist()}")
    fans = kind == ".dae" and b"<poly" in path.read_bytes()  # as which pycollada cuts concave polygons too
    if mine[2] < other[2] * (1 - SAME) and not fans:  # triangles of a warped polygon have more area than its normal
        told.append(f"area {mine[2]} / {other[2]}")
    return "; ".join(told) or None


def _has_skins(path: Path) -> bool:
    """pycollada moves skins by the node that shows them, which the specification does not."""
    return path.suffix.lower() == ".zae" or b"<skin" in path.read_bytes()
