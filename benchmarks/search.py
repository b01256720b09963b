"""Compatible references: network alone, with refinement, with adaptive rounds, and searches without a network.

    python benchmarks/search.py examples/tables/v5.py FOLDER... [--rounds 1] [--seed 0] [--objectives]

Searches without a network: scipy's differential evolution on the parameters of each reference, as long as the whole fit
took (training included), by the same cost. Then, from the network's predictions, a search about thirty times as long as
the quick one: what there is to find. With --objectives only this: quick searches from the same predictions, by what
each judge makes small, scored by measures that neither of them is made of.
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
from shapewright.comparison.gaps import Surface
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.judging.judge import Judge
from shapewright.rendering.cameras import Camera
from shapewright.rendering.raster import render
from shapewright.search.budgets import QUICK, Budget
from shapewright.search.moves import Probe, Scan, Step
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine

PLACES = ((20, 10), (70, 40), (110, -30), (160, 20), (200, -10), (250, 35), (300, 5))
UNSEEN = tuple(Camera(float(azimuth), float(elevation)) for azimuth, elevation in PLACES)  # by any search
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


def apart(reference: sw.Mesh, replica: sw.Mesh) -> tuple[float, float, float, float]:
    """IoU of silhouettes, difference of depths, F-score at 2 % of the extent, light-field distance."""
    meshes = [reference.normalised(), replica.normalised()]
    a, b = render(meshes, UNSEEN, 128, supersample=1)[:, :, 1].astype(float)
    both, either = (a > 0) & (b > 0), (a > 0) | (b > 0)
    overlap = float((both.sum(axis=(1, 2)) / either.sum(axis=(1, 2))).mean())
    depth = float(np.where(both, np.abs(a - b) / 255.0, either).sum() / either.sum())
    f_score = Surface(reference).gaps(Surface(replica)).f_score(0.02)
    return overlap, depth, f_score, sw.light_field.distance(reference, replica)


def objectives(procedure: sw.Procedure, references: sw.Collection, seed: int) -> None:
    """Quick searches from the same predictions, by what each judge makes small."""
    shapes = [reference.shape for reference in references]
    prediction = sw.train(procedure, sw.Settings(seed=seed)).infer(shapes)

    def row(title: str, builds: list, seconds: float) -> None:
        pairs = zip(shapes, builds, strict=True)
        found = np.array([apart(shape, build.shape) for shape, build in pairs if build.shape is not None])
        overlap, depth, f_score, distance = found.mean(axis=0)
        values = f"IoU {overlap:.4f}   depth {depth:.4f}   F-score {f_score:.4f}   distance {distance:.4f}"
        print(f"{title:26}{values}   {seconds:5.0f} s", flush=True)

    with Workers(procedure) as crew:
        predicted = crew.build(prediction.decode())
        row("predicted", predicted, 0.0)
        for name in ("paper", "fidelity"):
            judge = Judge.of(references, sw.Settings(seed=seed, judge=name))
            started = time.perf_counter()
            criterion = judge.criterion(range(len(shapes)), judge.nearest(predicted)[1])
            vectors = refine(SearchStart(prediction), criterion, crew, QUICK, seed)
            row(f"searched, judge {name}", crew.build(vectors), time.perf_counter() - started)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("procedure", type=Path)
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--rounds", type=int, default=1)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--objectives", action="store_true")
    arguments = parser.parse_args()
    procedure = sw.load_procedure(arguments.procedure)
    references = sw.Collection.of(
        {
            f"{Path(folder).parent.name}-{reference.name}": reference.shape
            for folder in arguments.folders
            for reference in sw.Collection.load(folder)
        }
    )
    if arguments.objectives:
        objectives(procedure, references, arguments.seed)
        return
    judge = Judge.of(references, sw.Settings(judge="paper"))

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
        settings = sw.Settings(seed=arguments.seed, refine=refined, rounds=rounds, judge="paper")
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
