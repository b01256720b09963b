"""References that stand another way: how often that is told, and how often falsely of those that stand right.

    python benchmarks/poses.py examples/categories/chair/v3.py FOLDER... [--every 4] [--samples 1000]

Of every second reference, at random, a copy is turned by 90, 180 or 270 degrees or laid on its head. All are fitted;
then each is laid over its replicas and what is predicted for it in every pose, whether it is a misfit or not. One row:
references turned, told with the right pose, with another one, not told; references posed right, told falsely.
"""

import argparse
import random
from collections import Counter
from pathlib import Path

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.causes.poses import AS_GIVEN, Pose, standings
from shapewright.feedback.surfaces.residuals import residuals

TURNED = (Pose(1), Pose(2), Pose(3), Pose(on_its_head=True))


def undone(pose: Pose) -> Pose:
    return pose if pose.on_its_head else Pose(-pose.quarters % 4)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure")
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--every", type=int, default=1, help="Of the references of each folder.")
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    procedure, rng = sw.load_procedure(arguments.procedure), random.Random(arguments.seed)
    given = {r.name: r.shape for folder in arguments.folders for r in [*sw.Collection.load(folder)][:: arguments.every]}
    truth = {name: rng.choice([*[AS_GIVEN] * 4, *TURNED]) for name in given}
    references = sw.Collection.of({name: truth[name].of(shape) for name, shape in given.items()})
    settings = sw.Settings(seed=arguments.seed, samples=arguments.samples)
    iteration = sw.fit(procedure, references, settings)
    cases = [
        Case.of(
            r.name,
            r.reference,
            False,
            Replica(row, r.parameters, r.replica, r.distance),
            residuals(r.reference, r.replica),
        )
        for row, r in enumerate(iteration)
        if r.replica is not None
    ]
    with Workers.of(procedure, settings) as crew:
        found = standings(cases, iteration.predictor, crew, settings.workers)
    counts: Counter[str] = Counter()
    for case, its in zip(cases, found, strict=True):
        way = truth[case.name]
        side = "right" if way == AS_GIVEN else "turned"
        told = "not told" if not its.told else "told" if its.pose == undone(way) else "told another"
        counts[f"{side}, {told}"] += 1
    print(arguments.procedure, dict(sorted(counts.items())))


if __name__ == "__main__":
    main()
