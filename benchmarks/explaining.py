"""What explaining a large iteration costs beyond the fit: seconds, and CPU seconds of all its processes, by stage.

    python benchmarks/explaining.py [--count 200] [--seed 0] [--workers 2] [--procedure examples/tables/v3.py]

The references are random tables of examples/tables/v5.py; what is found for them is what a quick refinement from their
true parameters gives, so no network is trained. Their descriptors are kept, as a fit keeps them, and kernels compiled.
CPU seconds are those to read on a busy machine.
"""

import argparse
import os
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import shapewright as sw
from causes import WHOLE, Case, made
from shapewright.feedback.explanation import explain
from shapewright.judging.judge import Judge


def cpu_seconds() -> float:
    """Of this process and those it started that have ended."""
    return sum(os.times()[:4])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--procedure", type=Path, default=WHOLE.with_name("v3.py"))
    arguments = parser.parse_args()
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers)
    whole, procedure = sw.load_procedure(WHOLE), sw.load_procedure(arguments.procedure)
    truth = {f"{i:03d}": vector for i, vector in enumerate(whole.space.sample(arguments.count, seed=arguments.seed))}
    references = sw.Collection.of({name: whole(**vector) for name, vector in truth.items()})
    iteration = made(Case("", ()), procedure, references, truth, settings)
    print(f"{len(iteration.misfits)} of {len(iteration)} references are incompatible", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        Judge.of(references, settings, Path(folder))
        few = [result.name for result in iteration.results if not result.compatible][:2]
        explain(
            replace(iteration, results=tuple(iteration[name] for name in few)), procedure, references, suggest=False
        )
        for name, suggest in (("causes", False), ("causes and suggestions", True)):
            started, spent = time.perf_counter(), cpu_seconds()
            explanation = explain(iteration, procedure, references, cache=Path(folder), suggest=suggest)
            seconds, spent = time.perf_counter() - started, cpu_seconds() - spent
            stages = ", ".join(f"{stage} {stage_seconds:.1f}" for stage, stage_seconds in explanation.seconds.items())
            print(f"{name}: {seconds:.1f} s, {spent:.1f} CPU s ({stages})", flush=True)


if __name__ == "__main__":
    main()
