"""What references have in common: groups by cause, and by where their surfaces differ."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from shapewright.comparison.grouping import group
from shapewright.feedback.case import Case, Cause, CauseKind, DrawnCase
from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.residuals import RegionSide, Residuals
from shapewright.parameters import Excess, ParameterSpace, Side
from shapewright.shapes import Floats

# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_CELLS, _BLUR = 8, 0.8  # cells along an axis, and how far they spread
_HALF = 0.75  # half the side of the cube that they fill: a replica may reach beyond its reference
_ALIKE = 0.6  # one less the cosine of two signatures, up to which residuals are grouped
_SAID = 0.5  # of how unlike two cases are, where the same words are said of both
_FEW = 3  # references, from which on those that share nothing are one entry
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
    kinds.pop("out of range", None)
    others = [entry for kind, alike in kinds.items() for entry in _of_kind(kind, alike)]
    return sorted([*_ranges(space, cases), *others], key=lambda entry: -len(entry.references))


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
        return [_shared(kind, {}, names, names[0])]
    known = {case.name: brief(case.causes[0]) for case in cases}
    between = _between(cases, [known[name] for name in names])
    groups = group(names, between, _ALIKE, absolute=True)
    several = [_shared(kind, known, alike.members, alike.representative) for alike in groups if len(alike.members) > 1]
    alone = [name for alike in groups if len(alike.members) == 1 for name in alike.members]
    if len(alone) < _FEW:
        return [*several, *(_shared(kind, known, [name], name) for name in alone)]
    return [*several, SharedCause(kind, f"{kind}, each elsewhere: {_count(len(alone))}", tuple(alone), alone[0])]


def _between(cases: Sequence[Case | DrawnCase], known: Sequence[str | None]) -> Floats:
    """How unlike the causes of cases are, (N, N), 0 to 1: by where surfaces differ, and by what is said of it."""
    signatures = np.array([signature(case.covering_residuals) for case in cases])
    between = np.clip(1.0 - signatures @ signatures.T, 0.0, None)
    same = np.array([[a is not None and a == b for b in known] for a in known])
    between = np.where(same, _SAID * between, between)
    np.fill_diagonal(between, 0.0)
    return np.asarray(between)


def brief(cause: Cause) -> str | None:
    """What a cause in the parts of a shape says without its numbers, None where it says nothing of a part."""
    evidence = cause.evidence
    match cause.kind:
        case "missing part" if "form" in evidence:
            where = evidence["where"]
            place = f" {where['relation']} {' and '.join(where['parts'])}" if where["parts"] else ""
            return f"{evidence['form']['kind']} missing{place}"
        case "surplus part":
            return f"{cause.label} too much" if cause.label else None
        case "wrong form":
            if turned := evidence.get("turned"):
                return f"{turned[0]['label']} {turned[0]['turn']}"
            if counts := evidence.get("counts"):
                return f"another number of {counts[0]['label']}"
            if moved := evidence.get("moved"):
                return f"{moved[0]['label']} elsewhere"
            return f"another form of {cause.label}" if cause.label else None
    return None


def _shared(
    kind: CauseKind, known: Mapping[str, str | None], references: Sequence[str], representative: str
) -> SharedCause:
    """An entry in the words that most of the references have, or in those of its kind."""
    said = Counter(words for name in references if (words := known.get(name)))
    words, often = said.most_common(1)[0] if said else ("", 0)
    text = words if 2 * often > len(references) else kind
    return SharedCause(kind, f"{text}: {_count(len(references))}", tuple(references), representative)


def _ranges(space: ParameterSpace, cases: Sequence[Case | DrawnCase]) -> list[SharedCause]:
    """Ranges whose widening brings references nearer, also where it replicates none of them."""
    outside: dict[tuple[str, Side], dict[str, Excess]] = {}
    solved: set[str] = set()
    for case in cases:
        told = next((cause for cause in case.causes if cause.kind == "out of range"), None)
        for excess in _excesses(space, case, told) if told else ():
            outside.setdefault((excess.parameter, excess.side), {})[case.name] = excess
        if told and told.evidence.get("enough"):
            solved.add(case.name)
    entries = []
    for (parameter, side), excesses in outside.items():
        sign = 1.0 if side == "high" else -1.0
        furthest = max(excesses, key=lambda name: sign * excesses[name].value)
        excess = excesses[furthest]
        verb, way = ("ends", "up") if side == "high" else ("starts", "down")
        want = f"{'wants' if len(excesses) == 1 else 'want'} {way} to {excess.value:.3g}"
        gain = len(solved & excesses.keys())
        replicated = f"{gain} of them would be replicated" if gain < len(excesses) else "replicated then"
        text = f"{parameter}: {_count(len(excesses))} {want}; Range {verb} at {excess.end:.4g}; {replicated}"
        entries.append(SharedCause("out of range", text, tuple(excesses), furthest, excess))
    return entries


def _excesses(space: ParameterSpace, case: Case | DrawnCase, told: Cause) -> tuple[Excess, ...]:
    """What a cause wishes: numbers outside their Ranges, or the limit of a proportion."""
    if told.evidence["wishes"]:
        return space.outside(case.outside.parameters)
    proportion = case.proportion if isinstance(case, Case) else None
    wish = proportion.wish() if proportion else None
    if proportion is None or proportion.limit is None or wish is None:
        return ()
    return (Excess(proportion.limit.parameter, wish, proportion.limit.end, proportion.limit.side),)


def _count(count: int) -> str:
    return f"{count} reference{'' if count == 1 else 's'}"
