"""The result of one reference, and its form in a run's record."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.parameters import Parameters
from shapewright.references.readers.svg import read_svg
from shapewright.shapes import Mesh, Shape
from shapewright.shapes.files import read_glb


@dataclass(frozen=True, eq=False)
class Result:
    """The result of one reference.

    Attributes:
        name: of the reference.
        path: its file, None for a shape made in memory.
        parameters: in the procedure's units, None when nothing could be built.
        active: names of the parameters that matter at these values.
        at_limit: scalars at an end of their Range.
        replica: the shape that the procedure builds, in its own units; None when it failed.
        distance: by the iteration's metric; NaN without a replica.
        iou: of the silhouettes, 0 to 1; NaN without a replica.
        chamfer: distance of the surfaces, in units of the largest extent; NaN without a replica and for drawings.
        compatible: whether the procedure replicates the reference.
        group: index of the iteration's group, None for a compatible reference.
        reference: the normalised shape, None in an iteration that was loaded.
        error: why there is no replica.
        depth: difference of the depth pictures; NaN without a replica and for drawings.
    """

    name: str
    path: Path | None
    parameters: Parameters | None
    active: tuple[str, ...]
    at_limit: tuple[str, ...]
    replica: Shape | None
    distance: float
    iou: float
    chamfer: float
    compatible: bool
    group: int | None
    reference: Shape | None
    error: str | None = None
    depth: float = math.nan


_MEASURES = ("distance", "iou", "chamfer", "depth")


def to_record(result: Result, slug: str) -> dict[str, Any]:
    """As plain values for JSON; NaN becomes null."""
    return {
        "name": result.name,
        "slug": slug,
        "path": str(result.path) if result.path else None,
        "parameters": result.parameters,
        "active": list(result.active),
        "at_limit": list(result.at_limit),
        **{name: _finite(getattr(result, name)) for name in _MEASURES},
        "compatible": result.compatible,
        "group": result.group,
        "error": result.error,
        "replica": replica_path(result.replica, slug),
        "triangles": len(result.reference.faces) if isinstance(result.reference, Mesh) else None,
    }


def from_record(entry: Mapping[str, Any], replica: Shape | None) -> Result:
    """The inverse of ``to_record``, but for the reference's shape."""
    measures: dict[str, Any] = {name: math.nan if entry.get(name) is None else entry[name] for name in _MEASURES}
    return Result(
        path=Path(entry["path"]) if entry["path"] else None,
        active=tuple(entry["active"]),
        at_limit=tuple(entry["at_limit"]),
        replica=replica,
        reference=None,
        **measures,
        **{name: entry[name] for name in ("name", "parameters", "compatible", "group", "error")},
    )


def replica_path(replica: Shape | None, slug: str) -> str | None:
    """Where a run keeps a replica, GLB or SVG."""
    return f"replicas/{slug}.{'glb' if isinstance(replica, Mesh) else 'svg'}" if replica else None


def read_replica(run: Path, entry: Mapping[str, Any]) -> Shape | None:
    """The replica of an entry in a run's record, with its labels, if it has one. Raises OSError or ValueError."""
    if not entry["replica"]:
        return None
    data = (run / entry["replica"]).read_bytes()
    return read_svg(data)[0] if entry["replica"].endswith(".svg") else read_glb(data)


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
