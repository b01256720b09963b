"""Pairs of shapes whose truth is known: variants of what every example procedure builds, and of random solids.

The same to a person: every scalar off by up to 2 % of its Range; a soup with doubled, inverted, inner or missing faces,
or noise of 0.3 % of the extent. Not the same: one scalar off by 40 %, one other choice, other parameters, a mirrored or
turned shape, one on its head, one stretched by 1.25, a part dropped or added.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import trimesh

import shapewright as sw
from shapewright.modelling.solids import box, cone, cylinder, sphere
from shapewright.shapes import Mesh
from shapewright.shapes.mesh import concatenate

EXAMPLES = Path(__file__).parent.parent / "examples"
SAME = frozenset({"jitter", "doubled", "inverted", "noise", "faces missing", "few faces missing", "inner faces"})
GROSS = frozenset({"on its head", "stretched"})  # always different, where the images differ at all
_QUARTER = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
_PRIMITIVES = (box, cylinder, sphere, cone)
Recipe = list[tuple[int, Any, Any]]  # of a random solid: primitive, size, place


@dataclass(frozen=True, eq=False)
class Pair:
    family: str  # the kind of shape; what a judge learns from leaves one out
    variant: str
    detail: str  # the parameter that is off
    shape: str  # the reference's name
    reference: Mesh
    replica: Mesh

    @property
    def same(self) -> bool:
        return self.variant in SAME


def pairs(count: int, seed: int = 0) -> Iterator[Pair]:
    """Of ``count`` shapes of each final procedure, half as many of each earlier one, three times as many solids."""
    for path in (*sorted(EXAMPLES.glob("categories/*/v*.py")), *sorted(EXAMPLES.glob("tables/v*.py"))):
        final = path == sorted(path.parent.glob("v*.py"))[-1]
        yield from _of_procedure(path, count if final else count // 2, seed)
    rng = np.random.default_rng([seed, 9])
    for number in range(3 * count):
        recipe = _recipe(rng)
        mesh = _solid(recipe)
        for variant, other in (
            *_solid_variants(recipe, rng),
            *_poses(mesh, rng),
            *_parts(mesh, rng),
            *_soups(mesh, rng),
        ):
            yield Pair("solids", variant, "", f"solid {number}", mesh, other)


def _of_procedure(path: Path, count: int, seed: int) -> Iterator[Pair]:
    procedure = sw.load_procedure(path)
    space, family = (
        procedure.space,
        path.parent.name.removesuffix("s") if path.parent.name == "tables" else path.parent.name,
    )
    rng = np.random.default_rng([seed, zlib.crc32(f"{family}/{path.stem}".encode())])
    for number, values in enumerate(space.sample(count, seed=seed + 1)):
        mesh = _built(procedure, values)
        if mesh is None:
            continue
        wanted = [("jitter", "", _jittered(space, values, rng)) for _ in range(2)]
        wanted += [("scalar", *off) for _ in range(2) if (off := _scalar_off(space, values, rng))]
        wanted += [("choice", *off) for _ in range(2) if (off := _other_choice(space, values, rng))]
        wanted.append(("random", "", space.sample(1, seed=int(rng.integers(1 << 30)))[0]))
        others = [(variant, detail, _built(procedure, changed)) for variant, detail, changed in wanted]
        others += [
            (variant, "", other) for variant, other in (*_poses(mesh, rng), *_parts(mesh, rng), *_soups(mesh, rng))
        ]
        for variant, detail, other in others:
            if other is not None and len(other.faces):
                yield Pair(family, variant, detail, f"{path.parent.name}/{path.stem} {number}", mesh, other)


def _built(procedure: sw.Procedure, values: Mapping[str, Any]) -> Mesh | None:
    """None for parameters that the procedure cannot build."""
    try:
        return procedure(**values)
    except (sw.Infeasible, ValueError):
        return None


def _jittered(space: sw.ParameterSpace, values: Mapping[str, Any], rng: np.random.Generator) -> dict[str, Any]:
    vector = space.encode(values)
    near = np.clip(vector + rng.uniform(-0.02, 0.02, len(vector)), 0.0, 1.0)
    return space.decode(np.where(space.scalars, near, vector))


def _scalar_off(
    space: sw.ParameterSpace, values: Mapping[str, Any], rng: np.random.Generator
) -> tuple[str, Any] | None:
    vector, active = space.encode(values), set(space.active(values))
    free = [(i, sign) for i, name in enumerate(space.names) for sign in (-0.4, 0.4)
            if space.scalars[i] and name in active and 0.0 <= vector[i] + sign <= 1.0]  # fmt: skip
    if not free:
        return None
    i, sign = free[int(rng.integers(len(free)))]
    vector[i] += sign
    return space.names[i], space.decode(vector)


def _other_choice(
    space: sw.ParameterSpace, values: Mapping[str, Any], rng: np.random.Generator
) -> tuple[str, Any] | None:
    names = [name for i, name in enumerate(space.names) if not space.scalars[i] and name in space.active(values)]
    if not names:
        return None
    name = names[int(rng.integers(len(names)))]
    levels = [row[name] for row in space.sample(50, seed=int(rng.integers(1 << 30))) if row[name] != values[name]]
    return (name, {**values, name: levels[0]}) if levels else None


def _poses(mesh: Mesh, rng: np.random.Generator) -> Iterator[tuple[str, Mesh]]:
    yield "mirrored", mesh.transformed(np.diag([-1.0, 1.0, 1.0]))
    yield "on its head", mesh.transformed(np.diag([1.0, -1.0, 1.0]))
    yield "turned 90", mesh.transformed(_QUARTER)
    yield "turned 180", mesh.transformed(_QUARTER @ _QUARTER)
    scale = np.ones(3)
    scale[rng.integers(3)] = 1.25 if rng.random() < 0.5 else 1.0 / 1.25
    yield "stretched", mesh.transformed(np.diag(scale))


def _parts(mesh: Mesh, rng: np.random.Generator) -> Iterator[tuple[str, Mesh]]:
    if mesh.face_labels is not None and len(set(mesh.face_labels.tolist())) > 1:
        dropped = rng.choice(sorted(set(mesh.face_labels.tolist())))
        yield "part dropped", Mesh(mesh.vertices, mesh.faces[mesh.face_labels != dropped])
    normal = Mesh(mesh.normalised().vertices, mesh.faces)
    size = rng.uniform(0.05, 0.5, 3)
    size[rng.integers(3)] = rng.uniform(0.03, 0.1)
    at = normal.bounds[0] + rng.random(3) * normal.extent
    low, high = np.maximum(at - size / 2, normal.bounds[0]), np.minimum(at + size / 2, normal.bounds[1])
    yield (
        "part added",
        concatenate([normal, box(tuple(np.maximum(high - low, 0.03)), at=tuple((low + high) / 2)).mesh()]),
    )


def _soups(mesh: Mesh, rng: np.random.Generator) -> Iterator[tuple[str, Mesh]]:
    vertices, faces = mesh.normalised().vertices, mesh.faces
    yield "doubled", Mesh(vertices, np.concatenate([faces, faces[:, ::-1]]))
    yield "inverted", Mesh(vertices, np.where(rng.random((len(faces), 1)) < 0.5, faces[:, ::-1], faces))
    yield "noise", Mesh(vertices + rng.normal(0.0, 0.003 / np.sqrt(3), vertices.shape), faces)
    fine, cut = trimesh.remesh.subdivide_to_size(vertices, faces, 0.06, max_iter=12)
    yield "faces missing", Mesh(fine, cut[rng.random(len(cut)) > 0.05])
    if len(faces) >= 100:  # in a shape of a few faces one that is missing is a part
        yield "few faces missing", Mesh(vertices, faces[rng.random(len(faces)) > 0.05])
    yield "inner faces", concatenate([Mesh(vertices, faces), _inside(Mesh(vertices, faces))])


def _inside(mesh: Mesh, depth: float = 0.004) -> Mesh:
    """Smaller copies of all faces, a little behind them."""
    corners = mesh.triangles
    middle, across = (
        corners.mean(axis=1, keepdims=True),
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
    )
    normal = across / np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-12)
    inner = middle + 0.9 * (corners - middle) - depth * normal[:, None]
    return Mesh(inner.reshape(-1, 3), np.arange(3 * len(corners)).reshape(-1, 3))


def _recipe(rng: np.random.Generator) -> Recipe:
    return [
        (int(rng.integers(4)), rng.uniform(0.15, 1.0, 3), rng.uniform(-0.5, 0.5, 3)) for _ in range(rng.integers(1, 5))
    ]


def _solid(recipe: Recipe) -> Mesh:
    return concatenate([_PRIMITIVES[kind](tuple(size), at=tuple(at)).mesh() for kind, size, at in recipe])


def _solid_variants(recipe: Recipe, rng: np.random.Generator) -> Iterator[tuple[str, Mesh]]:
    """Sizes have a range of .85, places one of 1."""
    near = [(k, size + 0.85 * rng.uniform(-0.02, 0.02, 3), at + rng.uniform(-0.02, 0.02, 3)) for k, size, at in recipe]
    yield "jitter", _solid(near)
    i, axis = int(rng.integers(len(recipe))), int(rng.integers(3))
    kind, size, at = recipe[i]
    changed = size.copy()
    changed[axis] += 0.34 if changed[axis] < 0.6 else -0.34
    rest = [*recipe[:i], *recipe[i + 1 :]]
    yield "scalar", _solid([*rest, (kind, changed, at)])
    yield "choice", _solid([*rest, ((kind + 1 + int(rng.integers(3))) % 4, size, at)])
    if rest:
        yield "part dropped", _solid(rest)
    yield "random", _solid(_recipe(rng))
