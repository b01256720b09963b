"""Groups without the distance of every pair against groups with it: how alike they are, how wide, how long it takes.

    python benchmarks/grouping.py FOLDER... [--synthetic 600 2000] [--most 150]

One row a collection, each with the cut of 0.4 of the largest distance and with the absolute one of 3400 / 15000:
groups of both methods, adjusted Rand index between them (1: the same groups; 0: as chance would have it), the
same index between the groups of all pairs and those that all pairs give without every twentieth shape, the largest
distance inside a group over the cut, share of all pairs whose distance was taken, seconds of both.
"""

import argparse
import time
from pathlib import Path

import numpy as np
from sklearn.metrics import adjusted_rand_score

import shapewright as sw
from shapewright.comparison import light_field
from shapewright.comparison.grouping import Group, group
from shapewright.comparison.leaders import LEADERS, group_by_leaders

TABLES = Path(__file__).parent.parent / "examples" / "tables" / "v5.py"


def labels(groups: tuple[Group, ...], names: list[str]) -> list[int]:
    of = {name: i for i, found in enumerate(groups) for name in found.members}
    return [of[name] for name in names]


def widest(groups: tuple[Group, ...], names: list[str], apart: np.ndarray) -> float:
    row = {name: i for i, name in enumerate(names)}
    inside = [[row[name] for name in found.members] for found in groups]
    return max(float(apart[np.ix_(rows, rows)].max()) for rows in inside)


def compare(title: str, described: list[light_field.Descriptor], most: int) -> None:
    names = [f"{i:05d}" for i in range(len(described))]
    started = time.perf_counter()
    apart = light_field.distances(described)
    matrix_seconds = time.perf_counter() - started
    for cut, absolute in ((0.4, False), (3400 / 15000, True)):
        taken = 0

        def between(some, others):
            nonlocal taken
            taken += len(some) * len(others)
            return light_field.distances([described[i] for i in some], [described[i] for i in others], threads=1)

        started = time.perf_counter()
        whole = group(names, apart, cut, absolute)
        seconds = matrix_seconds + time.perf_counter() - started
        started = time.perf_counter()
        quick = group_by_leaders(names, between, cut, absolute, most)
        quick_seconds = time.perf_counter() - started
        limit = cut if absolute else cut * apart.max()
        alike = adjusted_rand_score(labels(whole, names), labels(quick, names))
        kept = [i for i in range(len(names)) if i % 20]
        fewer = group([names[i] for i in kept], apart[np.ix_(kept, kept)], limit, True)
        stable = adjusted_rand_score([labels(whole, names)[i] for i in kept], labels(fewer, [names[i] for i in kept]))
        print(
            f"| {title} | {len(names)} | {'absolute' if absolute else 'relative'} | {len(whole)} | {len(quick)} "
            f"| {alike:.2f} | {stable:.2f} | {widest(quick, names, apart) / limit:.2f} "
            f"| {taken / (len(names) * (len(names) - 1) / 2):.2f} | {seconds:.1f} | {quick_seconds:.1f} |",
            flush=True,
        )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="*", type=Path)
    parser.add_argument("--synthetic", type=int, nargs="*", default=[])
    parser.add_argument("--most", type=int, default=LEADERS)
    arguments = parser.parse_args()
    heads = "collection, shapes, cut, groups of all pairs, groups, Rand, Rand without 1/20, widest / cut, pairs, s, s"
    print("| " + heads.replace(", ", " | ") + " |")
    print(11 * "|---" + "|")
    for folder in arguments.folders:
        shapes = [reference.shape for reference in sw.Collection.load(folder)]
        compare(folder.name, light_field.descriptors(shapes), arguments.most)
    procedure = sw.load_procedure(TABLES)
    for count in arguments.synthetic:
        shapes = [procedure(**values) for values in procedure.space.sample(count, seed=0)]
        compare("random tables", light_field.descriptors(shapes), arguments.most)


if __name__ == "__main__":
    main()
