"""What references have in common: groups by cause, and by where their surfaces differ."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from shapewright.comparison.grouping import group
from shapewright.feedback.case import Case, CauseKind, DrawnCase
from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.residuals import RegionSide, Residuals
from shapewright.parameters import Excess, ParameterSpace, Side
from shapewright.shapes import Floats

# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_CELLS, _BLUR = 8, 0.8  # cells along an axis, and how far they spread
_HALF = 0.75  # half the side of the cube that they fill: a replica may reach beyond its reference
_ALIKE = 0.6  # one less the cosine of two signatures, up to which residuals are grouped
_STRUCTURE = ("missing part", "surplus part", "wrong form")


@dataclass(frozen=True)
class SharedCause:
    """A cause that references share."""

    kind: CauseKind  # of the cause
    text: str  # the cause, and how many references share it
    references: tuple[str, ...]  # their names
    representative: str  # the most typical of them; of a Range, the one that is furthest outside
    outside: Excess | None = None  # of a Range: the parameter, the value of the representative and the end of the Range


def shared_causes(space: ParameterSpace, cases: Sequence[Case | DrawnCase]) -> list[SharedCause]:
    """The chief causes of cases, the one that most references share first.

    References whose chief cause lies in the parts of the shape are grouped by where the surfaces differ as well; a
    reference that several Ranges are too short for is in several groups.
    """
    kinds: dict[CauseKind, list[Case | DrawnCase]] = {}
    for case in cases:
        if case.causes:
            kinds.setdefault(case.causes[0].kind, []).append(case)
    too_short = _ranges(space, kinds.pop("out of range", []))
    others = [entry for kind, alike in kinds.items() for entry in _of_kind(kind, alike)]
    return sorted([*too_short, *others], key=lambda entry: -len(entry.references))


def signature(residuals: Residuals | Areas) -> Floats:
    """Where two surfaces differ, as a unit vector: shares of both sides' regions in blurred cells; 0 without any."""
    vector = np.concatenate([_filled(residuals, side).ravel() for side in ("unexplained", "surplus")])
    length = float(np.linalg.norm(vector))
    return vector / length if length > 0.0 else vector


def _filled(residuals: Residuals | Areas, side: RegionSide) -> Floats:
    cells = np.zeros((_CELLS,) * 3)
    for region in residuals.of(side):
        places = np.clip(((region.points + _HALF) / (2.0 * _HALF) * _CELLS).astype(int), 0, _CELLS - 1)
        np.add.at(cells, tuple(places.T), region.share / len(region.points))
    return np.asarray(gaussian_filter(cells, _BLUR))


def _of_kind(kind: CauseKind, cases: Sequence[Case | DrawnCase]) -> list[SharedCause]:
    names = [case.name for case in cases]
    if kind == "another pose":
        by_pose: dict[str, list[str]] = {}
        for case in cases:
            by_pose.setdefault(case.causes[0].evidence["words"], []).append(case.name)
        return [
            SharedCause(kind, f"{words}: {_count(len(some))}", tuple(some), some[0]) for words, some in by_pose.items()
        ]
    if kind not in _STRUCTURE:
        return [_shared(kind, None, names, names[0])]
    signatures = np.array([signature(case.covering_residuals) for case in cases])
    between = np.clip(1.0 - signatures @ signatures.T, 0.0, None)
    np.fill_diagonal(between, 0.0)
    labels = {case.name: case.causes[0].label for case in cases}
    groups = group(names, between, _ALIKE, absolute=True)
    return [_shared(kind, labels[alike.representative], alike.members, alike.representative) for alike in groups]


def _shared(kind: CauseKind, label: str | None, names: Sequence[str], representative: str) -> SharedCause:
    text = f"{kind}{f' near {label}' if label else ''}: {_count(len(names))}"
    return SharedCause(kind, text, tuple(names), representative)


def _ranges(space: ParameterSpace, cases: Sequence[Case | DrawnCase]) -> list[SharedCause]:
    outside: dict[tuple[str, Side], dict[str, Excess]] = {}
    for case in cases:
        for excess in space.outside(case.outside.parameters):
            outside.setdefault((excess.parameter, excess.side), {})[case.name] = excess
    entries = []
    for (parameter, side), excesses in outside.items():
        sign = 1.0 if side == "high" else -1.0
        furthest = max(excesses, key=lambda name: sign * excesses[name].value)
        excess = excesses[furthest]
        verb, way = ("ends", "up") if side == "high" else ("starts", "down")
        want = f"{'wants' if len(excesses) == 1 else 'want'} {way} to {excess.value:.3g}"
        text = f"{parameter}: {_count(len(excesses))} {want}; Range {verb} at {excess.end:.4g}"
        entries.append(SharedCause("out of range", text, tuple(excesses), furthest, excess))
    return entries


def _count(count: int) -> str:
    return f"{count} reference{'' if count == 1 else 's'}"
