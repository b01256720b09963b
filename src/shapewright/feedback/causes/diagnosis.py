"""Why a procedure does not replicate a reference, with the evidence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from shapewright.feedback.case import Case, Cause, DrawnCase, Replica
from shapewright.feedback.causes.leaning import Leaning
from shapewright.feedback.causes.structure import differences
from shapewright.feedback.causes.told import told_causes
from shapewright.parameters import ParameterSpace, Scalar
from shapewright.shapes import Mesh

# Where nothing else is said, chosen on seed 0 of benchmarks/causes.py.
_HELPS = 0.05  # share of what lies apart that a longer Range has to take away to be a cause when it does not suffice
_BARELY = 0.8  # of what a replicated shape may be apart
_LACKING = 0.01  # share of the surface times distance, of a missing or surplus part that is beyond doubt
_TOGETHER = 0.75  # of what lies apart within the space
_CLOSE = 0.5  # of the same: nearer than shapes come that make up for something else
_LEANS = 0.67  # of what lies apart, that is left at most where a part leans (docs/benchmarks.md, seeds 1 and 2)
_FAR = 1.25  # times the same: an outlier that comes nearer than this is only an unusual shape


def diagnosed(space: ParameterSpace, case: Case) -> tuple[Cause, ...]:
    """The causes of one case that is not replicated, the chief one first.

    A search that ends with a replicated shape is no proof that nothing is missing: shapes grow fat to make up for parts
    that they lack. So the surfaces have a say: other parameters or longer Ranges are the chief cause only when they
    bring the shapes very close, or the surfaces together.
    """
    ways = differences(case.covering_residuals)
    lacking = ways[0].kind != "wrong form" and ways[0].weight > _LACKING
    parts = told_causes(case, ways)
    if case.nearest.apart <= 1.0:
        better = overlooked(space, case.replica, case.nearest)
        barely = case.nearest.apart > _BARELY
        return (*parts, better) if barely and lacking else (better,)
    wishes = too_short(space, case)
    if wishes and _suffice(case):
        return wishes
    if case.isolation is not None and case.nearest.apart > _FAR:
        away = f"the nearest are {case.isolation:.2f} away; perhaps it does not belong here"
        text = f"unlike all other references: {away}"
        return (Cause("not such a shape", text, {"isolation": case.isolation}), *parts, *wishes)
    return (*parts, *wishes)


def or_leaning(case: Case, lean: Leaning | None) -> Case:
    """The case with a part that leans in place of what seems missing, where that brings the surfaces together.

    lean: the part that brings them together most when it leans.
    """
    apart = case.overlay(case.covering.mesh)
    if lean is None or lean.apart >= _LEANS * apart:
        slope = _slopes(case.causes)
        return replace(case, causes=(slope, *case.causes[1:])) if slope else case
    others = (cause for cause in case.causes if cause.kind not in ("missing part", "wrong form"))
    return replace(case, causes=(_leans(lean, apart, case.replica.mesh), *others))


def _suffice(case: Case) -> bool:
    """Whether longer Ranges make a reference replicated, or bring most of the surfaces together.

    The paper's judge forgives too much: with it the surfaces have to come together as well.
    """
    enough, sure = case.outside.apart <= 1.0, not math.isnan(case.outside.fidelity)
    if enough and (sure or case.outside.apart <= _CLOSE):
        return True
    if not enough and case.proportion is None:
        return False
    return case.overlay(case.outside.mesh) < _TOGETHER * case.overlay(case.covering.mesh)


def _slopes(causes: Sequence[Cause]) -> Cause | None:
    """Bars that slope, in place of a part that is too much, are another form of it."""
    chief, surplus = causes[0], [cause for cause in causes if cause.kind == "surplus part" and cause.label]
    form = chief.evidence.get("form", {})
    if not surplus or form.get("lie") != "sloping" or form.get("kind") != "bar":
        return None
    text = f"another form of {surplus[0].label}: sloping in the reference; {chief.text}"
    return replace(chief, kind="wrong form", text=text, label=surplus[0].label)


def _leans(lean: Leaning, before: float, shown: Mesh) -> Cause:
    """The part is named where the shown replica has it: it may stand on another."""
    label = lean.label if lean.label in shown.label_names else None
    way = "inwards" if lean.factor < 1.0 else "outwards"
    what = f"another form of {label}" if label else "another form of what it stands on"
    text = f"{what}: leaning {way}, {lean.factor:.2g} times as far apart at the floor"
    if lean.deeper != lean.factor:
        text += f", {lean.deeper:.2g} times from front to back"
    numbers = {"factor": lean.factor, "deeper": lean.deeper, "apart": lean.apart, "before": before}
    return Cause("wrong form", text, {"label": label, **numbers}, label)


def overlooked(space: ParameterSpace, before: Replica, better: Replica, measure: str = "distance") -> Cause:
    """The cause where a search within the space finds a better replica. measure: what falls, in words."""
    changed = [
        (p.name, before.parameters[p.name], better.parameters[p.name])
        for p in space
        if not isinstance(p, Scalar)
        and p.name in space.active(better.parameters)
        and before.parameters[p.name] != better.parameters[p.name]
    ]
    evidence = {
        "parameters": better.parameters,
        "distance": better.distance,
        "before": before.distance,
        "changed": [{"parameter": name, "was": was, "is": value} for name, was, value in changed],
    }
    fell = f"the {measure} falls from {before.distance:.3f} to {better.distance:.3f}"
    if not math.isnan(better.fidelity):
        fell = f"the fidelity rises from {before.fidelity:.2f} to {better.fidelity:.2f}"
    if changed:
        how = ", ".join(f"{name} is {_word(value)}, not {_word(was)}" for name, was, value in changed)
        return Cause("wrong choice", f"{how}: {fell}", evidence)
    return Cause("badly predicted", f"a longer search finds better parameters: {fell}", evidence)


def too_short(space: ParameterSpace, case: Case | DrawnCase, measure: str = "distance") -> tuple[Cause, ...]:
    """The cause where longer Ranges help, or would have to for a proportion; none otherwise.

    measure: what falls, in words.
    """
    shown, outside = case.replica, case.outside
    proportion = case.proportion if isinstance(case, Case) else None
    helps = outside.apart <= 1.0 or outside.apart < (1.0 - _HELPS) * case.nearest.apart
    excesses = space.outside(outside.parameters) if helps else ()
    if not excesses:
        if proportion is None:
            return ()
        return (Cause("out of range", proportion.words, {"wishes": [], "proportion": asdict(proportion)}),)
    verbs = {"low": "starts", "high": "ends"}
    how = ", ".join(f"{e.parameter} at {e.value:.3g}, Range {verbs[e.side]} at {e.end:.4g}" for e in excesses)
    after = f"the {measure} would be {outside.distance:.2f} instead of {shown.distance:.2f}"
    if not math.isnan(outside.fidelity):
        after = f"the fidelity would be {outside.fidelity:.2f} instead of {shown.fidelity:.2f}"
    evidence = {
        "wishes": [{"parameter": e.parameter, "value": e.value, "end": e.end, "side": e.side} for e in excesses],
        "parameters": outside.parameters,
        "distance": outside.distance,
        "before": shown.distance,
        "enough": outside.apart <= 1.0,
        **({"proportion": asdict(proportion)} if proportion else {}),
    }
    seen = f"{proportion.words}; " if proportion else ""
    return (Cause("out of range", f"{seen}{how}: {after}", evidence),)


def _word(value: Any) -> str:
    return ("on" if value else "off") if isinstance(value, bool) else str(value)
