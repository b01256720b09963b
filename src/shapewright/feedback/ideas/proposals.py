"""Changes of a procedure that misfits share: wider Ranges, and rules for what hypotheses about them have in common."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from shapewright.feedback.ideas.hypotheses import REST, Hypothesis
from shapewright.feedback.ideas.proposal import Misfit, Proposal, Ranges, as_value
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.relations import WHOLE, Frames
from shapewright.feedback.parts.supports import bounds_of
from shapewright.feedback.writing.edit import EditError, free_name, with_range, with_rule
from shapewright.feedback.writing.spelling import noun, number
from shapewright.feedback.writing.wording import Rule, addition, drawing_in, removal, splaying
from shapewright.parameters import Integer, Parameter, Parameters, ParameterSpace, Scalar
from shapewright.shapes import Floats, Mesh

_REMOVED = 0.4  # share of the misfits whose replica has the part, from which on the rule takes it away
_MOST_PIECES = 3
_SHARED = 0.25


def proposals(
    source: str, procedure: str, space: ParameterSpace, misfits: Sequence[Misfit], always: Sequence[str]
) -> list[Proposal]:
    """All changes worth trying, the most promising first. always: labels that every shape of the procedure has."""
    found = [*_wider(source, procedure, space, misfits), *_rules(source, procedure, misfits, always)]
    unique = {(each.kind, each.title, tuple(sorted(each.starts))): each for each in reversed(found)}
    return sorted(unique.values(), key=lambda each: -each.worth)


def narrowed(proposal: Proposal, space: ParameterSpace, values: Sequence[Parameters]) -> Ranges:
    """Ranges that the references need, with a margin, given the parameters that were found for them."""
    if proposal.rule is None:
        wide = proposal.ranges
        return {name: _needed(space[name], [float(v[name]) for v in values], wide[name]) for name in wide}
    return {
        q.name: _around(np.array([float(v[q.name]) for v in values]), q.whole, q.values, proposal.ranges[q.name])
        for q in proposal.rule.quantities
    }


def frames_of(replica: Mesh, always: Sequence[str]) -> Frames:
    """The bounding boxes of a replica and of its parts."""
    frames: dict[str, Floats] = {WHOLE: replica.bounds}
    for label in always:
        if label in replica.label_names and (bounds := bounds_of(replica, label)) is not None:
            frames[label] = bounds
    return frames


def _wider(source: str, procedure: str, space: ParameterSpace, misfits: Sequence[Misfit]) -> Iterator[Proposal]:
    ends = Counter(end for misfit in misfits for end in sorted(misfit.pressed(space)))
    least = max(2, 0.05 * len(misfits))
    common = [end for end, count in ends.most_common(8) if count >= least and _goes_on(space[end[0]], end[1])][:6]
    for chosen in dict.fromkeys([*((end,) for end in common), tuple(common)]):
        if not chosen:
            continue
        names = tuple(dict.fromkeys(name for name, _ in chosen))
        wide = {name: _long(space[name], {side for each, side in chosen if each == name}) for name in names}
        write = partial(_widened, source, procedure, space)
        try:
            write(wide)
        except EditError:
            continue
        members = [m for m in misfits if m.pressed(space) & set(chosen)]
        title = f"A wider Range of {_listed(names)}"
        starts: dict[int, Parameters] = {m.row: {} for m in members}
        yield Proposal("range", title, write, wide, starts, 0.6 * len(members) - 0.1 * len(chosen), ends=chosen)


def _goes_on(parameter: Parameter, side: str) -> bool:
    """Whether a Range has anywhere to go: one that starts at 0 does not start earlier."""
    low, high, _ = _long(parameter, {side})
    assert isinstance(parameter, Scalar | Integer)
    return low < parameter.low or high > parameter.high


def _widened(source: str, procedure: str, space: ParameterSpace, ranges: Ranges) -> str:
    for name, (low, high, _) in ranges.items():
        parameter = space[name]
        if isinstance(parameter, Integer):
            source = with_range(source, procedure, name, str(round(low)), str(round(high)), None)
        elif isinstance(parameter, Scalar):
            new = (
                number(low) if low < parameter.low else None,
                number(high) if high > parameter.high else None,
            )
            limits = (float(new[0] or parameter.low), float(new[1] or parameter.high))
            source = with_range(source, procedure, name, *new, _steps(parameter, *limits))
    return source


def _steps(parameter: Scalar, low: float, high: float) -> str | None:
    """As many steps as keep the old distance between them; listed ones with the new ends."""
    if isinstance(parameter.steps, int):
        apart = (parameter.high - parameter.low) / (parameter.steps - 1)
        return str(max(2, round((high - low) / apart) + 1))
    if parameter.steps is None:
        return None
    return f"({', '.join(f'{step:g}' for step in sorted({*parameter.steps, low, high}))})"


def _long(parameter: Parameter, sides: set[str]) -> tuple[float, float, float]:
    assert isinstance(parameter, Scalar | Integer)
    longer = parameter.widened()
    return (
        longer.low if "low" in sides else parameter.low,
        longer.high if "high" in sides else parameter.high,
        parameter.default,
    )


def _needed(
    parameter: Parameter, values: Sequence[float], wide: tuple[float, float, float]
) -> tuple[float, float, float]:
    """The old Range, as much longer as the values need with a margin, and no longer than the one that was tried."""
    assert isinstance(parameter, Scalar | Integer)
    low, high = min(values), max(values)
    margin = 0.03 * (high - low) if isinstance(parameter, Scalar) else 0.0
    return (
        max(_down(low - margin), wide[0]) if low < parameter.low else parameter.low,
        min(-_down(-high - margin), wide[1]) if high > parameter.high else parameter.high,
        parameter.default,
    )


def _down(value: float) -> float:
    """The next lower number of two digits."""
    if value == 0.0:
        return 0.0
    unit = 10.0 ** (np.floor(np.log10(abs(value))) - 1)
    return float(np.floor(value / unit + 1e-9) * unit)


def _around(
    values: Floats, whole: bool, wanted: Sequence[float], wide: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Low, high and default: the values and a margin, inside the wide range."""
    if whole:
        least, most = float(values.min()), float(values.max())
        alike = float(least == most)
        return max(1.0, least - alike), most + alike, float(np.median(values))
    low, high = (float(q) for q in np.quantile(values, [0.02, 0.98]))
    margin = 0.12 * (high - low) + 0.08 * max(abs(low), abs(high), 0.05)
    default = float(np.median(values)) if wide[2] != 1.0 else 1.0
    low, high = max(wide[0], low - margin), min(wide[1], high + margin)
    low, high = _down(min(low, default)), -_down(-max(high, default))
    return low, high, min(max(default, low), high)


def _rules(source: str, procedure: str, misfits: Sequence[Misfit], always: Sequence[str]) -> Iterator[Proposal]:
    pairs = [(misfit, hypothesis) for misfit in misfits for hypothesis in misfit.hypotheses]
    labels = list(dict.fromkeys(label for misfit in misfits for label in misfit.replica.label_names))
    for label in labels:
        bare = [(m, h) for m, h in pairs if not h.pieces]
        yield from _splays(source, procedure, [(m, h) for m, h in bare if h.splayed == (label,)], always)
        drawn = [(m, h) for m, h in bare if h.inset == (label,)]
        if drawn and label in always:
            scales, frames = [h.scale for _, h in drawn], [frames_of(m.replica, ()) for m, _ in drawn]
            rule = drawing_in(
                label, scales, frames, partial(free_name, source, procedure), f"The {label}, nearer to the middle."
            )
            ranges = {q.name: (0.3, 1.1, 1.0) for q in rule.quantities}
            yield _proposal("moved part", f"The {label} nearer to the middle", source, procedure, rule, ranges, drawn)
        gone = [(m, h) for m, h in bare if h.removed == (label,) and not h.inset and not h.splayed]
        if gone:
            rule = removal(label, partial(free_name, source, procedure))
            yield _proposal("part removed", f"Without the {label}", source, procedure, rule, {}, gone)
        for rest in (False, True):
            some = [(m, h) for m, h in pairs if h.pieces and label in h.removed and (h.inset == (REST,)) == rest]
            yield from _with_pieces(source, procedure, some, always, rest)
    added = [(m, h) for m, h in pairs if h.pieces and not h.removed]
    yield from _with_pieces(source, procedure, added, always, False)


def _splays(
    source: str, procedure: str, pairs: Sequence[tuple[Misfit, Hypothesis]], always: Sequence[str]
) -> Iterator[Proposal]:
    """Rules that splay a part, where others stay and where others go."""
    for removed in dict.fromkeys(h.removed for _, h in pairs):
        members = [(m, h) for m, h in pairs if h.removed == removed]
        (label,) = members[0][1].splayed
        instead = f", without the {_listed(removed)}" if removed else ""
        note = f"The {label} wider apart at the floor{instead}."
        scales, free = [h.scale for _, h in members], partial(free_name, source, procedure)
        rule = splaying(label, scales, removed, label in always, free, note)
        ranges = {q.name: (0.6, 2.5, 1.0 if not removed else float(np.median(q.values))) for q in rule.quantities}
        yield _proposal("moved part", f"The {label} splayed{instead}", source, procedure, rule, ranges, members)


def _with_pieces(
    source: str,
    procedure: str,
    pairs: Sequence[tuple[Misfit, Hypothesis]],
    always: Sequence[str],
    rest: bool,
) -> Iterator[Proposal]:
    """Rules for the pieces that are commonest among hypotheses that take the same part away, or none."""
    counts = Counter(key for _, h in pairs for key in dict.fromkeys(_form(piece) for piece in h.pieces))
    common = [key for key, count in counts.most_common(5) if count >= max(1, _SHARED * len(pairs))]
    chosen_sets = [tuple(common[:k]) for k in range(1, min(_MOST_PIECES, len(common)) + 1)]
    chosen_sets += [(key,) for key in common[1:]]
    wholes = Counter(tuple(dict.fromkeys(_form(piece) for piece in h.pieces)) for _, h in pairs)
    chosen_sets += [whole for whole, _ in wholes.most_common(3) if len(whole) <= _MOST_PIECES + 1]
    for chosen in {frozenset(chosen): chosen for chosen in reversed(chosen_sets)}.values():
        members = [(m, h) for m, h in pairs if set(chosen) <= {_form(piece) for piece in h.pieces}]
        if not members:
            continue
        several = [[_largest(h.pieces, key) for _, h in members] for key in chosen]
        removed = _removed(members)
        frames = [frames_of(m.replica, always) for m, _ in members]
        nouns = _listed([_article(noun(pieces)) for pieces in several])
        where = f" in place of the {_listed(removed)}" if removed else ""
        title = f"{nouns[0].upper()}{nouns[1:]}{where}{', the rest drawn in' if rest else ''}"
        inset = [h.scale[0] for _, h in members] if rest else None
        names = _labels(several, removed, members)
        rule = addition(several, frames, removed, inset, names, partial(free_name, source, procedure), f"{title}.")
        ranges = {q.name: _wide(np.array(q.values), q.whole) for q in rule.quantities}
        kind = "part replaced" if removed else "new part"
        yield _proposal(kind, title, source, procedure, rule, ranges, members, len(chosen))


def _form(piece: Piece) -> tuple[object, ...]:
    kind = next((word for word in ("slats", "spokes") if word in piece.kind), "")
    return (piece.kind if kind == "slats" else kind, piece.mirrored, () if kind == "spokes" else piece.thin)


def _largest(pieces: Sequence[Piece], form: tuple[object, ...]) -> Piece:
    return max((piece for piece in pieces if _form(piece) == form), key=lambda piece: float(np.prod(piece.size)))


def _removed(members: Sequence[tuple[Misfit, Hypothesis]]) -> list[str]:
    labels = dict.fromkeys(label for _, h in members for label in h.removed)
    having = {label: [h for m, h in members if label in m.replica.label_names] for label in labels}
    return [label for label in labels if np.mean([label in h.removed for h in having[label]]) >= _REMOVED]


def _labels(
    several: Sequence[Sequence[Piece]], removed: Sequence[str], members: Sequence[tuple[Misfit, Hypothesis]]
) -> list[str]:
    """The labels of new pieces: that of a removed part which they fill, else none yet."""
    names = []
    for pieces in several:
        filled = ""
        for label in removed:
            boxes = [frames_of(m.replica, [label]).get(label) for m, _ in members]
            near = [
                float(np.abs(np.stack([piece.low, piece.high]) - box).max()) < 0.1 * float(np.ptp(box, axis=0).max())
                for piece, box in zip(pieces, boxes, strict=True)
                if box is not None
            ]
            if near and np.mean(near) > 0.5:
                filled = label
        names.append(filled)
    return names


def _wide(values: Floats, whole: bool) -> tuple[float, float, float]:
    low, high = (float(q) for q in np.quantile(values, [0.05, 0.95]))
    middle = float(np.median(values))
    if whole:
        return max(1.0, low - 1), high + 2, middle
    spread = max(high - low, 0.3 * abs(middle), 0.04)
    low = low - 0.6 * spread if low < 0 else max(low - 0.6 * spread, 0.3 * low, 0.004)
    return low, high + 0.6 * spread, middle


def _proposal(
    kind: str,
    title: str,
    source: str,
    procedure: str,
    rule: Rule,
    ranges: Ranges,
    members: Sequence[tuple[Misfit, Hypothesis]],
    pieces: int = 1,
) -> Proposal:
    starts: dict[int, Parameters] = {}
    worth = 0.0
    for i, (misfit, hypothesis) in enumerate(members):
        starts[misfit.row] = {q.name: as_value(q.whole, q.values[i]) for q in rule.quantities}
        worth += float(np.clip(1.5 - hypothesis.cost / misfit.goal, 0.0, 1.0))
    return Proposal(
        kind,
        title,
        lambda chosen: with_rule(source, procedure, rule.spelled(chosen)),
        ranges,
        starts,
        worth + 0.05 * pieces,
        rule,
    )


def _article(word: str) -> str:
    return word if word.endswith("s") else f"a {word}"


def _listed(words: Sequence[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} and {words[-1]}"
