"""Compatible references: network alone, with refinement, with adaptive rounds, and searches without a network.

    python benchmarks/search.py examples/tables/v5.py FOLDER... [--rounds 1] [--seed 0]

Searches without a network: scipy's differential evolution on the parameters of each reference, as long as the whole fit
took (training included), by the same cost. Then, from the network's predictions, a search about thirty times as long as
the quick one: what there is to find.
"""

import argparse
import contextlib
import multiprocessing
import os
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.building import Workers
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.judging.judge import Judge
from shapewright.search.budgets import QUICK, Budget
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine

EXACT = (Probe(3, 0.05, both=True, again=True), Step(3, 3))
LONG = Budget(
    (
        *(Scan(24), Probe(12), *(Step(8, scatter=6),) * 8, *(Step(4, scatter=8),) * 10),
        *(*(EXACT * 10), *(Step(2, scatter=8),) * 8),
    )
)


def evolve(job: tuple[str, sw.Mesh, float, int]) -> dict:
    """The best parameters that differential evolution finds for one reference in so many seconds."""
    from scipy.optimize import Bounds, differential_evolution

    path, mesh, seconds, seed = job
    procedure = sw.load_procedure(path)
    space, cost = procedure.space, AlignedCost(mesh)
    cost(mesh)
    best: list = [np.inf, space.defaults]
    started = time.perf_counter()

    def evaluate(point: np.ndarray) -> float:
        if time.perf_counter() - started > seconds:
            raise TimeoutError
        values = space.canonical(space.decode(point))
        try:
            found = cost(procedure(**values))
        except Exception:  # noqa: BLE001 - what cannot be built is as bad as can be
            return 1e6
        if found < best[0]:
            best[:] = [found, values]
        return found

    top = [float(p.classes - 1) if p.classes else 1.0 for p in space]
    whole = [bool(p.classes) for p in space]
    with contextlib.suppress(TimeoutError):
        differential_evolution(
            evaluate,
            Bounds(np.zeros(len(space)), np.array(top)),
            integrality=np.array(whole),
            popsize=5,
            maxiter=10**6,
            tol=0.0,
            polish=False,
            rng=seed,
        )
    return best[1]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure", type=Path)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    procedure = sw.load_procedure(arguments.procedure)
    references = sw.Collection.of(
        {
            f"{Path(folder).parent.name}-{reference.name}": reference.shape
            for folder in arguments.folders
            for reference in sw.Collection.load(folder)
        }
    )
    judge = Judge.of(references, sw.Settings())

    def row(title: str, distances: np.ndarray, seconds: float) -> None:
        near, mean = int((distances <= sw.light_field.THRESHOLD).sum()), float(np.nanmean(distances))
        print(f"{title:44}{near:5} of {len(references)}   mean distance {mean:.4f}   {seconds:5.0f} s", flush=True)

    fits = (
        ("network alone", "off", 0),
        ("and refinement", "quick", 0),
        ("and adaptive rounds", "quick", arguments.rounds),
    )
    for title, refined, rounds in fits:
        started = time.perf_counter()
        settings = sw.Settings(seed=arguments.seed, refine=refined, rounds=rounds)
        iteration = sw.fit(procedure, references, settings)
        took = time.perf_counter() - started
        row(title, np.array([iteration[name].distance for name in references.names]), took)
        if title == "and refinement":
            predictor, seconds = iteration.predictor, took
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    shapes = [reference.shape for reference in references]
    jobs = [(str(arguments.procedure), shape, seconds * cores / len(shapes), arguments.seed) for shape in shapes]
    started = time.perf_counter()
    with multiprocessing.get_context("spawn").Pool(cores) as pool:
        found = pool.map(evolve, jobs, chunksize=1)
    took = time.perf_counter() - started
    with Workers(procedure) as crew:
        row("differential evolution, the same seconds", judge.distances(crew.build(found)), took)
        started = time.perf_counter()
        prediction, counted = predictor.infer(shapes), [0]
        residuals = judge.measure(range(len(shapes)), judge.nearest(crew.build(prediction.decode()))[1])

        def measure(pairs):
            counted[0] += len(pairs)
            return residuals(pairs)

        for title, budget in (("quick", QUICK), ("long", LONG)):
            counted[0] = 0
            criterion = Criterion(measure, goal=judge.goal)
            vectors = refine(SearchStart(prediction), criterion, crew, budget, arguments.seed)
            vectors = [values or procedure.space.defaults for values in vectors]
            took = time.perf_counter() - started
            each = counted[0] / len(shapes)
            row(f"{title} search, {each:.0f} shapes a reference", judge.distances(crew.build(vectors)), took)


if __name__ == "__main__":
    main()
