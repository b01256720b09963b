"""The result of one reference, and its form in a run's record."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

from shapewright.judging.target import Measures
from shapewright.judging.verdict import Grade, Region
from shapewright.parameters import Parameters
from shapewright.references.readers.svg import read_svg
from shapewright.runs import packed
from shapewright.runs.lazy import Read
from shapewright.settings import JudgeName
from shapewright.shapes import Mesh, Points, ReferenceShape, Shape
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
        replica: the shape that the procedure builds, in its own units; None when it failed. Of one of many references
            it is read from disk whenever it is asked for.
        measured: how the replica differs from the reference; NaN without a replica.
        grade: by the judge of the settings; different without a replica.
        compatible: whether the two count as the same by the paper's measure.
        group: index of the iteration's group, None for a replicated reference.
        reference: the normalised shape, None in an iteration that was loaded.
        error: why there is no replica.
        missing: regions of the reference without a counterpart, the largest first.
        surplus: regions of the replica without a counterpart, the largest first.
        places: from where an object in views was seen, one for each: azimuth and elevation in degrees, and one over the
            distance in largest extents. Empty for other references. Regions are those of the first view.
        notes: what of the reference's file was left out.
        follows: the reference that this one is like, and whose results it has; None for one that was fitted itself.
    """

    name: str
    path: Path | None
    parameters: Parameters | None
    active: tuple[str, ...]
    at_limit: tuple[str, ...]
    replica: Shape | None
    measured: Measures
    grade: Grade
    compatible: bool
    group: int | None
    reference: ReferenceShape | None
    error: str | None = None
    missing: tuple[Region, ...] = ()
    surplus: tuple[Region, ...] = ()
    places: tuple[tuple[float, ...], ...] = ()
    notes: tuple[str, ...] = ()
    follows: str | None = None

    @property
    def held(self) -> Shape | None:
        """The replica, or what reads it: to make another result with it."""
        held: Shape | None = _REPLICA.held(self)
        return held

    @property
    def fidelity(self) -> float:
        """The probability that a person calls replica and reference the same, 0 to 1; NaN without a replica."""
        return self.measured.fidelity

    @property
    def distance(self) -> float:
        """By the paper's measure, the iteration's metric; NaN without a replica."""
        return self.measured.distance

    @property
    def iou(self) -> float:
        """Of the silhouettes or areas, 0 to 1; NaN without a replica."""
        return self.measured.iou

    @property
    def chamfer(self) -> float:
        """Distance of the surfaces or outlines, in units of the largest extent; NaN without a replica."""
        return self.measured.chamfer

    @property
    def depth(self) -> float:
        """Difference of the depth pictures; NaN without a replica and for drawings."""
        return self.measured.depth

    @property
    def measures(self) -> Mapping[str, float]:
        """All measures by name; NaN for what cannot be measured."""
        return self.measured.by_name()


_REPLICA = Read("replica")
Result.replica = _REPLICA  # type: ignore[assignment]  # it gives what the field says
MEASURES = tuple(field.name for field in fields(Measures))
"""The names of all measures."""
_KEPT = 8  # regions in a record, of either kind: the largest


def to_record(result: Result, slug: str) -> dict[str, Any]:
    """As plain values for JSON; NaN becomes null."""
    replica = result.replica
    return {
        "name": result.name,
        "slug": slug,
        "path": str(result.path) if result.path else None,
        "parameters": result.parameters,
        "active": list(result.active),
        "at_limit": list(result.at_limit),
        **{name: _finite(value) for name, value in result.measures.items()},
        "grade": result.grade,
        "missing": [_region(region) for region in result.missing[:_KEPT]],
        "surplus": [_region(region) for region in result.surplus[:_KEPT]],
        **({"places": [[round(x, 4) for x in place] for place in result.places]} if result.places else {}),
        "compatible": result.compatible,
        "group": result.group,
        "error": result.error,
        "replica": replica_path(replica, slug),
        "triangles": len(result.reference.faces) if isinstance(result.reference, Mesh) else None,
        "points": len(result.reference) if isinstance(result.reference, Points) else None,
        "notes": list(result.notes),
        "follows": result.follows,
    }


def from_record(entry: Mapping[str, Any], replica: Shape | None) -> Result:
    """The inverse of ``to_record``, but for the reference's shape."""
    return Result(
        path=Path(entry["path"]) if entry["path"] else None,
        active=tuple(entry["active"]),
        at_limit=tuple(entry["at_limit"]),
        replica=replica,
        reference=None,
        measured=Measures(**{name: math.nan if entry.get(name) is None else entry[name] for name in MEASURES}),
        grade=grade_in(entry),
        missing=tuple(_read_region(region) for region in entry.get("missing", ())),
        surplus=tuple(_read_region(region) for region in entry.get("surplus", ())),
        places=tuple(map(tuple, entry.get("places", ()))),
        notes=tuple(entry.get("notes", ())),
        follows=entry.get("follows"),
        **{name: entry[name] for name in ("name", "parameters", "compatible", "group", "error")},
    )


def judge_in(record: Mapping[str, Any]) -> JudgeName:
    """By which judge a run's references have their grades; the first versions had the paper's alone."""
    judge: JudgeName = record.get("judge", "paper")
    return judge


def grade_in(entry: Mapping[str, Any]) -> Grade:
    """The grade of a reference in a run's record; the first versions noted only whether it was compatible."""
    grade: Grade | None = entry.get("grade")
    return grade or ("replicated" if entry["compatible"] else "different")


def replica_path(replica: Shape | None, slug: str) -> str | None:
    """Where a run keeps a replica, GLB or SVG."""
    return f"replicas/{slug}.{'glb' if isinstance(replica, Mesh) else 'svg'}" if replica else None


def read_replica(run: Path, entry: Mapping[str, Any]) -> Shape | None:
    """The replica of an entry in a run's record, with its labels, if it has one. Raises OSError or ValueError."""
    if not entry["replica"]:
        return None
    data = packed.read(run, entry["replica"])
    if data is None:
        raise FileNotFoundError(f"{run / entry['replica']}: the run has lost this replica")
    return read_svg(data)[0] if entry["replica"].endswith(".svg") else read_glb(data)


def _region(region: Region) -> dict[str, Any]:
    low, high = ([round(x, 4) for x in corner] for corner in (region.low, region.high))
    return {"size": round(region.size, 4), "low": low, "high": high, "share": round(region.share, 5)}


def _read_region(record: Mapping[str, Any]) -> Region:
    return Region(record["size"], tuple(record["low"]), tuple(record["high"]), record["share"])


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
