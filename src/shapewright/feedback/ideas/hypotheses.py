"""What would turn a replica into its reference: parts taken away, moved, or put in place; tried on the mesh alone.

A hypothesis about one misfit is cheap to judge, since no procedure runs. Those that misfits share become rules.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.feedback.parts.around import COUNTS, turns
from shapewright.feedback.parts.attachment import loose
from shapewright.feedback.parts.decomposition import decompose
from shapewright.feedback.parts.pieces import Kind, Piece
from shapewright.feedback.parts.supports import bounds_of, splayed, supports
from shapewright.feedback.surfaces.interior import filled
from shapewright.feedback.surfaces.residuals import NEAR, Residuals
from shapewright.shapes import Floats, Mesh, concatenate

Costs = Callable[[Sequence[Mesh]], Sequence[float]]
"""Costs of meshes as replicas of one reference, by the measure to search by."""

REST = "*"
"""Stands for all parts but those that are removed."""
_SURPLUS = 0.5  # share of a part's visible surface that is surplus, from which on it may have to go
_BETTER = 0.88  # of the replica's cost, that a hypothesis must stay below
_PLAIN, _FANCY = 0.985, 0.93  # of the cost of a box, below which a plain other form is taken, or a fancy one
_PRICE = 220.0  # cost that each part taken away and each piece must save
_LOOSE = 1500.0  # the same of each piece that hangs in the air
_OVERLAP = 0.2
_EVEN = 0.93
_BREADTH = 0.1
_INSETS = (0.62, 0.71, 0.82, 0.91)
_SPLAY, _SPLAYS = 1.4, (0.7, 1.2, 1.7, 2.1)


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """A change of a replica. removed: labels of parts; inset: those drawn towards the middle along x and z, by factors
    scale; splayed: those drawn so at their low end only; pieces: what is put in, in the replica's units. cost: of the
    changed replica; before: of the replica. loose: number of the pieces that hang in the air.
    """

    removed: tuple[str, ...] = ()
    inset: tuple[str, ...] = ()
    splayed: tuple[str, ...] = ()
    scale: tuple[float, float] = (1.0, 1.0)
    pieces: tuple[Piece, ...] = ()
    cost: float = np.inf
    before: float = np.inf
    loose: int = 0

    @property
    def score(self) -> float:
        """The cost, and what the change itself costs: simple changes suit more references."""
        changes = len(self.removed) + len(self.pieces) + len(self.inset) + len(self.splayed)
        return self.cost + _PRICE * changes + _LOOSE * self.loose

    @property
    def key(self) -> tuple[object, ...]:
        """Equal for hypotheses that call for the same rule."""
        return (self.removed, self.inset, self.splayed, tuple(sorted((piece.key for piece in self.pieces), key=str)))


def applied(hypothesis: Hypothesis, replica: Mesh) -> Mesh:
    """The changed replica, as a soup of its visible faces and the new pieces."""
    return concatenate([*_standing(hypothesis, replica), *(piece.mesh() for piece in hypothesis.pieces)] or [replica])


def _standing(hypothesis: Hypothesis, replica: Mesh) -> list[Mesh]:
    """What stays of the replica: the parts that keep their place, those drawn in, and those splayed."""
    names = np.array([*replica.label_names, ""], dtype=object)
    labels = names[replica.face_labels] if replica.face_labels is not None else np.full(len(replica.faces), "")
    kept = ~np.isin(labels, hypothesis.removed)
    drawn = np.ones(len(labels), dtype=bool) if hypothesis.inset == (REST,) else np.isin(labels, hypothesis.inset)
    middle = replica.bounds.mean(axis=0)
    factors = np.array([hypothesis.scale[0], 1.0, hypothesis.scale[1]])
    leans = [labels == label for label in hypothesis.splayed]
    stays = ~np.any([drawn, *leans], axis=0)
    parts = [
        Mesh(replica.vertices, replica.faces[kept & stays]),
        Mesh((replica.vertices - middle) * factors + middle, replica.faces[kept & drawn]),
        *(splayed(Mesh(replica.vertices, replica.faces[faces]), factors) for faces in leans if faces.any()),
    ]
    return [part for part in parts if len(part.faces)]


def hypotheses(found: Residuals, reference: Mesh, replica: Mesh, costs: Costs) -> list[Hypothesis]:
    """Changes that bring the replica nearer to its reference, the best first; none where nothing helps much."""
    (before,) = costs([replica])
    blank = Hypothesis(before=before)
    tried = _priced([*_simple(replica, blank)], replica, costs)
    tried += _priced([*_further(tried, blank)], replica, costs)
    tried += _priced([*_other_splays(tried, blank)], replica, costs)
    best = min(tried, key=lambda each: each.cost, default=blank)
    if any(piece.kind == "spokes" for piece in best.pieces):
        tried.append(_shaped(best, replica, costs))
    for removed, radial in product(dict.fromkeys([(), _surplus(found, replica)]), (False, True)):
        pieces = _pieces(found, reference, replica, removed, radial)
        if pieces:
            whole = replace(blank, removed=removed, pieces=pieces)
            (whole,) = _priced([whole], replica, costs)
            if whole.cost < _BETTER * before * 1.15:
                tried.append(_shaped(_pruned(whole, replica, costs), replica, costs))
    if best.removed and best.pieces:  # another form of a part: what is left of the misfit may be where the rest stands
        tried += _priced(
            [replace(best, inset=(REST,), scale=(s, s), cost=np.inf) for s in _INSETS if not best.inset], replica, costs
        )
    good = sorted((each for each in tried if each.cost < _BETTER * before), key=lambda each: each.score)
    unique = {each.key: each for each in reversed(good)}
    return sorted(unique.values(), key=lambda each: each.score)


def _simple(replica: Mesh, blank: Hypothesis) -> Iterator[Hypothesis]:
    """Each part taken away, in another form, or drawn in."""
    s = _INSETS[-2]
    upright = supports(replica)
    for label in replica.label_names:
        bounds = bounds_of(replica, label)
        if bounds is None:
            continue
        if len(replica.label_names) > 1:
            yield replace(blank, removed=(label,))
            yield from (replace(blank, inset=(label,), scale=scale) for scale in _scales(s))
            if label in upright:
                yield from (replace(blank, splayed=(label,), scale=scale) for scale in _scales(_SPLAY))
        middle = (float(bounds[:, 0].mean()), float(bounds[:, 2].mean()))
        for kind in ("cylinder", "box"):
            yield replace(blank, removed=(label,), pieces=(Piece(kind, bounds[0], bounds[1], middle=middle),))
        yield from (replace(blank, removed=(label,), pieces=(piece,)) for piece in _radial(bounds, middle))


def _scales(s: float) -> Iterator[tuple[float, float]]:
    yield from ((s, s), (s, 1.0), (1.0, s))


def _further(tried: Sequence[Hypothesis], blank: Hypothesis) -> Iterator[Hypothesis]:
    """What helps drawn in further, and less far; each part in its better form with the rest drawn in; parts splayed
    where another is gone."""
    insets = [each for each in tried if each.inset and each.cost < blank.before]
    for each in _best_of_each(insets, lambda each: each.inset):
        for s in _INSETS:
            scale = _scaled(each.scale, s)
            if scale != each.scale:
                yield replace(blank, inset=each.inset, scale=scale)
    gone = [each for each in tried if each.removed and not each.pieces and each.cost < blank.before]
    if gone:
        least = min(gone, key=lambda each: each.cost)
        for part in dict.fromkeys(each.splayed for each in tried if each.splayed):
            if part != least.removed:
                yield from (replace(least, splayed=part, scale=scale, cost=np.inf) for scale in _scales(_SPLAY))
    forms = [each for each in tried if each.pieces and each.pieces[0].kind != "spokes"]
    several = len({each.removed for each in forms}) > 1
    for each in _best_of_each(forms, lambda each: each.removed) if several else ():
        yield from (replace(each, inset=(REST,), scale=(s, s), cost=np.inf) for s in _INSETS[::2])


def _other_splays(tried: Sequence[Hypothesis], blank: Hypothesis) -> Iterator[Hypothesis]:
    """Other factors of the best splayed part, and of the best where another part is gone."""
    helpful = [each for each in tried if each.splayed and each.cost < blank.before]
    for each in _best_of_each(helpful, lambda each: bool(each.removed)):
        yield from (replace(each, scale=_scaled(each.scale, s), cost=np.inf) for s in _SPLAYS)


def _scaled(scale: tuple[float, float], s: float) -> tuple[float, float]:
    """The same, with another factor along the axes that have one."""
    return (s if scale[0] != 1.0 else 1.0, s if scale[1] != 1.0 else 1.0)


def _best_of_each(several: Sequence[Hypothesis], key: Callable[[Hypothesis], object]) -> list[Hypothesis]:
    """The hypothesis of least cost for each value of a key."""
    return list({key(each): each for each in sorted(several, key=lambda each: -each.cost)}.values())


def _radial(bounds: Floats, middle: tuple[float, float]) -> Iterator[Piece]:
    """Bars around the middle in place of a part that is flat and about as wide as deep."""
    width, height, depth = np.maximum(np.ptp(bounds, axis=0), 1e-6)
    if 0.5 < width / depth < 2.0 and height < 0.5 * max(width, depth):
        for count in COUNTS:
            for turn in turns(count):
                yield Piece("spokes", bounds[0], bounds[1], middle=middle, count=count, breadth=_BREADTH, turn=turn)


def _surplus(found: Residuals, replica: Mesh) -> tuple[str, ...]:
    """Labels of the parts that the reference seems not to have."""
    if replica.face_labels is None:
        return ()
    seen = found.replica.visible
    labels = replica.face_labels[found.replica.faces[seen]]
    far = found.to_reference[seen] > NEAR
    return tuple(
        name
        for i, name in enumerate(replica.label_names)
        if (labels == i).sum() > 8 and far[labels == i].mean() > _SURPLUS
    )


def _pieces(
    found: Residuals, reference: Mesh, replica: Mesh, removed: tuple[str, ...], radial: bool
) -> tuple[Piece, ...]:
    """What of the reference is not explained by the parts that stay, as boxes in the replica's units."""
    far: NDArray[np.bool_] = found.to_replica > NEAR
    if removed and replica.face_labels is not None:
        gone = [replica.label_names.index(name) for name in removed]
        stays = ~np.isin(replica.face_labels[found.replica.faces], gone)
        if stays.any():
            distance, _ = cKDTree(found.replica.points[stays]).query(found.reference.points)
            far = distance > NEAR + found.replica.spacing
    surface = found.reference.points[found.reference.visible & far]
    points = found.placement.invert(filled(reference, surface) if len(surface) else surface)
    middle = replica.bounds.mean(axis=0)
    for axis in (0, 2):  # two symmetric shapes stand middle on middle, wherever their surfaces have most in common
        if _even(found.reference.points, 0.0, axis) and _even(replica.vertices, middle[axis], axis):
            points[:, axis] += middle[axis] - found.placement.invert(np.zeros(3))[axis]
    return decompose(points, (float(middle[0]), float(middle[2])), 1.0 / found.placement.scale, radial)


def _even(points: Floats, middle: float, axis: int) -> bool:
    """Whether points are the same on both sides of a plane across an axis, all but a few."""
    image = points.copy()
    image[:, axis] = 2.0 * middle - image[:, axis]
    distance, _ = cKDTree(points).query(image[:: max(1, len(image) // 400)])
    return bool((distance < 0.05 * np.ptp(points, axis=0).max()).mean() > _EVEN)


def _pruned(hypothesis: Hypothesis, replica: Mesh, costs: Costs) -> Hypothesis:
    """The hypothesis without what it does not need: one piece or one removal less at a time, by the score."""
    while True:
        shorter = [replace(hypothesis, pieces=_less(hypothesis.pieces, i)) for i in range(len(hypothesis.pieces))]
        for label in hypothesis.removed:
            bounds = bounds_of(replica, label)
            kept = tuple(p for p in hypothesis.pieces if bounds is None or _overlap(p, bounds) < _OVERLAP)
            shorter.append(replace(hypothesis, removed=tuple(r for r in hypothesis.removed if r != label), pieces=kept))
        shorter = [each for each in shorter if each.pieces or each.removed]
        least = min(_priced(shorter, replica, costs), key=lambda each: each.score, default=hypothesis)
        if least.score >= hypothesis.score:
            return hypothesis
        hypothesis = least


def _less(pieces: tuple[Piece, ...], i: int) -> tuple[Piece, ...]:
    return (*pieces[:i], *pieces[i + 1 :])


def _overlap(piece: Piece, bounds: Floats) -> float:
    """Intersection over union of a piece's box, with its mirror images, and a part's."""
    low, high = piece.low.copy(), piece.high.copy()
    for axis, mirrored, middle in ((0, piece.mirrored[0], piece.middle[0]), (2, piece.mirrored[1], piece.middle[1])):
        if mirrored:
            low[axis] = 2 * middle - high[axis]
    margin = 0.02 * np.ptp(bounds, axis=0).max()
    common = np.prod(np.maximum(np.minimum(high, bounds[1]) - np.maximum(low, bounds[0]) + margin, 0.0))
    return float(common / (np.prod(high - low + margin) + np.prod(np.ptp(bounds, axis=0) + margin) - common))


def _shaped(hypothesis: Hypothesis, replica: Mesh, costs: Costs) -> Hypothesis:
    """The hypothesis with each piece in the form that suits best."""
    for i, piece in enumerate(hypothesis.pieces):
        if piece.kind not in ("box", "spokes"):
            continue
        forms = [
            replace(hypothesis, pieces=(*hypothesis.pieces[:i], replace(piece, kind=kind), *hypothesis.pieces[i + 1 :]))
            for kind in _forms(piece)
        ]
        priced = _priced(forms, replica, costs)
        fit = [each for each in priced if each.cost < _share(each.pieces[i].kind) * hypothesis.cost]
        hypothesis = min(fit, key=lambda each: each.cost / _share(each.pieces[i].kind), default=hypothesis)
    return hypothesis


def _share(kind: Kind) -> float:
    return _FANCY if kind in ("frustum", "foot", "sphere", "sloping spokes") else _PLAIN


def _forms(piece: Piece) -> tuple[Kind, ...]:
    if piece.kind == "spokes":
        return ("sloping spokes",)
    width, height, depth = piece.size
    if 0.7 < width / depth < 1.4:
        if 0.7 < height / width < 1.4:
            return ("cylinder", "frustum", "foot", "sphere")
        return ("cylinder", "frustum", "foot") if height > 0.2 * width else ("cylinder",)
    if 0.7 < height / depth < 1.4 and width > depth:
        return ("rod x",)
    return ("rod z",) if 0.7 < height / width < 1.4 and depth > width else ("cylinder",)


def _priced(several: Sequence[Hypothesis], replica: Mesh, costs: Costs) -> list[Hypothesis]:
    prices = costs([applied(each, replica) for each in several])
    return [
        replace(each, cost=float(price), loose=_loose(each, replica) if price < each.before else 0)
        for each, price in zip(several, prices, strict=True)
    ]


def _loose(hypothesis: Hypothesis, replica: Mesh) -> int:
    return loose(hypothesis.pieces, _standing(hypothesis, replica)) if hypothesis.pieces else 0
