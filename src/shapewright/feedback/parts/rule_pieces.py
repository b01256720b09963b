"""Rules of the library that make what a replica lacks: retrieved by where it stands, and fitted to the reference."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any, TypeAlias

import numpy as np

from shapewright.comparison.surfaces import Samples, sample
from shapewright.feedback.parts.gallery import ASPECT, SAMPLES, Form, Gallery, form_of
from shapewright.feedback.parts.lack import Lack
from shapewright.feedback.parts.pieces import Kind, Piece
from shapewright.parameters import Integer, Scalar
from shapewright.rules.rule import Rule
from shapewright.shapes import Floats

# Where nothing else is said, chosen by eye on first versions of vessels and buildings.
_POINTS = 150  # of a piece's surface
_LEADING = 12  # rules that are drawn with other parameters than their defaults
_STEP = 0.15  # of a Range, by which a fit changes one parameter at a time
_SHIFT = 0.03  # of the whole's extent, by which it moves one side of the box
_SLACK, _SHARE = 0.03, 0.1  # how much less a rule may bring before it is fitted than a primitive, or this part of it
_LEAST = 0.01  # gain of a piece worth a hypothesis
_FLOOR, _UPPER = 0.1, 0.6  # of the whole's height: where what carries the rest begins, where what stands on it ends
_SIDE, _BODY = 0.2, 0.5  # of the whole's extent: where a part stands aside, how large a body is
_PRIMITIVES: tuple[Kind, ...] = ("box", "cylinder", "rod x", "rod z", "frustum", "foot", "sphere")

Gain: TypeAlias = tuple[float, Piece]
"""How much better all match with a piece, of 1, and the piece."""


def retrieved(lack: Lack, rules: Sequence[Rule], gallery: Gallery) -> dict[str, Gain]:
    """What rules bring in the box where they bring most, by their names; those that bring about as much as a primitive.

    All are drawn with their defaults; those that lead then also with other parameters.
    """
    boxes = lack.boxes()
    plain = max((_gain(replace(box, kind=kind), lack) for box in boxes for kind in _PRIMITIVES), default=0.0)
    best: dict[str, Gain] = {}
    for rule in rules:
        ways = [(box, turn) for box in boxes for turn in _turns(box, lack.bounds, rule)]
        pieces = [replace(box, kind="rule", rule=rule, turn=turn) for box, turn in ways]
        drawn = [one for piece in pieces for one in _sampled(piece, lack, gallery, range(1))]
        if drawn:
            best[rule.name] = max(drawn, key=_value)
    leading = sorted(best.items(), key=lambda item: -item[1][0])[:_LEADING]
    found = {name: max([one, *_sampled(one[1], lack, gallery, range(1, SAMPLES))], key=_value) for name, one in leading}
    least = max(_LEAST, plain - max(_SLACK, _SHARE * plain))
    return {name: one for name, one in found.items() if one[0] > least}


def fitted(start: Gain, lack: Lack) -> Gain:
    """The piece with numbers of its rule and sides of its box changed one at a time, where that brings more."""
    best = start[1]
    form = _form(best)
    if form is None:
        return start
    most = lack.gain(_placed(form, best))
    for changed in _changes(best, _SHIFT * lack.unit):
        for way in (1.0, -1.0):
            piece = changed(best, way)
            # What only stands elsewhere is stretched, which is ten times quicker than making it anew.
            other = None if piece is None else form if piece.arguments == best.arguments else _form(piece)
            if piece and other and (gain := lack.gain(_placed(other, piece))) > most:
                best, most, form = piece, gain, other
                break
    return most, best


def _sampled(piece: Piece, lack: Lack, gallery: Gallery, numbers: range) -> Iterator[Gain]:
    """The piece with some of its rule's sampled parameters, and what it brings."""
    assert piece.rule
    width, height, depth = _upright(piece)
    for number in numbers:
        if made := gallery.form(piece.rule, (_coarse(height / width), _coarse(depth / width)), number):
            arguments, form = made
            yield lack.gain(_placed(form, piece)), replace(piece, arguments=arguments)


def _form(piece: Piece) -> Form | None:
    """The surface of the piece's rule, as large as the piece; None where it cannot be made."""
    assert piece.rule
    return form_of(piece.rule, _upright(piece), piece.arguments)


def _upright(piece: Piece) -> Floats:
    """The size of the rule that fills the piece, before it is turned."""
    return np.asarray(piece.size[::-1] if piece.turn % 180.0 else piece.size)


def _coarse(ratio: float) -> int:
    """As a power of _ASPECT, -1 to 1."""
    return min(max(round(math.log(ratio, ASPECT)), -1), 1)


def _placed(form: Form, piece: Piece) -> Samples:
    """The surface of a rule, turned and stretched to fill the box of a piece, with its mirror images."""
    samples, turning = form.samples, _turning(piece.turn).T
    factors = piece.size / np.abs(form.size @ turning)
    normals = samples.normals @ turning / factors
    lengths = np.sqrt(np.square(normals).sum(axis=1))
    points, area = (
        samples.points @ turning * factors + piece.centre,
        samples.area * float(factors.prod() * lengths.mean()),
    )
    normals = normals / lengths[:, None]
    for axis, mirrored, middle in ((0, piece.mirrored[0], piece.middle[0]), (2, piece.mirrored[1], piece.middle[1])):
        if mirrored:
            flip, shift = np.ones(3), np.zeros(3)
            flip[axis], shift[axis] = -1.0, 2.0 * middle
            points = np.concatenate([points, points * flip + shift])
            normals, area = np.concatenate([normals, normals * flip]), 2.0 * area
    return Samples(points, np.zeros(len(points), dtype=np.int64), normals, area)


def _changes(piece: Piece, shift: float) -> Iterator[Any]:
    """Functions of a piece and a sign, each of which changes one thing; None where it cannot be changed so."""
    assert piece.rule
    for parameter in piece.rule.space:
        if isinstance(parameter, Scalar | Integer):
            yield lambda one, sign, parameter=parameter: _other(one, parameter, sign * _STEP)
    for end in ("low", "high"):
        for axis in range(3):
            yield lambda one, sign, end=end, axis=axis: _moved(one, end, axis, sign * shift)


def _other(piece: Piece, parameter: Scalar | Integer, by: float) -> Piece | None:
    """With another value of a parameter, by so much of its Range."""
    away = by * (parameter.high - parameter.low)
    if parameter.whole:
        away = math.copysign(max(round(abs(away)), 1), by)
    before = piece.arguments[parameter.name]
    value = min(max(before + away, parameter.low), parameter.high)
    value = round(value) if parameter.whole else value
    return None if value == before else replace(piece, arguments={**piece.arguments, parameter.name: value})


def _moved(piece: Piece, end: str, axis: int, by: float) -> Piece | None:
    """With one side of its box elsewhere."""
    side = getattr(piece, end).copy()
    side[axis] += by
    moved = replace(piece, **{end: side})
    if (moved.high - moved.low).min() <= 0.0:
        return None
    if axis != 1 and piece.mirrored[axis // 2] and moved.low[axis] < piece.middle[axis // 2]:
        return None
    return moved


def _gain(piece: Piece, lack: Lack) -> float:
    try:
        return lack.gain(sample(piece.mesh(), _POINTS))
    except ValueError:
        return -math.inf


def _value(gain: Gain) -> float:
    return gain[0]


def _turning(degrees: float) -> Floats:
    """The matrix of a turn about y by quarter turns."""
    cos, sin = round(math.cos(math.radians(degrees))), round(math.sin(math.radians(degrees)))
    return np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])


def _turns(box: Piece, bounds: Floats, rule: Rule) -> tuple[float, ...]:
    """Degrees by which a rule may be turned to fill the box; none where such a part does not stand there."""
    extent = np.ptp(bounds, axis=0)
    low, high = (box.low - bounds[0]) / extent, (box.high - bounds[0]) / extent
    aside = (low + high) / 2.0 - 0.5
    ways = (0.0, 90.0, 180.0, 270.0)[: rule.turns]
    right, left, front, back = (0.0, 180.0, 270.0, 90.0) if rule.stance == "beside" else (90.0, 270.0, 0.0, 180.0)
    match rule.stance:
        case "under":
            return ways if low[1] < _FLOOR else ()
        case "on":
            return ways if low[1] > _FLOOR and high[1] > _UPPER else ()
        case "body":
            return ways if (box.size / extent).min() > _BODY else ()
        case "beside" | "front":
            if np.abs(aside[[0, 2]]).max() < _SIDE:
                return ()
            if abs(aside[0]) > abs(aside[2]):
                return (right,) if aside[0] > 0.0 else (left,)
            return (front,) if aside[2] > 0.0 else (back,)
        case "within":
            return ways if low[1] > _FLOOR or (box.size / extent).min() > _BODY else ()
        case "around":
            return ways if (box.size / extent)[[0, 2]].min() > _BODY else ()
        case "back":
            wide = box.size[0] > box.size[2]
            return (0.0 if wide else 90.0,) if box.size[1] > box.size[2 if wide else 0] else ()
    return ways
