"""The judge of drawings against known truth and against what was labelled by eye.

    python benchmarks/judging_drawings.py [--more FILE.json] [--references 20] [--splits 5]

Known truth: each of ``--references`` drawings of each examples/drawings/v*.py beside variants of itself. A variant is
the same (2 % of its Range off in every scalar, noise of 0.3 % of the extent, through a PNG file), not the same (one
scalar 40 % of its Range off, one other choice, a piece cut out, a bar added; what was cut, mirrored), or another
drawing (on its head, stretched by 1.25, other parameters). Pairs that all but coincide are left out. By eye:
judged_drawings.json, replicas of the bundled drawings; and --more, in the same form with a ``drawing`` (WKT) each.

Weights are fitted on half of the references and tested on the other half, again and again; then on all of them, which
is what ``drawn_fidelity`` holds.
"""

import argparse
import json
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import shapely
from scipy.optimize import minimize
from shapely import affinity

import shapewright as sw
from shapewright.comparison.pictures import visual_information_fidelity
from shapewright.demo import drawings
from shapewright.judging.drawn_fidelity import DrawnFidelity
from shapewright.parameters.kinds import Scalar
from shapewright.references.readers.pictures import read_picture
from shapewright.rendering.ink import png

HERE = Path(__file__).resolve().parent
REPLICATED, CLOSE = 0.65, 0.35
EYE = {"good": 1.0, "passable": 0.5, "wrong": 0.0}
SAME = ("jitter", "noise", "png")
DIFFERENT = ("on its head", "wider", "taller", "random")
UNSEEN = {"scalar": 0.97, "choice": 0.97, "mirrored": 0.97, "on its head": 0.9}  # IoU from which nobody sees it
LEVEL = 0.5
"""Chance of the logistic fit that becomes REPLICATED. Most pairs of known truth are not the same, so it is too low."""


@dataclass(frozen=True)
class Pair:
    """kind: of variant, or "eye". truth: the mean opinion, 0 to 1."""

    name: str
    kind: str
    reference: sw.Drawing
    replica: sw.Drawing
    truth: float


def variants(version: str, count: int, rng: np.random.Generator) -> Iterator[Pair]:
    procedure = sw.load_procedure(HERE.parent / "examples" / "drawings" / f"{version}.py")
    samples = procedure.space.sample(2 * count, seed=1)
    for number, (values, others) in enumerate(zip(samples[:count], samples[count:], strict=True)):
        reference = procedure(**values)
        made = dict(drawn(reference, rng))
        active = [p for p in procedure.space if p.name in procedure.space.active(values)]
        scalars = [p for p in active if isinstance(p, Scalar)]
        shifts = {p.name: 0.02 * (p.high - p.low) * rng.choice([-1, 1]) for p in scalars}
        moved = {p.name: float(np.clip(values[p.name] + shifts[p.name], p.low, p.high)) for p in scalars}
        one = scalars[rng.integers(len(scalars))]
        far = 0.4 * (one.high - one.low)
        changes = {"jitter": moved, "random": others}
        changes["scalar"] = {one.name: values[one.name] + (far if values[one.name] + far <= one.high else -far)}
        if choices := [p for p in active if not isinstance(p, Scalar)]:
            choice = choices[rng.integers(len(choices))]
            left = [level for level in choice.levels if level != values[choice.name]]
            changes["choice"] = {choice.name: left[rng.integers(len(left))]}
        made |= {kind: procedure(**{**values, **change}) for kind, change in changes.items()}
        if cut := made.get("cut out"):
            yield Pair(f"{version} {number}", "mirrored", cut, sw.Drawing(affinity.scale(cut.geometry, -1, 1)), 0.0)
        for kind, replica in made.items():
            yield Pair(f"{version} {number}", kind, reference, replica, float(kind in SAME))


def drawn(reference: sw.Drawing, rng: np.random.Generator) -> Iterator[tuple[str, sw.Drawing]]:
    """Variants of any drawing, by kind."""
    area = reference.normalised().geometry
    for kind, sides in {"on its head": (1, -1), "wider": (1.25, 1), "taller": (1, 1.25)}.items():
        yield kind, sw.Drawing(affinity.scale(area, *sides))
    yield "png", read_picture(png(reference))[0]
    fine = shapely.segmentize(area, 0.01)
    corners = np.unique(shapely.get_coordinates(fine), axis=0)
    shift = dict(zip(map(tuple, corners), rng.normal(0, 0.003, corners.shape), strict=True))
    noisy = shapely.transform(fine, lambda points: points + [shift[tuple(point)] for point in points])
    yield "noise", sw.Drawing(shapely.make_valid(noisy).buffer(0))
    for _ in range(20):
        x, y = corners[rng.integers(len(corners))]
        half = rng.uniform(0.06, 0.125)
        cut = area.difference(shapely.box(x - half, y - half, x + half, y + half))
        if 0.004 < area.area - cut.area < area.area:
            yield "cut out", sw.Drawing(cut)
            break
    for _ in range(20):
        x, y = rng.uniform(area.bounds[:2], area.bounds[2:])
        wide, high = rng.permutation([rng.uniform(0.03, 0.06), rng.uniform(0.15, 0.3)]) / 2
        more = area.union(shapely.box(x - wide, y - high, x + wide, y + high))
        if more.area - area.area > 0.004:
            yield "added", sw.Drawing(more)
            break


def labelled(path: Path) -> Iterator[Pair]:
    own = drawings.tables()
    for row in json.loads(path.read_text()):
        reference = sw.Drawing(shapely.from_wkt(row["drawing"])) if "drawing" in row else own[row["reference"]]
        replica = sw.Drawing(shapely.make_valid(shapely.from_wkt(row["replica"])))
        yield Pair(row["reference"], "eye", reference, replica, EYE[row["seen"]])


def fitted(terms: np.ndarray, truth: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Weights and the bias of a logistic regression.

    The last weight is given. That of the IoU is at least 1: it tells replicas apart that have no regions.
    """
    scale = terms.std(axis=0)[:-1]
    scaled = terms[:, :-1] / scale

    def loss(found: np.ndarray) -> tuple[float, np.ndarray]:
        odds = scaled @ found[:-1] + found[-1]
        chance = 1.0 / (1.0 + np.exp(-odds))
        each = truth * np.logaddexp(0.0, -odds) + (1.0 - truth) * np.logaddexp(0.0, odds)
        slope = weight * (chance - truth) / weight.sum()
        penalty = 0.003 * np.append(found[:-1], 0.0)
        return float(weight @ each / weight.sum() + penalty @ found), np.append(
            scaled.T @ slope, slope.sum()
        ) + 2 * penalty

    count = scaled.shape[1]
    bounds = [(scale[0], None), *[(0.0, None)] * (count - 1), (None, None)]
    found = minimize(loss, np.append(np.ones(count), -5.0), jac=True, bounds=bounds).x
    raised = np.log(REPLICATED / (1.0 - REPLICATED)) - np.log(LEVEL / (1.0 - LEVEL))
    return np.array([*(found[:-1] / scale), -50.0, found[-1] + raised])


def balanced(truth: np.ndarray, said: np.ndarray) -> float:
    return float(said[truth].mean() + 1.0 - said[~truth].mean()) / 2.0


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--more", nargs="*", type=Path, default=[], help="more pairs that were labelled by eye")
    parser.add_argument("--references", type=int, default=20, help="of each version")
    parser.add_argument("--splits", type=int, default=5)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    rng = np.random.default_rng(arguments.seed)
    pairs = [pair for number in range(1, 6) for pair in variants(f"v{number}", arguments.references, rng)]
    pairs += [pair for path in (HERE / "judged_drawings.json", *arguments.more) for pair in labelled(path)]
    judges = [DrawnFidelity(pair.reference) for pair in pairs]
    for judge, pair in zip(judges, pairs, strict=True):
        judge.evidence(pair.reference)  # describes it
    started = time.process_time()
    found = [judge.likeness(pair.replica) for judge, pair in zip(judges, pairs, strict=True)]
    each = (time.process_time() - started) / len(pairs) * 1e3
    seen = [i for i, pair in enumerate(pairs) if pair.truth or found[i].iou < UNSEEN.get(pair.kind, 0.99)]
    print(f"{len(pairs)} pairs, {each:.1f} ms each; {len(pairs) - len(seen)} look the same and are left out")
    pairs, found = [pairs[i] for i in seen], [found[i] for i in seen]
    terms, truth = np.stack([each.terms() for each in found]), np.array([pair.truth for pair in pairs])
    kinds = np.array([pair.kind for pair in pairs])
    _, reference = np.unique([pair.name for pair in pairs], return_inverse=True)
    eye = kinds == "eye"
    weight = np.where(eye, 1.0, 0.0)
    for kind in set(kinds) - {"eye"}:
        weight[kinds == kind] = (40.0 if kind in SAME else 20.0) / (kinds == kind).sum()
    tested, times = np.zeros(len(pairs)), np.zeros(len(pairs))
    for _ in range(arguments.splits):
        half = rng.random(reference.max() + 1) < 0.5
        for learned in (half[reference], ~half[reference]):
            weights = fitted(terms[learned], truth[learned], weight[learned])
            tested[~learned] += 1.0 / (1.0 + np.exp(-terms[~learned] @ weights[:-1] - weights[-1]))
            times[~learned] += 1
    iou = np.array([each.iou for each in found])
    vif = np.array([visual_information_fidelity(pair.reference, pair.replica) for pair in pairs])
    measures = {
        "fidelity, half left out": (tested / times, REPLICATED, CLOSE),
        "fidelity as it is": (np.array([each.value for each in found]), REPLICATED, CLOSE),
        "IoU, .90 and .87": (iou, 0.9, 0.87),
        "VIF, .05": (vif, 0.05, 0.05),
    }
    clear = eye & (truth != 0.5)
    print(f"{eye.sum()} by eye: {[int((truth[eye] == level).sum()) for level in EYE.values()]} {', '.join(EYE)}")
    print(f"{'balanced accuracy':<26}{'known':>8}{'good/wrong':>12}{'good/rest':>11}{'not wrong/wrong':>17}")
    for name, (value, replicated, close) in measures.items():
        cells = [balanced(truth[~eye] == 1, value[~eye] >= replicated)]
        cells += [balanced(truth[some] == 1, value[some] >= replicated) for some in (clear, eye)]
        cells.append(balanced(truth[eye] > 0, value[eye] >= close))
        print(f"{name:<26}{cells[0]:8.3f}{cells[1]:12.3f}{cells[2]:11.3f}{cells[3]:17.3f}")
    print(f"\n{'by fidelity':<14}{'pairs':>6}{'replicated':>12}{'close':>8}{'different':>11}")
    for kind in dict.fromkeys(kinds[~eye]):
        value = tested[kinds == kind] / times[kinds == kind]
        above, below = (value >= REPLICATED).mean(), (value < CLOSE).mean()
        print(f"{kind:<14}{len(value):6d}{above:12.2f}{1.0 - above - below:8.2f}{below:11.2f}")
    print("\nweights and bias:", np.round(fitted(terms, truth, weight), 2).tolist())


if __name__ == "__main__":
    main()
