"""What is wrong with meshes that people publish: each flaw turns the parts of a shape into worse ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from shapewright.shapes import Mesh

Parts = list[Mesh]
Random = np.random.Generator


def without_bottoms(parts: Parts, rng: Random) -> Parts:
    """Every part open below."""
    return [_faces(part, _normals(part)[:, 1] > -0.9) for part in parts]


def one_sheet(parts: Parts, rng: Random) -> Parts:
    """The flattest part, when it is thin, reduced to the face on one side of it."""
    thin = [part.extent.min() / max(other.extent.max() for other in parts) for part in parts]
    flattest = int(np.argmin(thin))
    axis = int(parts[flattest].extent.argmin())
    sheet = _faces(parts[flattest], _normals(parts[flattest])[:, axis] > 0.9)
    return [sheet if i == flattest and thin[i] < 0.05 and len(sheet.faces) else part for i, part in enumerate(parts)]


def part_twice(parts: Parts, rng: Random) -> Parts:
    return [*parts, parts[int(rng.integers(len(parts)))]]


def parts_inside_out(parts: Parts, rng: Random) -> Parts:
    return [_flipped(part, np.full(len(part.faces), rng.random() < 0.5)) for part in parts]


def faces_inside_out(parts: Parts, rng: Random) -> Parts:
    return [_flipped(part, rng.random(len(part.faces)) < 0.3) for part in parts]


def unwelded(parts: Parts, rng: Random) -> Parts:
    """Three vertices for every triangle."""
    return [Mesh(part.triangles.reshape(-1, 3), np.arange(3 * len(part.faces)).reshape(-1, 3)) for part in parts]


FLAWS: Mapping[Callable[[Parts, Random], Parts], float] = {
    without_bottoms: 0.4,
    one_sheet: 0.2,
    part_twice: 0.3,
    parts_inside_out: 0.4,
    faces_inside_out: 0.25,
    unwelded: 0.4,
}
"""Each flaw, and how likely a table has it."""


def _normals(part: Mesh) -> NDArray[np.float64]:
    a, b, c = (part.triangles[:, i] for i in range(3))
    normals = np.cross(b - a, c - a)
    return np.asarray(normals / np.linalg.norm(normals, axis=1, keepdims=True))


def _faces(part: Mesh, kept: NDArray[np.bool_]) -> Mesh:
    return Mesh(part.vertices, part.faces[kept])


def _flipped(part: Mesh, inward: NDArray[np.bool_]) -> Mesh:
    return Mesh(part.vertices, np.where(inward[:, None], part.faces[:, ::-1], part.faces))
