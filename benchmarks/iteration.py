"""Seconds by stage and peak memory of one whole iteration, the run's folder and report included.

    python benchmarks/iteration.py examples/tables/v5.py FOLDER... --count 200

References are taken from the folders in turn until there are enough. Descriptors are not cached between runs. With
--previous an earlier version is fitted first, and the iteration that is measured goes on from it.
"""

import argparse
import resource
import sys
import tempfile
import time
from pathlib import Path

import shapewright as sw
from shapewright.report import write_report


def gather(folders: list[str], count: int) -> sw.Collection:
    found = {
        f"{Path(folder).parent.name}-{reference.name}": reference.shape
        for folder in folders
        for reference in sw.Collection.load(folder)
    }
    if len(found) < count:
        sys.exit(f"only {len(found)} references in these folders, {count} wanted")
    return sw.Collection.of(dict(list(found.items())[:count]))


def peak_megabytes() -> tuple[float, float]:
    """Of this process, and of the largest worker."""
    unit = 2**20 if sys.platform == "darwin" else 2**10
    return tuple(resource.getrusage(who).ru_maxrss / unit for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--previous", help="an earlier version of the procedure")
    parser.add_argument("--rounds", type=int, default=0, help="of adaptive sampling")
    arguments = parser.parse_args()
    settings = sw.Settings(workers=arguments.workers, rounds=arguments.rounds)
    started = time.perf_counter()
    references = gather(arguments.folders, arguments.count)
    loaded = time.perf_counter() - started
    with tempfile.TemporaryDirectory() as cache:
        previous = None
        if arguments.previous:
            previous = sw.fit(sw.load_procedure(arguments.previous), references, settings, cache=Path(cache))
            print(f"{len(previous.compatible)} compatible before")
        started = time.perf_counter()
        procedure = sw.load_procedure(arguments.procedure)
        iteration = sw.fit(procedure, references, settings, cache=Path(cache), previous=previous)
    fitted = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        iteration.save(Path(folder) / "run", write_report)
    saved = time.perf_counter()
    first = iteration.metrics["first_answer"]
    stages = {"load": loaded, "(answer)": first, **iteration.seconds, "save": saved - fitted, "all": saved - started}
    for stage, seconds in stages.items():
        print(f"{stage:<10}{seconds:8.2f} s")
    mine, worker = peak_megabytes()
    print(f"{len(iteration.compatible)} compatible; peak {mine:.0f} MB, largest worker {worker:.0f} MB")


if __name__ == "__main__":
    main()
