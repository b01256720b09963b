"""Changes of a procedure that misfits share: wider Ranges, and rules for what hypotheses about them have in common."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from shapewright.feedback.ideas.hypothesis import ALL_OTHERS, Hypothesis
from shapewright.feedback.ideas.needed_ranges import generous
from shapewright.feedback.ideas.proposal import Interval, Misfit, Proposal, Ranges, as_value, listed
from shapewright.feedback.ideas.wider_ranges import wider_ranges
from shapewright.feedback.parts.pieces import Piece
from shapewright.feedback.parts.relations import WHOLE, Frames
from shapewright.feedback.parts.supports import bounds_of
from shapewright.feedback.writing.change import FileChange
from shapewright.feedback.writing.piece_code import Quantity, noun
from shapewright.feedback.writing.rule_code import RuleDraft, addition, drawing_in, removal, splaying
from shapewright.feedback.writing.source import free_name
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.shapes import Floats, Mesh

Wanted = Sequence[tuple[Misfit, Hypothesis]]
"""Misfits, each with a hypothesis that a rule has to make true."""
# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_REMOVED = 0.4  # share of the misfits whose replica has the part, from which on the rule takes it away
_MOST_PIECES = 3  # of a rule, that are commonest; one more where hypotheses agree on the whole
_COMMON, _WHOLES = 5, 3  # forms of pieces, and whole sets of pieces, that are looked at
_SHARED = 0.25  # share of the hypotheses that a piece is in, from which on a rule makes it
_FILLS = 0.1  # of a removed part's largest extent: how near the sides of a piece are that takes its place
_FILLED = 0.5  # of a rule's piece and a part: intersection over union along an axis, from which on they are one there
_INSET, _SPLAY = (0.3, 1.1), (0.6, 2.5)  # Ranges of factors to begin with


def proposals(
    source: str, procedure: str, space: ParameterSpace, misfits: Sequence[Misfit], always: Sequence[str]
) -> list[Proposal]:
    """All changes worth trying, the most promising first. always: labels that every shape of the procedure has."""
    made = [*wider_ranges(source, procedure, space, misfits), *_rules(source, procedure, misfits, always)]
    unique = {(one.kind, one.title, tuple(sorted(one.starts))): one for one in reversed(made)}
    return sorted(unique.values(), key=lambda one: -one.worth)


def frames_of(replica: Mesh, always: Sequence[str]) -> Frames:
    """The bounding boxes of a replica and of its parts."""
    frames: dict[str, Floats] = {WHOLE: replica.bounds}
    for label in always:
        if label in replica.label_names and (bounds := bounds_of(replica, label)) is not None:
            frames[label] = bounds
    return frames


def _rules(source: str, procedure: str, misfits: Sequence[Misfit], always: Sequence[str]) -> Iterator[Proposal]:
    pairs = [(misfit, hypothesis) for misfit in misfits for hypothesis in misfit.hypotheses]
    free = partial(free_name, source, procedure)
    for label in dict.fromkeys(label for misfit in misfits for label in misfit.replica.label_names):
        bare = [(m, h) for m, h in pairs if not h.pieces]
        yield from _splays(source, procedure, [(m, h) for m, h in bare if h.splayed == (label,)], always)
        inwards = [(m, h) for m, h in bare if h.inset == (label,)]
        if inwards and label in always:
            scales, frames = [h.scale for _, h in inwards], [frames_of(m.replica, ()) for m, _ in inwards]
            rule = drawing_in(label, scales, frames, free, f"The {label}, nearer to the middle.")
            ranges = {q.name: (*_INSET, 1.0) for q in rule.quantities}
            yield _proposal("moved part", f"The {label} nearer to the middle", source, procedure, rule, ranges, inwards)
        without = [(m, h) for m, h in bare if h.removed == (label,) and not h.inset and not h.splayed]
        if without:
            rule = removal(label, free)
            yield _proposal("part removed", f"Without the {label}", source, procedure, rule, {}, without)
        for drawn_in in (False, True):
            others = [(m, h) for m, h in pairs if (h.inset == (ALL_OTHERS,)) == drawn_in]
            replaced = [(m, h) for m, h in others if h.pieces and label in h.removed]
            yield from _with_pieces(source, procedure, replaced, always, drawn_in)
    added = [(m, h) for m, h in pairs if h.pieces and not h.removed]
    yield from _with_pieces(source, procedure, added, always, False)


def _splays(source: str, procedure: str, pairs: Wanted, always: Sequence[str]) -> Iterator[Proposal]:
    """Rules that splay a part, where others stay and where others go."""
    for removed in dict.fromkeys(h.removed for _, h in pairs):
        members = [(m, h) for m, h in pairs if h.removed == removed]
        (label,) = members[0][1].splayed
        instead = f", without the {listed(removed)}" if removed else ""
        note = f"The {label} wider apart at the floor{instead}."
        scales, free = [h.scale for _, h in members], partial(free_name, source, procedure)
        rule = splaying(label, scales, removed, label in always, free, note)
        ranges = {q.name: (*_SPLAY, 1.0 if not removed else float(np.median(q.values))) for q in rule.quantities}
        yield _proposal("moved part", f"The {label} splayed{instead}", source, procedure, rule, ranges, members)


def _with_pieces(
    source: str, procedure: str, pairs: Wanted, always: Sequence[str], drawn_in: bool
) -> Iterator[Proposal]:
    """Rules for the pieces that are commonest among hypotheses that take the same part away, or none."""
    counts = Counter(key for _, h in pairs for key in dict.fromkeys(_form(piece) for piece in h.pieces))
    common = [key for key, count in counts.most_common(_COMMON) if count >= max(1, _SHARED * len(pairs))]
    chosen_sets = [tuple(common[:k]) for k in range(1, min(_MOST_PIECES, len(common)) + 1)]
    chosen_sets += [(key,) for key in common[1:]]
    wholes = Counter(tuple(dict.fromkeys(_form(piece) for piece in h.pieces)) for _, h in pairs)
    chosen_sets += [whole for whole, _ in wholes.most_common(_WHOLES) if len(whole) <= _MOST_PIECES + 1]
    for chosen in {frozenset(chosen): chosen for chosen in reversed(chosen_sets)}.values():
        members = [(m, h) for m, h in pairs if set(chosen) <= {_form(piece) for piece in h.pieces}]
        if not members:
            continue
        several = [[_largest(h.pieces, key) for _, h in members] for key in chosen]
        removed = _removed(members)
        frames = [frames_of(m.replica, always) for m, _ in members]
        words = [noun(pieces) for pieces in several]
        nouns = listed([word if word.endswith("s") else f"a {word}" for word in words])
        where = f" in place of the {listed(removed)}" if removed else ""
        title = f"{nouns[0].upper()}{nouns[1:]}{where}{', the rest drawn in' if drawn_in else ''}"
        inset = [h.scale[0] for _, h in members] if drawn_in else None
        several = [_in_place(pieces, removed, members) for pieces in several]
        names = _labels(several, removed, members)
        rule = addition(several, frames, removed, inset, names, partial(free_name, source, procedure), f"{title}.")
        ranges = {q.name: _range(q) for q in rule.quantities}
        kind = "part replaced" if removed else "new part"
        yield _proposal(kind, title, source, procedure, rule, ranges, members, len(chosen))


def _range(quantity: Quantity) -> Interval:
    """A Range to begin with: that of the library's rule, or a generous one around what the misfits need."""
    values = np.array(quantity.values)
    return (*quantity.limits, float(np.median(values))) if quantity.limits else generous(values, quantity.whole)


def _in_place(pieces: Sequence[Piece], removed: Sequence[str], members: Wanted) -> list[Piece]:
    """The pieces of a library's rule as long as the part in whose place they come, along axes where most nearly are.

    The author's own parameters say then how large they are, and they touch what the part touched.
    """
    boxes = [frames_of(m.replica, removed[:1]).get(removed[0]) if removed else None for m, _ in members]
    if not pieces[0].rule or any(pieces[0].mirrored) or any(box is None for box in boxes):
        return list(pieces)
    spans = np.array([[piece.low, piece.high] for piece in pieces])
    others = np.array([box for box in boxes if box is not None])
    common = np.minimum(spans[:, 1], others[:, 1]) - np.maximum(spans[:, 0], others[:, 0])
    shared = common / (np.maximum(spans[:, 1], others[:, 1]) - np.minimum(spans[:, 0], others[:, 0]))
    alike = np.median(shared, axis=0) > _FILLED
    placed = np.where(alike, others, spans)
    return [replace(piece, low=low, high=high) for piece, (low, high) in zip(pieces, placed, strict=True)]


def _form(piece: Piece) -> tuple[object, ...]:
    if piece.rule:
        return piece.key
    kind = next((word for word in ("slats", "spokes") if word in piece.kind), "")
    return (piece.kind if kind == "slats" else kind, piece.mirrored, () if kind == "spokes" else piece.thin)


def _largest(pieces: Sequence[Piece], form: tuple[object, ...]) -> Piece:
    return max((piece for piece in pieces if _form(piece) == form), key=lambda piece: float(np.prod(piece.size)))


def _removed(members: Wanted) -> list[str]:
    labels = dict.fromkeys(label for _, h in members for label in h.removed)
    having = {label: [h for m, h in members if label in m.replica.label_names] for label in labels}
    return [label for label in labels if np.mean([label in h.removed for h in having[label]]) >= _REMOVED]


def _labels(several: Sequence[Sequence[Piece]], removed: Sequence[str], members: Wanted) -> list[str]:
    """The labels of new pieces: that of a removed part which they fill, else none yet."""
    names = []
    for pieces in several:
        filled = ""
        for label in removed:
            boxes = [frames_of(m.replica, [label]).get(label) for m, _ in members]
            near = [
                float(np.abs(np.stack([piece.low, piece.high]) - box).max()) < _FILLS * float(np.ptp(box, axis=0).max())
                for piece, box in zip(pieces, boxes, strict=True)
                if box is not None
            ]
            if near and np.mean(near) > 0.5:
                filled = label
        names.append(filled)
    return names


def _proposal(
    kind: str,
    title: str,
    source: str,
    procedure: str,
    rule: RuleDraft,
    ranges: Ranges,
    members: Wanted,
    pieces: int = 1,
) -> Proposal:
    starts: dict[int, Parameters] = {}
    worth = 0.0
    for i, (misfit, hypothesis) in enumerate(members):
        starts[misfit.row] = {q.name: as_value(q.whole, q.values[i]) for q in rule.quantities}
        saved = 1.0 - hypothesis.cost / hypothesis.before
        worth += float(np.clip(max(1.5 - hypothesis.cost / misfit.goal, saved), 0.0, 1.0))

    def change(chosen: Ranges) -> FileChange:
        return FileChange(procedure, rule=rule.spelled(chosen))

    return Proposal(kind, title, source, change, ranges, starts, worth + 0.05 * pieces, rule)
