"""Public models, read by our readers and by trimesh as the second one, and what may explain a difference."""

import json
import logging
import re
import warnings
import zipfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.container import unpack

SAME = 1e-4
"""Share of the size, area and volume by which both may differ: the readers round to floats at different places."""


@dataclass(frozen=True)
class Measures:
    """What a reader finds in a file."""

    faces: int
    bounds: np.ndarray
    area: float
    volume: float

    @classmethod
    def of(cls, corners: np.ndarray) -> "Measures":
        """Of triangles (F, 3, 3)."""
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        points = corners.reshape(-1, 3)
        volume = float(np.einsum("fi,fi->", corners[:, 0] - points.mean(axis=0), normals)) / 6
        bounds = np.stack([points.min(axis=0), points.max(axis=0)])
        return cls(len(corners), bounds, float(np.linalg.norm(normals, axis=1).sum()) / 2, volume)


def ours(path: Path) -> Measures | str:
    """The measures, or the reason."""
    try:
        mesh, _ = read(path)
    except UnreadableError as error:
        return str(error)
    return Measures.of(mesh.triangles)


def theirs(path: Path) -> Measures | str:
    """The same by trimesh."""
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            corners = _scene(path)
            finite = np.isfinite(corners).all(axis=(1, 2))
            return Measures.of(corners[finite]) if finite.any() else "no triangles"
    except Exception as error:  # noqa: BLE001 - whatever it raises is its answer
        return f"{type(error).__name__}: {error}"
    finally:
        logging.disable(logging.NOTSET)


def _scene(path: Path) -> np.ndarray:
    scene = trimesh.load_scene(str(path), process=False, skip_materials=True)
    found = [np.empty((0, 3, 3))]
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        shape = scene.geometry[name]
        if isinstance(shape, trimesh.Trimesh):
            corners = np.asarray(shape.vertices)[np.asarray(shape.faces)] @ matrix[:3, :3].T + matrix[:3, 3]
            found.append(corners[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else corners)
    return np.concatenate(found)


def difference(mine: Measures | str, other: Measures | str) -> str | None:
    """In what both differ, None where they agree or where there is nothing to compare."""
    if isinstance(other, str):
        return None
    if isinstance(mine, str):
        return f"refused: {mine}"
    size = float(np.ptp(np.concatenate([mine.bounds, other.bounds]), axis=0).max())
    unlike = {
        "faces": mine.faces != other.faces,
        "bounds": not np.allclose(mine.bounds, other.bounds, rtol=0, atol=SAME * size),
        "area": abs(mine.area - other.area) > SAME * max(mine.area, other.area),
        "volume": abs(mine.volume - other.volume) > SAME * max(size**3, abs(mine.volume)),
    }
    told = [f"{word} {getattr(mine, word)} / {getattr(other, word)}" for word, differs in unlike.items() if differs]
    return "; ".join(told) or None


_REFUSALS = {
    ".gltf": r"needs the extension|of version|no data for its|no triangle has finite corners",
    ".3mf": r"needs the extension|slice extension|document type definition|of /3d/\S+, which is not there",
}
"""Reasons of ours for files that trimesh reads all the same: it looks neither at what a file requires nor at whether
all is there."""


def explained(path: Path, told: str) -> str | None:
    """Why the two readers differ on a file; None where nobody knows."""
    kind = {".glb": ".gltf"}.get(path.suffix.lower(), path.suffix.lower())
    if told.startswith("refused: ") and re.search(_REFUSALS.get(kind, "(?!)"), told):
        return told
    if kind == ".gltf":
        return _of_gltf(path)
    return _of_3mf(path) if kind == ".3mf" else None


def _of_gltf(path: Path) -> str | None:
    """What of a glTF file trimesh passes over."""
    text = unpack(path.read_bytes()).text
    document = json.loads(text)
    nodes, meshes = document.get("nodes", []), document.get("meshes", [])
    primitives = [primitive for mesh in meshes for primitive in mesh["primitives"]]
    children = [child for node in nodes for child in node.get("children", ())]
    weights = [holder["weights"] for holder in (*meshes, *nodes) if "weights" in holder]
    listed = [node for scene in document.get("scenes", ()) for node in scene.get("nodes", ())]
    reasons = {
        "skins": any("skin" in node for node in nodes),
        "morph targets": any(np.any(each) for each in weights),
        "fans": any(primitive.get("mode") == 6 for primitive in primitives),
        "sparse accessors": any("sparse" in each for each in document.get("accessors", ())),
        "several parents": len(set(children)) < len(children),
        "several scenes, or none": len(document.get("scenes", ())) != 1,
        "nodes under others in the scene": bool(set(children).intersection(listed)),
        "normalised positions": any(
            document["accessors"][primitive["attributes"]["POSITION"]].get("normalized")
            for primitive in primitives
            if "POSITION" in primitive["attributes"]
        ),
    }
    names = ("EXT_mesh_gpu_instancing", "KHR_draco", "meshopt", "KHR_mesh_quantization", "KHR_node_visibility")
    reasons |= {name: name.encode() in text for name in names}
    return ", ".join(reason for reason, holds in reasons.items() if holds) or None


def _of_3mf(path: Path) -> str | None:
    """What of a package trimesh mixes up or does not tell apart."""
    notes = read(path)[1]
    supports = [note for note in notes if "object of the type" in note]
    with zipfile.ZipFile(path) as archive:
        models = [name for name in archive.namelist() if name.lower().endswith(".model")]
    return "; ".join([*supports, *(["objects in several parts"] if len(models) > 1 else [])]) or None
