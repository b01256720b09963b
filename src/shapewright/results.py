"""What was found for one reference, and its form in a run's record."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.parameters import Parameters, ParameterSpace, Scalar
from shapewright.shapes import Mesh


@dataclass(frozen=True, eq=False)
class Result:
    """What was found for one reference.

    parameters: in the procedure's units, None when nothing could be built. active: names of those that matter.
    at_limit: scalars that rest on an end of their Range. replica: the mesh the procedure builds, in its own units.
    distance: normalised light-field distance, iou: of silhouettes, chamfer: in units of the largest extent, depth:
    difference of depth pictures; NaN without a replica. group: index into the iteration's groups, None for a
    compatible reference. reference: the normalised mesh, None in an iteration that was loaded. error: why there is no
    replica.
    """

    name: str
    path: Path | None
    parameters: Parameters | None
    active: tuple[str, ...]
    at_limit: tuple[str, ...]
    replica: Mesh | None
    distance: float
    iou: float
    chamfer: float
    compatible: bool
    group: int | None
    reference: Mesh | None
    error: str | None = None
    depth: float = math.nan


def at_limit(space: ParameterSpace, parameters: Parameters, margin: float = 0.02) -> tuple[str, ...]:
    """Names of the active scalars within ``margin`` of an end of their Range: perhaps the Range ends too soon."""
    active = space.active(parameters)
    scalars = [p for p in space if isinstance(p, Scalar) and p.name in active]
    return tuple(p.name for p in scalars if not margin < p.encode(parameters[p.name]) < 1.0 - margin)


def to_record(result: Result, slug: str) -> dict[str, Any]:
    """As plain values for JSON; NaN becomes null."""
    return {
        "name": result.name,
        "slug": slug,
        "path": str(result.path) if result.path else None,
        "parameters": result.parameters,
        "active": list(result.active),
        "at_limit": list(result.at_limit),
        "distance": _finite(result.distance),
        "iou": _finite(result.iou),
        "chamfer": _finite(result.chamfer),
        "depth": _finite(result.depth),
        "compatible": result.compatible,
        "group": result.group,
        "error": result.error,
        "replica": f"replicas/{slug}.glb" if result.replica is not None else None,
        "triangles": len(result.reference.faces) if result.reference is not None else None,
    }


def from_record(entry: Mapping[str, Any], replica: Mesh | None) -> Result:
    """The inverse of ``to_record``, but for the reference's mesh."""
    distance, iou, chamfer, depth = (
        math.nan if entry.get(key) is None else entry[key] for key in ("distance", "iou", "chamfer", "depth")
    )
    return Result(
        name=entry["name"],
        path=Path(entry["path"]) if entry["path"] else None,
        parameters=entry["parameters"],
        active=tuple(entry["active"]),
        at_limit=tuple(entry["at_limit"]),
        replica=replica,
        distance=distance,
        iou=iou,
        chamfer=chamfer,
        compatible=entry["compatible"],
        group=entry["group"],
        reference=None,
        error=entry["error"],
        depth=depth,
    )


def file_names(names: tuple[str, ...]) -> dict[str, str]:
    """A short file name of safe characters for each name, all different."""
    slugs: dict[str, str] = {}
    taken: set[str] = set()
    for name in names:
        stem = re.sub(r"[^A-Za-z0-9_-]+", "-", name).strip("-")[:80] or "reference"
        slug = stem
        for count in range(2, len(names) + 2):
            if slug.lower() not in taken:
                break
            slug = f"{stem}-{count}"
        taken.add(slug.lower())
        slugs[name] = slug
    return slugs


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
