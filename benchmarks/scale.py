"""How a fit grows with its references: seconds, CPU seconds, memory and bytes by stage, and what that means for more.

    python benchmarks/scale.py [--counts 100 1000 10000] [--samples 1000] [--workers 2]
    python benchmarks/scale.py seam [--count 100] [--turns 2]
    python benchmarks/scale.py groups [--counts 1000 4000 16000]

References are random tables of examples/tables/v5.py, fitted by v4.py. Every count runs in a process of its own, so
that its peak of memory is its own. Growth is the exponent of a power law through the counts: 1 is proportional. The
plan divides what goes by chunks among machines, and adds what stays on one. ``seam`` fits the same references by the
local pool and by dask's local cluster, alternately; CPU seconds of all processes are those to read on a busy machine.
``groups`` groups shapes of a synthetic distance.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

TABLES = Path(__file__).resolve().parents[1] / "examples" / "tables"
LOCAL = ("read", "train", "predict", "picture", "save")
"""Stages that stay on one machine; all others go by chunks."""
PLANNED, MACHINES, CORES = (100_000, 1_000_000), (1, 10, 100), 16
Record = dict[str, Any]


def cpu_seconds() -> float:
    """Of this process and all below it, those that have ended among them."""
    import psutil

    own = psutil.Process()
    spent = 0.0
    for process in [own, *own.children(recursive=True)]:
        try:
            times = process.cpu_times()
        except psutil.NoSuchProcess:
            continue
        spent += times.user + times.system + times.children_user + times.children_system
    return float(spent)


def bytes_of(folder: Path) -> int:
    return sum(file.stat().st_size for file in folder.rglob("*") if file.is_file())


def measured(count: int, samples: int, workers: int) -> Record:
    """One count, in this process: seconds and CPU seconds by stage, the peak of memory, and bytes."""
    import shapewright as sw
    from shapewright.fitting.samples import write_samples

    whole, procedure = sw.load_procedure(TABLES / "v5.py"), sw.load_procedure(TABLES / "v4.py")
    settings = sw.Settings(samples=samples, epochs=3, workers=workers)
    seconds: dict[str, float] = {}
    cpu: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)

        def stage(name: str, begun: tuple[float, float]) -> None:
            seconds[name], cpu[name] = time.perf_counter() - begun[0], cpu_seconds() - begun[1]

        begun = time.perf_counter(), cpu_seconds()
        write_samples(whole, count, place / "refs", seed=7, workers=workers)
        stage("write samples", begun)
        begun = time.perf_counter(), cpu_seconds()
        references = sw.Collection.load(place / "refs")
        stage("read", begun)
        marks: list[tuple[str, float]] = []

        def listen(event: sw.Progress) -> None:
            if not marks or marks[-1][0] != event.stage:
                marks.append((event.stage, cpu_seconds()))

        iteration = sw.fit(procedure, references, settings, listen)
        marks.append(("", cpu_seconds()))
        for (name, before), (_, after) in pairwise(marks):
            cpu[name] = cpu.get(name, 0.0) + after - before
        seconds |= iteration.seconds
        begun = time.perf_counter(), cpu_seconds()
        iteration.save(place / "run")
        stage("save", begun)
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
        sizes = {"samples": bytes_of(place / "refs"), "run": bytes_of(place / "run")}
    return {"count": count, "seconds": seconds, "cpu": cpu, "peak": peak, "bytes": sizes}


def exponent(counts: Sequence[int], values: Sequence[float]) -> float:
    """Of the power law through these values; NaN for fewer than two counts, or where something took no time."""
    if len(counts) < 2 or min(values) <= 0.0:
        return math.nan
    return float(np.polyfit(np.log(counts), np.log(values), 1)[0])


def print_growth(records: Sequence[Record]) -> None:
    counts = [record["count"] for record in records]
    print("\n| stage | " + " | ".join(f"{count:,}" for count in counts) + " | growth |")
    print("|---|" + "---:|" * (len(counts) + 1))
    for name in records[-1]["cpu"]:
        spent = [record["cpu"].get(name, 0.0) for record in records]
        cells = " | ".join(
            f"{record['seconds'].get(name, 0.0):.1f} s, {one:.1f} CPU s"
            for record, one in zip(records, spent, strict=True)
        )
        print(f"| {name} | {cells} | {exponent(counts, spent):.2f} |")
    for name, values in (
        ("peak of the main process, MB", [record["peak"] / 1e6 for record in records]),
        ("bytes of the samples, MB", [record["bytes"]["samples"] / 1e6 for record in records]),
        ("bytes of the run, MB", [record["bytes"]["run"] / 1e6 for record in records]),
    ):
        print(f"| {name} | " + " | ".join(f"{value:.1f}" for value in values) + f" | {exponent(counts, values):.2f} |")


def print_plan(records: Sequence[Record]) -> None:
    """From the largest count: CPU seconds grow in proportion to references, but for those of the samples' training."""
    last = records[-1]
    each = {
        name: spent / last["count"] for name, spent in last["cpu"].items() if name not in ("sample", "render", "train")
    }
    spread = sum(spent for name, spent in each.items() if name not in LOCAL)
    local = sum(spent for name, spent in each.items() if name in LOCAL)
    print(
        f"\nHours, at {spread:.2f} CPU s a reference by chunks and {local:.3f} on one machine; {CORES} cores a machine."
    )
    print("\n| references | " + " | ".join(f"{machines} machines" for machines in MACHINES) + " |")
    print("|---|" + "---:|" * len(MACHINES))
    for count in PLANNED:
        hours = [count * (spread / (machines * CORES) + local / CORES) / 3600.0 for machines in MACHINES]
        print(f"| {count:,} | " + " | ".join(f"{each:.1f}" for each in hours) + " |")


def seam(count: int, turns: int, samples: int, names: Sequence[str]) -> None:
    """The same fit by the local pool and by dask's local cluster of 1 and 2 workers, alternately."""
    import shapewright as sw
    from shapewright.building.clusters import ClusterName, where

    whole, procedure = sw.load_procedure(TABLES / "v5.py"), sw.load_procedure(TABLES / "v4.py")
    vectors = whole.space.sample(count, seed=7)
    references = sw.Collection.of({f"{i:05d}": whole(**vector) for i, vector in enumerate(vectors)})
    settings = sw.Settings(samples=samples, epochs=2, workers=2, refine_shapes=100)
    spent: dict[str, list[tuple[float, float]]] = {}
    for turn in range(turns + 1):  # the first compiles kernels and fills caches
        for name in names:
            cluster = None if name == "local" else ClusterName.parse(name)
            with where(cluster) as there:
                before, begun = cpu_seconds(), time.perf_counter()
                fitted = sw.fit(procedure, references, settings, executor=there)
                wall, cpu = time.perf_counter() - begun, cpu_seconds() - before
            if turn:
                spent.setdefault(name, []).append((wall, cpu))
                stages = ", ".join(f"{stage} {seconds:.1f}" for stage, seconds in fitted.seconds.items())
                print(f"{name}: {wall:.1f} s, {cpu:.1f} CPU s ({stages})", flush=True)
    for name, pairs in spent.items():
        ratios = np.array(pairs).mean(axis=0) / np.array(spent["local"]).mean(axis=0)
        print(f"{name} / local: {ratios[0]:.2f} of the seconds, {ratios[1]:.2f} of the CPU seconds")


def groups(counts: Sequence[int]) -> None:
    """Shapes as points, whose distances cost next to nothing: what grows is what grouping itself needs."""
    from shapewright.comparison.leaders import group_by_leaders

    seconds, taken = [], []
    for count in counts:
        points = np.random.default_rng(0).standard_normal((count, 6))
        points[: count // 2] *= 0.1
        asked = 0

        def between(some: Sequence[int], others: Sequence[int], points: Any = points) -> Any:
            nonlocal asked
            asked += len(some) * len(others)
            return np.linalg.norm(points[list(some)][:, None] - points[list(others)][None], axis=2)

        begun = time.process_time()
        found = group_by_leaders([f"{i:07d}" for i in range(count)], between, 0.4, threads=1)
        seconds.append(time.process_time() - begun)
        taken.append(asked)
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(
            f"{count:,}: {seconds[-1]:.1f} CPU s, {asked:,} distances, {len(found)} groups, peak {peak:.0f} MB",
            flush=True,
        )
    print(f"growth: {exponent(counts, seconds):.2f} of CPU seconds, {exponent(counts, taken):.2f} of distances")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", nargs="?", choices=["fit", "seam", "groups", "one"], default="fit")
    parser.add_argument("--counts", type=int, nargs="+", default=None)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--turns", type=int, default=2)
    parser.add_argument("--clusters", nargs="+", default=["local", "dask:local:2", "dask:local:1"])
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    arguments = parser.parse_args()
    if arguments.what == "seam":
        seam(arguments.count, arguments.turns, arguments.samples, arguments.clusters)
    elif arguments.what == "groups":
        groups(arguments.counts or [1000, 4000, 16_000])
    elif arguments.what == "one":
        print(json.dumps(measured(arguments.count, arguments.samples, arguments.workers)))
    else:
        records = []
        for count in arguments.counts or [100, 1000, 10_000]:
            command = [sys.executable, __file__, "one", "--count", count, "--samples", arguments.samples]
            run = subprocess.run(
                list(map(str, [*command, "--workers", arguments.workers])),
                stdout=subprocess.PIPE,
                text=True,
                check=True,
            )
            records.append(json.loads(run.stdout.splitlines()[-1]))
            print(f"{count:,} references: done", flush=True)
        print_growth(records)
        print_plan(records)


if __name__ == "__main__":
    main()
