"""Differences told of the replica that is shown: every part that is named is one of it, every number is of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, replace
from typing import Any

import numpy as np

from shapewright.feedback.case import Case, Cause
from shapewright.feedback.causes.structure import Difference, PartCause, differences, moved_pairs
from shapewright.feedback.remarks.counting import Count, counts
from shapewright.feedback.remarks.form import copies_of, form_of
from shapewright.feedback.remarks.girth import girth
from shapewright.feedback.remarks.moved import moved
from shapewright.feedback.remarks.part_boxes import Part, parts_of
from shapewright.feedback.remarks.turned import turned
from shapewright.feedback.remarks.whereabouts import whereabouts
from shapewright.feedback.surfaces.areas import Areas
from shapewright.feedback.surfaces.residuals import SIDES, Region, RegionSide, Residuals
from shapewright.shapes import Floats

_SHARED = 0.5
"""Share of a region that the shown replica has to leave unexplained too. Half, so that most of it can be seen."""
_NAMED = 0.5
"""Share of a missing region that lies on the part of the reference that is named for it. Half, so that it is most."""
_TOLD = 0.002
"""Share of the surface times distance that a remark on a replicated shape is worth: a tenth of a part beyond doubt is
0.001, and no person sees that."""


def told_causes(case: Case, ways: Sequence[Difference]) -> tuple[Cause, ...]:
    """Causes for what is different, the chief one first; at least one.

    ways: what no parameters account for, as the covering replica has it. A kind of difference that the shown replica
    does not have is left out; where nothing is left, its own differences are told.
    """
    own = {way.kind: way for way in differences(case.residuals)}
    parts = parts_of(case.residuals)
    kept = [way for each in ways if (way := _shown(each, case, own))] or list(own.values())
    return tuple(_cause(way, case.residuals, parts, case) for way in kept)


def drawn_causes_of(residuals: Areas) -> tuple[Cause, ...]:
    """The same of drawings."""
    return tuple(_cause(way, residuals, (), None) for way in differences(residuals))


def remark(case: Case) -> Cause | None:
    """What still differs in a replica that is good enough, None where nobody would see it."""
    chief, *_ = differences(case.residuals)
    if chief.weight < _TOLD:
        return None
    return _cause(chief, case.residuals, parts_of(case.residuals), case)


def shown_regions(case: Case) -> tuple[Region, ...]:
    """What a picture of reference and shown replica marks, the weightiest first.

    Of the reference what no parameters account for, where the shown replica lacks it too; else all that this one lacks.
    """
    own = case.residuals.of("unexplained")
    lacking = _lacking(case.covering_residuals.of("unexplained"), case) or own
    parts = parts_of(case.residuals)
    lacking = tuple(replace(region, label=_near(region, parts, case)) for region in lacking)
    return tuple(sorted([*lacking, *case.residuals.of("surplus")], key=lambda region: -region.weight))


def _shown(way: Difference, case: Case, own: dict[PartCause, Difference]) -> Difference | None:
    """The same difference in the shown replica, weighed as it was; None where there is none."""
    if way.kind == "missing part" and (regions := _lacking(way.regions, case)):
        return replace(way, regions=regions)
    return replace(own[way.kind], weight=way.weight) if way.kind in own else None


def _lacking(regions: Sequence[Region], case: Case) -> tuple[Region, ...]:
    """Of a covering replica's unexplained regions those that the shown one leaves unexplained as well."""
    unexplained = np.concatenate([np.empty(0, int), *(region.rows for region in case.residuals.of("unexplained"))])
    return tuple(region for region in regions if np.isin(region.rows, unexplained).mean() > _SHARED)


def _cause(way: Difference, residuals: Residuals | Areas, parts: Sequence[Part], case: Case | None) -> Cause:
    if not way.regions:
        text = f"no part of the {residuals.measured} stands out; the difference is in small detail all over"
        return Cause(way.kind, text, {"regions": 0, "share": 0.0})
    chief = way.regions[0]
    share = {side: sum(r.share for r in way.regions if r.side == side) for side in SIDES}
    label = chief.label if case is None or chief.side == "surplus" else _near(chief, parts, case)
    evidence: dict[str, Any] = {
        "regions": len(way.regions),
        "label": label,
        "rule": chief.rule if case is None or chief.side == "surplus" else None,
        "centre": chief.box.centre.round(4).tolist(),
        "size": chief.box.size.round(4).tolist(),
        "unexplained": round(share["unexplained"], 4),
        "surplus": round(share["surplus"], 4),
        "weight": round(way.weight, 5),
    }
    if case is None:
        text = _drawn(way.kind, chief, share, residuals)
    else:
        facts, text = _remarks(way, parts, share, case)
        evidence |= facts
    return Cause(way.kind, text, evidence, label, way.weight)


def _drawn(kind: PartCause, chief: Region, share: Mapping[RegionSide, float], residuals: Residuals | Areas) -> str:
    size, of = _size(chief, residuals.dimensions), residuals.measured
    match kind:
        case "missing part":
            return f"a part is missing: {size}, {share['unexplained']:.0%} of the reference's {of}"
        case "surplus part":
            return f"a part is too much: {size}, {share['surplus']:.0%} of the replica's {of}"
        case "wrong form":
            return f"another form: {size}, {_both(share, of)}"


def _remarks(
    way: Difference, parts: Sequence[Part], share: Mapping[RegionSide, float], case: Case
) -> tuple[dict[str, Any], str]:
    """What is seen of a difference, as plain values and in words. share: of either surface."""
    chief, whole = way.regions[0], case.residuals.reference_bounds
    alike = copies_of(chief, way.regions)
    bounds = _around(alike)
    others = parts if chief.side == "unexplained" else [part for part in parts if part.label != chief.label]
    where = whereabouts(bounds, others, whole)
    if way.kind == "missing part":
        form = form_of(chief, alike, case.reference.normalised())
        rows = [
            row for row in counts(case.residuals, parts) if row.reference > row.replica and row.label in where.parts
        ]
        told = "; ".join([f"{form.words} {where.words}", *(row.words for row in rows)])
        named = part_named(chief, case)
        part = f"the reference's part {named!r}, " if named else ""
        text = f"missing: {part}{told}; {share['unexplained']:.0%} of the reference's surface"
        facts = {"form": asdict(form), "where": asdict(where), **_counted(rows)}
        return facts | ({"part": named} if named else {}), text
    if way.kind == "surplus part":
        what = f"{chief.label}, {_size(chief)}" if chief.label else form_of(chief, alike).words
        tall = replace(where, parts=()).words if chief.label else where.words
        return {"where": asdict(where)}, f"too much: {what}, {tall}; {share['surplus']:.0%} of the replica's surface"
    labels = {region.label for region in way.regions}
    rows = [row for row in counts(case.residuals, parts) if row.label in labels]
    turns = turned(case.residuals, way.regions, parts)
    pairs = [pair for pair in moved_pairs(case.residuals) if pair[0] in way.regions or pair[1] in way.regions]
    stands = [
        one
        for one in moved(pairs, case.residuals.regions, parts, whole)
        if one.label not in {turn.label for turn in turns}
    ]
    wide = girth(case.residuals, bounds, whole)
    facts = {
        "where": asdict(where),
        "turned": [asdict(one) for one in turns],
        "moved": [asdict(one) for one in stands],
        **({"girth": asdict(wide)} if wide else {}),
        **_counted(rows),
    }
    seen = [*(row.words for row in rows), *(turn.words for turn in turns), *(one.words for one in stands)]
    told = "; ".join([*seen, *([wide.words] if wide else [])])
    of = f" of {chief.label}" if chief.label and chief.side == "surplus" else ""
    another = f"another form{of}, {_size(chief)} {where.words}: {_both(share)}"
    return facts, f"{told}; {_both(share)}" if seen else f"{another}; {told}" if told else another


def _counted(rows: Sequence[Count]) -> dict[str, Any]:
    return {"counts": [asdict(row) for row in rows]} if rows else {}


def _near(region: Region, parts: Sequence[Part], case: Case) -> str | None:
    """The part of the shown replica that a missing region is nearest to."""
    where = whereabouts(_around([region]), parts, case.residuals.reference_bounds)
    return where.parts[0] if where.parts else None


def part_named(region: Region, case: Case) -> str | None:
    """What the reference's file calls the part that a missing region mostly lies on; None where it says nothing."""
    labels, names = case.reference.face_labels, case.reference.label_names
    if labels is None or len(names) < 2:
        return None
    found, counts = np.unique(labels[case.residuals.reference.faces[region.rows]], return_counts=True)
    commonest = int(found[counts.argmax()])
    return names[commonest] if commonest >= 0 and counts.max() > _NAMED * counts.sum() else None


def _around(regions: Sequence[Region]) -> Floats:
    points = np.concatenate([region.points for region in regions])
    return np.stack([points.min(axis=0), points.max(axis=0)])


def _size(region: Region, dimensions: int = 3) -> str:
    return " x ".join(f"{side:.2f}" for side in region.box.size[:dimensions])


def _both(share: Mapping[RegionSide, float], of: str = "surface") -> str:
    return " and ".join(f"{value:.0%} of the {of} {side}" for side, value in share.items() if value > 0.0)
