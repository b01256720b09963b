"""Scenes as other programs write them: a chair with what people leave around it."""

from pathlib import Path

import numpy as np
import trimesh

LEGS = [(x, z) for x in (-0.22, 0.22) for z in (-0.22, 0.22)]


def moved(mesh, x=0.0, y=0.0, z=0.0):
    mesh.apply_translation((x, y, z))
    return mesh


def box(size, at=(0.0, 0.0, 0.0)):
    return moved(trimesh.creation.box(size), *at)


def chair(x=0.0) -> dict[str, trimesh.Trimesh]:
    """Six boxes by their names, Y up, on the ground, 1 high."""
    parts = {f"leg{i}": box((0.06, 0.45, 0.06), (x + dx, 0.225, dz)) for i, (dx, dz) in enumerate(LEGS)}
    return parts | {"seat": box((0.5, 0.05, 0.5), (x, 0.47, 0)), "back": box((0.5, 0.5, 0.05), (x, 0.75, -0.22))}


def sheet(width: float, depth: float, at=(0.0, 0.0, 0.0)) -> trimesh.Trimesh:
    """A rectangle that lies flat."""
    corners = np.array([[x * width, 0.0, z * depth] for x, z in ((-0.5, -0.5), (-0.5, 0.5), (0.5, 0.5), (0.5, -0.5))])
    return trimesh.Trimesh(corners + at, [[0, 1, 2], [0, 2, 3]], process=False)


def frustum(at=(2.0, 1.0, 2.0), to=(0.0, 0.5, 0.0), length=0.4) -> trimesh.Trimesh:
    """A camera's pyramid, whose tip is at a place and which looks at another one."""
    tip, towards = np.array(at), np.subtract(to, at)
    forward = towards / np.linalg.norm(towards)
    right = np.cross(forward, [0, 1, 0])
    right /= np.linalg.norm(right)
    up = np.cross(right, forward)
    base = [tip + length * (forward + 0.6 * a * right + 0.4 * b * up) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    faces = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1], [1, 3, 2], [1, 4, 3]]
    return trimesh.Trimesh([tip, *base], faces, process=False)


def write(path: Path, parts: dict[str, trimesh.Trimesh]) -> Path:
    """As GLB with a node for each part, or in any other format as one mesh without names."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".glb":
        scene = trimesh.Scene()
        for name, part in parts.items():
            scene.add_geometry(part, node_name=name, geom_name=name)
        path.write_bytes(scene.export(file_type="glb"))
    else:
        trimesh.util.concatenate(list(parts.values())).export(path)
    return path
