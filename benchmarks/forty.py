"""Forty parameters of all kinds: what the network finds, and what refinement and adaptive sampling each add.

    python benchmarks/forty.py [--references 60] [--rounds 2] [--seed 0]

References are samples of wall_unit.py that no training sees, drawn with another seed. One row a setting: mean absolute
error of the scalars that matter (normalised), mean F1 of the others, compatible references, mean distance, seconds.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.building import Workers
from shapewright.prediction.inference import score

UNSEEN = 1_000_003


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--references", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=2)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    procedure = sw.load_procedure(Path(__file__).with_name("wall_unit.py"))
    space = procedure.space
    vectors = space.sample(arguments.references, seed=UNSEEN + arguments.seed)
    with Workers(procedure) as crew:
        builds = [build for build in crew.build(vectors, give_up=True) if build.shape is not None]
    references = sw.Collection.of({f"{i:03d}": build.shape for i, build in enumerate(builds)})
    targets = np.array([space.encode(build.parameters) for build in builds], dtype=np.float32)
    active = np.array([[name in space.active(build.parameters) for name in space.names] for build in builds])
    kinds = {kind: sum(type(p).__name__ == kind for p in space) for kind in ("Scalar", "Integer", "Choice", "Binary")}
    print(f"{len(space)} parameters: {kinds}; {len(references)} references", flush=True)
    for refined, rounds in (
        ("off", 0),
        ("quick", 0),
        ("off", arguments.rounds),
        ("quick", arguments.rounds),
        ("thorough", 0),
    ):
        started = time.perf_counter()
        iteration = sw.fit(procedure, references, sw.Settings(seed=arguments.seed, refine=refined, rounds=rounds))
        seconds = time.perf_counter() - started
        found = np.array([space.encode(iteration[name].parameters) for name in references.names], dtype=np.float32)
        answers = [
            np.eye(p.classes, dtype=np.float32)[column.astype(int)] if p.classes else column
            for p, column in zip(space, found.T, strict=True)
        ]
        metrics = score(space, answers, targets, active).values()
        error, f1 = (float(np.mean([m[key] for m in metrics if key in m])) for key in ("mae", "f1"))
        distances = [iteration[name].distance for name in references.names]
        print(
            f"refine {refined:9} rounds {rounds}   MAE {error:.4f}   F1 {f1:.3f}   "
            f"{len(iteration.compatible)} compatible   mean distance {np.nanmean(distances):.4f}   {seconds:.0f} s",
            flush=True,
        )


if __name__ == "__main__":
    main()
