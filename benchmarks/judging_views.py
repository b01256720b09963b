"""The judge of pictures of objects against known truth.

    python benchmarks/judging_views.py [table chair shelf bed] [--count 12] [--seed 0] [--splits 20]

References are samples of examples/categories, each in a silhouette from a random place. Beside each are variants of
itself, whose cameras are found anew: the same (every scalar off by up to 2 % of its Range), or not the same (a scalar
off by 40 % of its Range, another choice, other parameters altogether). Variants that change the silhouette in the true
view by less than 2 % of IoU are left out, as nobody can see them there.

Weights are fitted on half of the references and tested on the other half, again and again; then on all of them, which
is what ``view_fidelity`` holds.
"""

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from scipy.optimize import minimize
from sklearn.metrics import roc_auc_score

import shapewright as sw
from shapewright.judging.views.view_fidelity import _BIAS, _WEIGHTS, ViewFidelity
from shapewright.rendering.anywhere import random_places
from shapewright.rendering.framed import framed
from shapewright.search.views.camera_search import ViewsDifference
from shapewright.shapes.views import SIDE, View, Views

ROOT = Path(__file__).resolve().parents[1] / "examples" / "categories"
VERSIONS = {"table": "v4", "chair": "v4", "shelf": "v3", "bed": "v3"}
UNSEEN = 0.98  # IoU in the true view
REPLICATED = 0.65


def variants(space: sw.ParameterSpace, values: dict, rng: np.random.Generator) -> Iterator[tuple[str, dict]]:
    active = set(space.active(values))
    off = rng.uniform(-0.02, 0.02, len(space)) * space.scalars
    yield "jitter", space.canonical(space.decode((space.encode(values) + off).clip(0.0, None)))
    scalars = [p for p in space if not p.classes and p.name in active]
    for parameter in rng.permutation(np.array(scalars, dtype=object))[:2]:
        at = parameter.encode(values[parameter.name])
        yield "scalar", space.canonical({**values, parameter.name: parameter.decode(at + (0.4 if at < 0.5 else -0.4))})
    choices = [p for p in space if p.classes and p.name in active]
    for parameter in rng.permutation(np.array(choices, dtype=object))[:2]:
        others = [level for level in parameter.levels or () if level != values[parameter.name]]
        yield "choice", space.canonical({**values, parameter.name: others[int(rng.integers(len(others)))]})
    yield "random", space.sample(1, seed=int(rng.integers(2**31)))[0]


def pairs(category: str, count: int, seed: int) -> Iterator[tuple[str, str, np.ndarray]]:
    """The reference, the kind of variant, and the terms of its likeness."""
    procedure = sw.load_procedure(ROOT / category / f"{VERSIONS[category]}.py")
    rng = np.random.default_rng([seed, 11])
    for number, values in enumerate(procedure.space.sample(count, seed=seed + 2000)):
        try:
            mesh = procedure(**values).normalised()
        except sw.Infeasible:
            continue
        place = random_places(1, rng)
        reference = Views((View(framed(mesh, place, SIDE, 1)[0]),))
        judge, truth = ViewFidelity(reference, ViewsDifference(reference)), framed(mesh, place, 160, 2)[0] / 255.0
        for kind, other in variants(procedure.space, values, rng):
            try:
                replica = procedure(**other).normalised()
            except sw.Infeasible:
                continue
            seen = framed(replica, place, 160, 2)[0] / 255.0
            found = judge.in_view(replica)
            if found and (kind == "jitter" or np.minimum(seen, truth).sum() < UNSEEN * np.maximum(seen, truth).sum()):
                yield f"{category} {number}", kind, found.likenesses[0].terms()


def fitted(terms: np.ndarray, same: np.ndarray) -> tuple[np.ndarray, float]:
    """Weights and bias of a logistic regression in which both classes weigh alike; stretch cannot count in favour."""
    balance = np.where(same, 0.5 / max(same.mean(), 1e-9), 0.5 / max(1.0 - same.mean(), 1e-9))

    def loss(x: np.ndarray) -> float:
        return float((balance * np.logaddexp(0.0, np.where(same, -1.0, 1.0) * (terms @ x[:4] + x[4]))).mean())

    limits = [(0, 40), (0, 10), (0, 10), (-60, 0), (-60, 20)]
    best = minimize(lambda x: loss(x) + 1e-4 * float((x[:3] ** 2).sum()), [5, 1, 1, -10, -8], bounds=limits)
    return best.x[:4], float(best.x[4])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(VERSIONS)}; default: all")
    parser.add_argument("--count", type=int, default=12)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--splits", type=int, default=20)
    arguments = parser.parse_args()
    rows = [row for name in arguments.categories or VERSIONS for row in pairs(name, arguments.count, arguments.seed)]
    names, kinds = np.array([row[0] for row in rows]), np.array([row[1] for row in rows])
    terms, same = np.array([row[2] for row in rows]), kinds == "jitter"
    present = 1 / (1 + np.exp(-terms @ _WEIGHTS - _BIAS))
    print(f"{len(rows)} pairs, {same.sum()} the same; as it is: {accuracy(present, same)}")
    rng, tested = np.random.default_rng(arguments.seed), []
    for _ in range(arguments.splits):
        half = np.isin(names, rng.permutation(np.unique(names))[::2])
        weights, bias = fitted(terms[half], same[half])
        tested.append(balanced(1 / (1 + np.exp(-terms[~half] @ weights - bias)), same[~half]))
    print(f"fitted on half, tested on the rest: balanced accuracy {np.mean(tested):.3f}")
    weights, bias = fitted(terms, same)
    values = 1 / (1 + np.exp(-terms @ weights - bias))
    print(f"fitted on all: {accuracy(values, same)}\nweights {weights.round(2).tolist()} bias {bias:.2f}")
    for kind in dict.fromkeys(kinds):
        of = kinds == kind
        print(f"    {kind:8} {of.sum():4}  replicated {np.mean(values[of] >= REPLICATED):.2f}")


def balanced(values: np.ndarray, same: np.ndarray) -> float:
    return float((np.mean(values[same] >= REPLICATED) + np.mean(values[~same] < REPLICATED)) / 2)


def accuracy(values: np.ndarray, same: np.ndarray) -> str:
    return f"AUC {roc_auc_score(same, values):.3f}, balanced accuracy {balanced(values, same):.3f} at {REPLICATED}"


if __name__ == "__main__":
    main()
