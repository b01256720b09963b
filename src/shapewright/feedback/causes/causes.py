"""Why a procedure does not replicate a reference, with the evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from shapewright.feedback.causes.leaning import Leaning
from shapewright.feedback.causes.longer_search import Found
from shapewright.feedback.causes.structure import differences
from shapewright.feedback.surfaces.residuals import Residuals
from shapewright.parameters import ParameterSpace, Scalar, Side

Kind = Literal[
    "out of range",
    "badly predicted",
    "wrong choice",
    "missing part",
    "surplus part",
    "wrong form",
    "not such a shape",
]
_HELPS = 0.2  # share of the distance that a longer Range has to take away to be a cause when it does not suffice
_BARELY = 0.8  # of the threshold
_LACKING = 0.01  # share of the surface times distance, of a missing or surplus part that is beyond doubt
_TOGETHER = 0.75  # of what lies apart within the space
_CLOSE = 0.5  # of the threshold: nearer than shapes come that make up for something else
_LEANS = 0.67  # of what lies apart, that is left at most where a part leans
_FAR = 1.25  # thresholds: an outlier that comes nearer than this is only an unusual shape


@dataclass(frozen=True)
class Cause:
    """Why a reference is not replicated: in words, and what shows it, as plain values for JSON."""

    kind: Kind
    text: str
    evidence: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What was found out about one incompatible reference.

    before: what the iteration found; inside: what a longer search found within the space, outside: with longer Ranges;
    laid: the shape within the space whose surface has most in common with the reference's, and its residuals.
    laid_apart, outside_apart: how much of the surfaces lies apart, see ``placement.Overlay``. isolation: of a reference
    that is unlike all others, the mean distance to the nearest of them; None for any other.
    """

    before: Found
    inside: Found
    outside: Found
    laid: Found
    residuals: Residuals
    laid_apart: float
    outside_apart: float
    isolation: float | None


def causes(space: ParameterSpace, threshold: float, found: Evidence) -> tuple[Cause, ...]:
    """The causes for one incompatible reference, the chief one first.

    A search that ends below the threshold is no proof that nothing is missing: shapes grow fat to make up for parts
    that they lack. So the surfaces have a say: other parameters or longer Ranges are the chief cause only when they
    bring the shapes very close, or the surfaces together.
    """
    told = differences(found.residuals)
    parts = [Cause(part.kind, part.text, part.evidence) for part in told]
    lacking = told[0].kind != "wrong form" and told[0].weight > _LACKING
    if found.inside.distance <= threshold:
        overlooked = _overlooked(space, found.before, found.inside)
        barely = found.inside.distance > _BARELY * threshold
        return (*parts, overlooked) if barely and lacking else (overlooked,)
    ranges = _ranges(space, threshold, found.inside, found.outside)
    together = found.outside_apart < _TOGETHER * found.laid_apart or found.outside.distance <= _CLOSE * threshold
    if ranges and found.outside.distance <= threshold and together:
        return ranges
    if found.isolation is not None and found.inside.distance > _FAR * threshold:
        return (_strange(found.isolation), *parts, *ranges)
    return (*parts, *ranges)


def or_leaning(told: tuple[Cause, ...], found: Leaning | None, apart: float) -> tuple[Cause, ...]:
    """The same, with a part that leans in place of what seems missing, where that brings the surfaces together.

    found: the part that brings them together most when it leans; apart: how much lies apart where none does.
    """
    if found is None or found.apart >= _LEANS * apart:
        return told
    rest = (cause for cause in told if cause.kind not in ("missing part", "wrong form"))
    return (_leans(found, apart), *rest)


def _leans(found: Leaning, before: float) -> Cause:
    way = "inwards" if found.factor < 1.0 else "outwards"
    text = f"another form of {found.label}: leaning {way}, {found.factor:.2g} times as far apart at the floor"
    evidence = {"label": found.label, "factor": found.factor, "apart": found.apart, "before": before}
    return Cause("wrong form", f"{text}; {found.apart / before:.0%} of what lies apart is left", evidence)


def _overlooked(space: ParameterSpace, before: Found, found: Found) -> Cause:
    changed = [
        (p.name, before.parameters[p.name], found.parameters[p.name])
        for p in space
        if not isinstance(p, Scalar)
        and p.name in space.active(found.parameters)
        and before.parameters[p.name] != found.parameters[p.name]
    ]
    evidence = {
        "parameters": found.parameters,
        "distance": found.distance,
        "before": before.distance,
        "changed": [{"parameter": name, "was": was, "is": value} for name, was, value in changed],
    }
    fell = f"the distance falls from {before.distance:.3f} to {found.distance:.3f}"
    if changed:
        how = ", ".join(f"{name} is {_word(value)}, not {_word(was)}" for name, was, value in changed)
        return Cause("wrong choice", f"{how}: {fell}", evidence)
    return Cause("badly predicted", f"a longer search finds better parameters: {fell}", evidence)


def _ranges(space: ParameterSpace, threshold: float, inside: Found, outside: Found) -> tuple[Cause, ...]:
    excesses = space.outside(outside.parameters)
    enough = outside.distance <= threshold
    if not excesses or not (enough or outside.distance < (1.0 - _HELPS) * inside.distance):
        return ()
    how = ", ".join(f"{e.parameter} at {e.value:.3g}, Range {_ends(e.side)} at {e.end:.4g}" for e in excesses)
    after = f"the distance would be {outside.distance:.2f} instead of {inside.distance:.2f}"
    evidence = {
        "wishes": [{"parameter": e.parameter, "value": e.value, "end": e.end, "side": e.side} for e in excesses],
        "parameters": outside.parameters,
        "distance": outside.distance,
        "before": inside.distance,
        "enough": enough,
    }
    return (Cause("out of range", f"{how}: {after}", evidence),)


def _ends(side: Side) -> str:
    return "starts" if side == "low" else "ends"


def _strange(isolation: float) -> Cause:
    text = f"unlike all other references: the nearest are {isolation:.2f} away; perhaps it does not belong here"
    return Cause("not such a shape", text, {"isolation": isolation})


def _word(value: Any) -> str:
    return ("on" if value else "off") if isinstance(value, bool) else str(value)
