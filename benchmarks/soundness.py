"""Random samples of procedures, each shape examined: python benchmarks/soundness.py FILE.py ... [-n 10000] [--seed 0]

Ends with status 1 if any shape is unsound or fails for another reason than Infeasible.
"""

import argparse
import sys
import time
from collections import Counter

import numpy as np

from shapewright import Mesh, Procedure, load_procedure
from shapewright.building import Build, Workers
from shapewright.parameters import Parameters
from shapewright.shapes.soundness import Soundness
from shapewright.threads import in_threads

CHUNK, TIMED, TRIES = 512, 300, 8


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedures", nargs="+")
    parser.add_argument("-n", "--count", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    arguments = parser.parse_args()
    bad = [examine(path, arguments.count, arguments.seed, arguments.workers) for path in arguments.procedures]
    sys.exit(any(bad))


def examine(path: str, count: int, seed: int, workers: int | None) -> int:
    """Print what is to be said of one procedure; returns how many shapes are not as they should be."""
    procedure = load_procedure(path)
    vectors = procedure.space.sample(count, seed=seed)
    started = time.perf_counter()
    states: list[Soundness] = []
    builds: list[Build] = []
    checking: list[float] = []
    with Workers(procedure, workers) as crew:
        for start in range(0, len(vectors), CHUNK):
            builds += crew.build(vectors[start : start + CHUNK])
            meshes = [build.shape for build in builds[start:] if isinstance(build.shape, Mesh)]
            before = time.perf_counter()
            states += in_threads(Mesh.soundness, meshes, workers)
            checking.append((time.perf_counter() - before) / max(len(meshes), 1))
            print(f"\r{path}: {len(builds)} of {len(vectors)}", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    made = [build for build in builds if build.shape is not None]
    broken = [build for build in builds if build.failure and build.failure.kind != "infeasible"]
    unsound = [(build, state) for build, state in zip(made, states, strict=True) if not state.sound]
    triangles = [state.triangles for state in states]
    seconds = [1e3 * _cpu_seconds(procedure, build.parameters) for build in made[:TIMED]]
    print(f"{path}: {len(made)} shapes, {len(unsound)} unsound, {len(broken)} failed, "
          f"{len(builds) - len(made) - len(broken)} infeasible; {time.perf_counter() - started:.0f} s")  # fmt: skip
    print(f"  triangles  median {np.median(triangles):.0f}, {min(triangles)} to {max(triangles)}")
    print(f"  build      median {np.median(seconds):.2f} ms of CPU, 95 % within {np.quantile(seconds, 0.95):.2f} ms")
    print(f"  examine    {np.median(checking) * 1e3:.2f} ms a shape, threads and all")
    for (what, number), example in _kinds([(str(state).split(";")[0], build) for build, state in unsound]):
        print(f"  {number} x {what}: {example.parameters}")
    for (what, number), example in _kinds([(str(build.failure), build) for build in broken]):
        print(f"  {number} x {what}: {example.parameters}")
    return len(unsound) + len(broken)


def _cpu_seconds(procedure: Procedure, parameters: Parameters) -> float:
    """What one shape costs its thread, mesh included: the least of several tries, because other programs disturb."""
    spent = []
    for _ in range(TRIES):
        before = time.thread_time()
        procedure(**parameters)
        spent.append(time.thread_time() - before)
    return min(spent)


def _kinds(found: list[tuple[str, Build]]) -> list[tuple[tuple[str, int], Build]]:
    """The five commonest kinds, how often each was found, and one build of it."""
    example = dict(reversed(found))
    return [((what, number), example[what]) for what, number in Counter(what for what, _ in found).most_common(5)]


if __name__ == "__main__":
    main()
