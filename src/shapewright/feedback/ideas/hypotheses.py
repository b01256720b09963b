"""What would turn a replica into its reference: parts taken away, moved, or put in place; tried on the mesh alone.

A hypothesis about one misfit is cheap to judge, since no procedure runs. Those that misfits share become rules.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from shapewright.feedback.ideas.hypothesis import ALL_OTHERS, Costs, Hypothesis, priced
from shapewright.feedback.parts.around import COUNTS, turns
from shapewright.feedback.parts.decomposition import decompose
from shapewright.feedback.parts.pieces import Kind, Piece
from shapewright.feedback.parts.supports import bounds_of, supports
from shapewright.feedback.surfaces.residuals import NEAR, Residuals
from shapewright.feedback.surfaces.visible_surface import filled
from shapewright.shapes import Floats, Mesh

# Where nothing else is said, chosen on seed 0 of benchmarks/suggestions.py.
_SURPLUS = 0.5  # share of a part's visible surface that is surplus, from which on it may have to go
_FEWEST = 8  # points on a part that tell whether it is surplus
_BETTER = 0.88  # of the replica's cost, that a hypothesis must stay below
_HOPEFUL = 1.15  # of that, before pieces are pruned and shaped
_PLAIN, _FANCY = 0.985, 0.93  # of the cost of a box, below which a plain other form is taken, or a fancy one
_FANCIES = ("frustum", "foot", "sphere", "sloping spokes")
_OVERLAP = 0.2  # of a piece with a removed part, from which on it takes its place
_EVEN = 0.93  # share of the points that have a mirror image, from which on a shape is symmetric
_BREADTH = 0.1  # of spokes, of the whole
_INSETS = (0.62, 0.71, 0.82, 0.91)  # factors; so are those of splays
_INSET, _SPLAY, _SPLAYS = _INSETS[-2], 1.4, (0.7, 1.2, 1.7, 2.1)
_ROUND = 2.0 / math.sqrt(math.pi)  # width of a round plan, of a square one's with the same area
_PLANS: tuple[tuple[Kind, float], ...] = (("cylinder", _ROUND), ("box", 1.0 / _ROUND))
_SQUARE = 0.7, 1.4  # ratios of two sides that may be a diameter
_FLAT = 0.2  # ratio of height to width up to which a cylinder is a disc


def hypotheses(differences: Residuals, reference: Mesh, replica: Mesh, costs: Costs) -> list[Hypothesis]:
    """Changes that bring the replica nearer to its reference, the best first; none where nothing helps much.

    differences: of the replica from the reference.
    """
    (before,) = costs([replica])
    blank = Hypothesis(before=before)
    candidates = priced([*_simple(replica, blank)], replica, costs)
    candidates += priced([*_further(candidates, blank)], replica, costs)
    candidates += priced([*_other_splays(candidates, blank)], replica, costs)
    best = min(candidates, key=lambda h: h.cost, default=blank)
    if any(piece.kind == "spokes" for piece in best.pieces):
        candidates.append(_shaped(best, replica, costs))
    for removed, radial in product(dict.fromkeys([(), _surplus(differences, replica)]), (False, True)):
        pieces = _pieces(differences, reference, replica, removed, radial)
        if pieces:
            (whole,) = priced([replace(blank, removed=removed, pieces=pieces)], replica, costs)
            if whole.cost < _BETTER * before * _HOPEFUL:
                candidates.append(_shaped(_pruned(whole, replica, costs), replica, costs))
    if best.removed and best.pieces:  # a part has another form: what else differs may be where all other parts stand
        insets = [replace(best, inset=(ALL_OTHERS,), scale=(s, s), cost=np.inf) for s in _INSETS if not best.inset]
        candidates += priced(insets, replica, costs)
    good = sorted((h for h in candidates if h.cost < _BETTER * before), key=lambda h: h.score)
    unique = {h.key: h for h in reversed(good)}
    return sorted(unique.values(), key=lambda h: h.score)


def _simple(replica: Mesh, blank: Hypothesis) -> Iterator[Hypothesis]:
    """Each part taken away, in another form, or drawn in."""
    upright = supports(replica)
    for label in replica.label_names:
        bounds = bounds_of(replica, label)
        if bounds is None:
            continue
        if len(replica.label_names) > 1:
            yield replace(blank, removed=(label,))
            yield from (replace(blank, inset=(label,), scale=scale) for scale in _scales(_INSET))
            if label in upright:
                yield from (replace(blank, splayed=(label,), scale=scale) for scale in _scales(_SPLAY))
        middle = (float(bounds[:, 0].mean()), float(bounds[:, 2].mean()))
        for kind, equal in _PLANS:
            for low, high in (bounds, _across(bounds, equal)):
                yield replace(blank, removed=(label,), pieces=(Piece(kind, low, high, middle=middle),))
        yield from (replace(blank, removed=(label,), pieces=(piece,)) for piece in _radial(bounds, middle))


def _across(bounds: Floats, factor: float) -> Floats:
    """Bounds that are so many times as wide and as deep."""
    middle = bounds.mean(axis=0)
    return np.asarray(middle + (bounds - middle) * (factor, 1.0, factor))


def _scales(s: float) -> Iterator[tuple[float, float]]:
    yield from ((s, s), (s, 1.0), (1.0, s))


def _further(candidates: Sequence[Hypothesis], blank: Hypothesis) -> Iterator[Hypothesis]:
    """What helps drawn in further, and less far; each part in its better form with all others drawn in; parts splayed
    where another is taken away."""
    insets = [h for h in candidates if h.inset and h.cost < blank.before]
    for h in _best_by(insets, lambda h: h.inset):
        for s in _INSETS:
            scale = _scaled(h.scale, s)
            if scale != h.scale:
                yield replace(blank, inset=h.inset, scale=scale)
    without = [h for h in candidates if h.removed and not h.pieces and h.cost < blank.before]
    if without:
        least = min(without, key=lambda h: h.cost)
        for part in dict.fromkeys(h.splayed for h in candidates if h.splayed):
            if part != least.removed:
                yield from (replace(least, splayed=part, scale=scale, cost=np.inf) for scale in _scales(_SPLAY))
    forms = [h for h in candidates if h.pieces and h.pieces[0].kind != "spokes"]
    several = len({h.removed for h in forms}) > 1
    for h in _best_by(forms, lambda h: h.removed) if several else ():
        yield from (replace(h, inset=(ALL_OTHERS,), scale=(s, s), cost=np.inf) for s in _INSETS[::2])


def _other_splays(candidates: Sequence[Hypothesis], blank: Hypothesis) -> Iterator[Hypothesis]:
    """Other factors of the best splayed part, and of the best where another part is taken away."""
    helpful = [h for h in candidates if h.splayed and h.cost < blank.before]
    for h in _best_by(helpful, lambda h: bool(h.removed)):
        yield from (replace(h, scale=_scaled(h.scale, s), cost=np.inf) for s in _SPLAYS)


def _scaled(scale: tuple[float, float], s: float) -> tuple[float, float]:
    """The same, with another factor along the axes that have one."""
    return (s if scale[0] != 1.0 else 1.0, s if scale[1] != 1.0 else 1.0)


def _best_by(several: Sequence[Hypothesis], key: Callable[[Hypothesis], object]) -> list[Hypothesis]:
    """The hypothesis of least cost for each value of a key."""
    return list({key(h): h for h in sorted(several, key=lambda h: -h.cost)}.values())


def _radial(bounds: Floats, middle: tuple[float, float]) -> Iterator[Piece]:
    """Bars around the middle in place of a part that is flat and about as wide as deep."""
    width, height, depth = np.maximum(np.ptp(bounds, axis=0), 1e-6)
    if 0.5 < width / depth < 2.0 and height < 0.5 * max(width, depth):
        for count in COUNTS:
            for turn in turns(count):
                yield Piece("spokes", bounds[0], bounds[1], middle=middle, count=count, breadth=_BREADTH, turn=turn)


def _surplus(differences: Residuals, replica: Mesh) -> tuple[str, ...]:
    """Labels of the parts that the reference seems not to have."""
    if replica.face_labels is None:
        return ()
    seen = differences.replica.visible
    labels = replica.face_labels[differences.replica.faces[seen]]
    far = differences.to_reference[seen] > NEAR
    return tuple(
        name
        for i, name in enumerate(replica.label_names)
        if (labels == i).sum() > _FEWEST and far[labels == i].mean() > _SURPLUS
    )


def _pieces(
    differences: Residuals, reference: Mesh, replica: Mesh, removed: tuple[str, ...], radial: bool
) -> tuple[Piece, ...]:
    """What of the reference is not explained by the parts that stay, as boxes in the replica's units."""
    theirs, ours, placement = differences.reference, differences.replica, differences.placement
    far: NDArray[np.bool_] = differences.to_replica > NEAR
    if removed and replica.face_labels is not None:
        leaving = [replica.label_names.index(name) for name in removed]
        stays = ~np.isin(replica.face_labels[ours.faces], leaving)
        if stays.any():
            distance, _ = cKDTree(ours.points[stays]).query(theirs.points)
            far = distance > NEAR + ours.spacing
    surface = theirs.points[theirs.visible & far]
    points = placement.invert(filled(reference, surface) if len(surface) else surface)
    middle = replica.bounds.mean(axis=0)
    for axis in (0, 2):  # two symmetric shapes stand middle on middle, wherever their surfaces have most in common
        if _even(theirs.points, 0.0, axis) and _even(replica.vertices, middle[axis], axis):
            points[:, axis] += middle[axis] - placement.invert(np.zeros(3))[axis]
    return decompose(points, (float(middle[0]), float(middle[2])), 1.0 / placement.scale, radial)


def _even(points: Floats, middle: float, axis: int) -> bool:
    """Whether points are the same on both sides of a plane across an axis, all but a few."""
    image = points.copy()
    image[:, axis] = 2.0 * middle - image[:, axis]
    distance, _ = cKDTree(points).query(image[:: max(1, len(image) // 400)])
    return bool((distance < 0.05 * np.ptp(points, axis=0).max()).mean() > _EVEN)


def _pruned(hypothesis: Hypothesis, replica: Mesh, costs: Costs) -> Hypothesis:
    """The hypothesis without what it does not need: one piece or one removal less at a time, by the score."""
    while True:
        pieces, removed = hypothesis.pieces, hypothesis.removed
        simpler = [replace(hypothesis, pieces=(*pieces[:i], *pieces[i + 1 :])) for i in range(len(pieces))]
        for label in removed:
            bounds = bounds_of(replica, label)
            kept = tuple(p for p in pieces if bounds is None or _overlap(p, bounds) < _OVERLAP)
            simpler.append(replace(hypothesis, removed=tuple(r for r in removed if r != label), pieces=kept))
        simpler = [h for h in simpler if h.pieces or h.removed]
        least = min(priced(simpler, replica, costs), key=lambda h: h.score, default=hypothesis)
        if least.score >= hypothesis.score:
            return hypothesis
        hypothesis = least


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
        before, after = hypothesis.pieces[:i], hypothesis.pieces[i + 1 :]
        forms = [replace(hypothesis, pieces=(*before, replace(piece, kind=k), *after)) for k in _forms(piece)]
        fit = {h: _FANCY if h.pieces[i].kind in _FANCIES else _PLAIN for h in priced(forms, replica, costs)}
        better = [h for h, share in fit.items() if h.cost < share * hypothesis.cost]
        hypothesis = min(better, key=lambda h: h.cost / fit[h], default=hypothesis)
    return hypothesis


def _forms(piece: Piece) -> tuple[Kind, ...]:
    if piece.kind == "spokes":
        return ("sloping spokes",)
    width, height, depth = piece.size
    low, high = _SQUARE
    if low < width / depth < high:
        if low < height / width < high:
            return ("cylinder", "frustum", "foot", "sphere")
        return ("cylinder", "frustum", "foot") if height > _FLAT * width else ("cylinder",)
    if low < height / depth < high and width > depth:
        return ("rod x",)
    return ("rod z",) if low < height / width < high and depth > width else ("cylinder",)
