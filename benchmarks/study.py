"""The paper's study (section 6.2) without people: versions of a procedure, as authors would write them, one by one
against fifty drawings.

    python benchmarks/study.py
    python benchmarks/study.py --real ../shared/data/references/furniture/table ../shared/data/references/cuboids/table

For every version: how many drawings are replicated (VIF above 0.05) and the mean IoU of these, with the parameters that
``fit`` finds, with the defaults that the author wrote down, and with the best of random parameters after a blind search
of the same time. The drawings are the bundled ones, and with --real the front views of the first fifty meshes in these
folders as well: both are fitted at once, by one predictor, and counted apart. The paper: 34 of 50 replicated in two
hours with assistance, 12 without, IoU 92 %.
"""

import argparse
import time
from pathlib import Path

import numpy as np
from PIL import Image

import shapewright as sw
from shapewright.building import Build, Workers
from shapewright.demo import drawings
from shapewright.judging.judge import Judge
from shapewright.rendering.ink import coverage
from shapewright.rendering.projection import silhouette
from shapewright.report import write_report
from shapewright.runs.result import Result

EXAMPLES = Path(__file__).resolve().parents[1] / "examples" / "drawings"
CHUNK, SIDE = 256, 64


def front_views(folders: list[Path], count: int) -> sw.Collection:
    meshes = [reference for folder in folders for reference in sw.Collection.load(folder)][:count]
    return sw.Collection.of({mesh.name: silhouette(mesh.shape) for mesh in meshes})


def blind(procedure: sw.Procedure, references: sw.Collection, seconds: float, settings: sw.Settings) -> list[Build]:
    """For each reference the best of as many random shapes as can be built, drawn and compared in this time."""
    targets = pictures([reference.shape for reference in references])
    best: list[Build | None] = [None] * len(references)
    costs = np.full(len(references), np.inf)
    started, seed = time.perf_counter(), settings.seed
    with Workers(procedure, settings.workers) as crew:
        while time.perf_counter() - started < seconds:
            seed += 1
            builds = [build for build in crew.build(procedure.space.sample(CHUNK, seed=seed)) if build.shape]
            found = pictures([build.shape for build in builds])
            differences = np.abs(targets[:, None] - found[None]).sum(axis=2)
            for i, row in enumerate(differences):
                if row.min() < costs[i]:
                    best[i], costs[i] = builds[int(row.argmin())], row.min()
    return [build for build in best if build]


def pictures(shapes: list[sw.Drawing]) -> np.ndarray:
    return np.array([coverage(shape, SIDE).ravel() for shape in shapes], dtype=np.float32)


def sheet(results: list[Result], columns: int = 10, side: int = 120) -> Image.Image:
    """Each drawing and its replica over each other, worst first: grey is in both, red is missed, blue is too much."""
    rows = -(-len(results) // columns)
    picture = Image.new("RGB", (columns * side, rows * side), "white")
    for i, result in enumerate(sorted(results, key=lambda result: result.iou)):
        ours, theirs = (coverage(shape, side)[..., None] for shape in (result.replica, result.reference))
        both = np.minimum(ours, theirs)
        ink = both * (0.4, 0.4, 0.4) + (theirs - both) * (0.1, 0.9, 0.9) + (ours - both) * (0.9, 0.5, 0.1)
        tile = Image.fromarray((255 * np.clip(1.0 - ink, 0, 1)).astype(np.uint8))
        picture.paste(tile, (i % columns * side, i // columns * side))
    return picture


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--real", nargs="+", type=Path, help="folders of meshes, whose front views are replicated")
    parser.add_argument("--versions", nargs="+", default=["v1", "v2", "v3", "v4", "v5"])
    parser.add_argument("--refine", default="thorough", choices=["off", "quick", "thorough"])
    parser.add_argument("--samples", type=int, default=3000)
    parser.add_argument("--epochs", type=int, default=30)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--no-blind", action="store_true", help="leave out the blind search, half of the time")
    parser.add_argument("--misfits", action="store_true", help="list the drawings below 0.95 IoU")
    parser.add_argument("--out", type=Path, help="a folder that keeps what each version found, with a report")
    arguments = parser.parse_args()
    sets = {"bundled": drawings.tables()}
    if arguments.real:
        sets["real"] = {reference.name: reference.shape for reference in front_views(arguments.real, 50)}
    references = sw.Collection.of({f"{kind} {name}": d for kind, found in sets.items() for name, d in found.items()})
    settings = sw.Settings(
        seed=arguments.seed,
        samples=arguments.samples,
        epochs=arguments.epochs,
        refine=arguments.refine,
        workers=arguments.workers,
    )
    judge = Judge.of(references, settings)

    def score(builds: list[Build], kind: str) -> str:
        of_kind = np.array([name.startswith(kind) for name in references.names])
        distances = judge.distances(builds)
        replicated = of_kind & (distances <= judge.metric.threshold)
        iou = np.array([each.iou for each in judge.measures(builds, distances)])[replicated]
        return f"{replicated.sum():4d}, {iou.mean() if len(iou) else 0:.3f}, {int((iou >= 0.95).sum()):2d}"

    print("of 50 drawings: replicated, mean IoU of these, and how many at 0.95 IoU or more")
    columns = f"{'fit':>18}{'defaults':>18}{'blind search':>18}"
    print(f"{'version':<9}{'parameters':>10}{'drawings':>10}{'seconds':>9}{columns}", flush=True)
    for version in arguments.versions:
        procedure = sw.load_procedure(EXAMPLES / f"{version}.py")
        started = time.perf_counter()
        iteration = sw.fit(procedure, references, settings)
        seconds = time.perf_counter() - started
        if arguments.out:
            iteration.save(arguments.out / version, write_report)
            for kind in sets:
                found = [result for result in iteration if result.name.startswith(kind) and result.replica]
                sheet(found).save(arguments.out / f"{version}-{kind}.png", optimize=True)
        ways = [
            [Build(result.parameters or {}, result.replica) for result in iteration],
            [Build(procedure.space.defaults, procedure(**procedure.space.defaults))] * len(references),
        ]
        if not arguments.no_blind:
            ways.append(blind(procedure, references, seconds, settings))
        for kind in sets:
            cells = "".join(f"{score(way, kind):>18}" for way in ways)
            print(f"{version:<9}{len(procedure.space):>10}{kind:>10}{seconds:>9.0f}{cells}", flush=True)
        if arguments.misfits:
            for result in sorted(iteration, key=lambda result: result.iou):
                if not (result.compatible and result.iou >= 0.95):
                    print(f"  {result.name:<40}{result.distance:8.3f}{result.iou:8.3f}", flush=True)


if __name__ == "__main__":
    main()
