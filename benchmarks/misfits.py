"""Groups of misfits against the rules that they lack: how pure they are, by likeness alone and with what is left.

    python benchmarks/misfits.py [chair table shelf bed] [--count 6]

Of each category's last version three rules are removed, in two sets: ``a``, on which the constants of
``comparison/remainders`` were chosen, and ``b``, which is the test. References are shapes of the whole procedure that
use just one of the removed rules, --count of each; their replicas are searched for without these rules. A row holds the
adjusted Rand index against the rules (1: a group for each rule; 0: as chance would have it), the share of references
that share the commonest rule of their group, and the number of groups: of likeness alone, as the paper groups, and of
the default judge.
"""

import argparse
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import numpy as np
from sklearn.metrics import adjusted_rand_score

import shapewright as sw
from shapewright.building import Workers
from shapewright.comparison.grouping import Group
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, Prediction
from shapewright.search.budgets import Budget
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.search import SearchStart, refine

CATEGORIES = Path(__file__).resolve().parents[1] / "examples" / "categories"
SAMPLED = 3000
SEARCH = Budget((Scan(1), Probe(1), Step(1, scatter=3), Step(1, scatter=3)))
Rule = tuple[str, Callable[[Parameters], bool], Parameters]  # its name, whether it is used, and what is without it


def choice(parameter: str, value: object, without: object) -> Rule:
    return f"{parameter}={value}", lambda v: v[parameter] == value, {parameter: without}


def more(parameter: str, than: object) -> Rule:
    return parameter, lambda v: v[parameter] != than, {parameter: than}


SETS: dict[str, dict[str, tuple[Rule, Rule, Rule]]] = {
    "a": {
        "chair": (more("arms", "none"), choice("base", "star", "legs"), more("stretchers", 0)),
        "table": (more("tiers", 0), choice("base", "column", "legs"), choice("base", "trestle", "legs")),
        "shelf": (more("crown", False), choice("stand", "legs", "floor"), more("across", 1)),
        "bed": (more("bunk", False), more("rails", False), more("pillows", 0)),
    },
    "b": {
        "chair": (more("rails", 0), choice("base", "pedestal", "legs"), choice("base", "sled", "legs")),
        "table": (more("cabinets", 0), choice("base", "star", "legs"), more("back", False)),
        "shelf": (
            choice("front", "closed", "open"),
            choice("front", "half", "open"),
            choice("stand", "plinth", "floor"),
        ),
        "bed": (more("blanket", False), choice("ends", "spindles", "panels"), more("bunk", False)),
    },
}


def misfits(category: str, rules: tuple[Rule, ...], count: int, seed: int) -> tuple[list[str], Judge, list[sw.Mesh]]:
    """The rule that each reference lacks, a judge of the references, and their replicas."""
    procedure = sw.load_procedure(CATEGORIES / category / "v3.py")
    space, settings = procedure.space, sw.Settings(seed=0, shape_seconds=60.0)
    pairs: list[tuple[str, Parameters, Parameters]] = []
    for values in space.sample(SAMPLED, seed):
        active = {name: values[name] for name in space.active(values)}
        used = [(name, without) for name, uses, without in rules if set(without) <= set(active) and uses(values)]
        if len(used) == 1 and sum(rule == used[0][0] for rule, *_ in pairs) < count:
            pairs.append((used[0][0], values, space.canonical({**values, **used[0][1]})))
    with Workers.of(procedure, settings) as crew:
        builds = crew.build([values for _, values, _ in pairs])
        pairs = [pair for pair, build in zip(pairs, builds, strict=True) if build.shape]
        shapes = [build.shape for build in builds if build.shape]
        judge = Judge.of(sw.Collection.of({f"{i:03d}": shape for i, shape in enumerate(shapes)}), settings)
        starts = [start for *_, start in pairs]
        search = SearchStart(Prediction.of(space, starts), starts)
        found = crew.build(refine(search, judge.criterion(range(len(pairs))), crew, SEARCH, 0))
    return [rule for rule, *_ in pairs], judge, [build.shape for build in found]


def scores(groups: tuple[Group, ...], truth: list[str]) -> tuple[float, float, int]:
    label = {name: number for number, group in enumerate(groups) for name in group.members}
    found = [label[f"{i:03d}"] for i in range(len(truth))]
    commonest = sum(Counter(truth[int(name)] for name in group.members).most_common(1)[0][1] for group in groups)
    return adjusted_rand_score(truth, found), commonest / len(truth), len(groups)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("categories", nargs="*", default=list(SETS["a"]))
    parser.add_argument("--count", type=int, default=6)
    arguments = parser.parse_args()
    for number, (part, sets) in enumerate(SETS.items()):
        rows = []
        for category in arguments.categories:
            truth, judge, replicas = misfits(category, sets[category], arguments.count, number + 1)
            row = [scores(judge.groups(["different"] * len(truth), made), truth) for made in (None, replicas)]
            rows.append(np.ravel(row))
            print(part, category, len(truth), rows[-1].round(2).tolist(), flush=True)
        print(part, "mean", np.mean(rows, axis=0).round(2).tolist(), flush=True)


if __name__ == "__main__":
    main()
