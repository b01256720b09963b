"""What is found of an object from one silhouette, seen by a camera that nobody knows.

    python benchmarks/views.py [table chair shelf bed] [--count 24] [--seed 0] [--json] [--sheet DIR]

References are samples of examples/categories that the network has not learned from, each seen from a random place of
``rendering.anywhere``. They are fitted with the default settings. By category, and of all:

choices: right, of those that the picture tells. A parameter of classes is told where each other value, with all else as
    it is, changes the silhouette in that view by more than 2 % of IoU.
MAE: of the scalars that the picture tells, normalised: those where a step of a quarter of the Range changes as much.
in view: share replicated by the judge of pictures; IoU of the silhouettes, the median.
whole: share replicated by the judge of meshes, who sees all sides.
camera: median errors of azimuth and elevation in degrees.
"""

import argparse
import json
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.judging.judge import Judge
from shapewright.rendering.anywhere import random_places
from shapewright.rendering.framed import framed
from shapewright.shapes.views import SIDE, View, Views

ROOT = Path(__file__).resolve().parents[1] / "examples" / "categories"
VERSIONS = {"table": "v4", "chair": "v4", "shelf": "v3", "bed": "v3"}
TOLD = 0.02  # of IoU
QUARTER = 0.25  # of a Range


@dataclass
class Score:
    """What was counted of a category."""

    right: list[bool] = field(default_factory=list)  # of the choices that are told
    wrong: list[str] = field(default_factory=list)  # names of those that are not right
    errors: list[float] = field(default_factory=list)
    replicated: list[bool] = field(default_factory=list)
    whole: list[bool] = field(default_factory=list)
    iou: list[float] = field(default_factory=list)
    azimuth: list[float] = field(default_factory=list)
    elevation: list[float] = field(default_factory=list)
    seconds: float = 0.0

    def row(self) -> dict[str, float]:
        return {
            "choices": float(np.mean(self.right)),
            "told": len(self.right),
            "MAE": float(np.mean(self.errors)),
            "in view": float(np.mean(self.replicated)),
            "whole": float(np.mean(self.whole)),
            "IoU": float(np.median(self.iou)),
            "azimuth": float(np.median(self.azimuth)),
            "elevation": float(np.median(self.elevation)),
            "seconds": round(self.seconds),
        }


def seen(mesh: sw.Mesh, place: np.ndarray) -> np.ndarray:
    return framed(mesh.normalised(), place[None], 160, 2)[0] / 255.0


def differs(procedure: sw.Procedure, values: dict, reference: np.ndarray, place: np.ndarray) -> bool:
    """Whether other parameters look different from there; such as cannot be built look different."""
    try:
        other = seen(procedure(**values), place)
    except sw.Infeasible:
        return True
    return 1.0 - np.minimum(other, reference).sum() / np.maximum(other, reference).sum() > TOLD


def compared(procedure: sw.Procedure, truth: dict, found: dict, place: np.ndarray, score: Score) -> None:
    space, picture = procedure.space, seen(procedure(**truth), place)
    for name in space.active(truth):
        parameter = space[name]
        if parameter.classes:
            others = [level for level in parameter.levels or () if level != truth[name]]
            if all(differs(procedure, space.canonical({**truth, name: level}), picture, place) for level in others):
                score.right.append(found[name] == truth[name] and name in space.active(found))
                score.wrong += [] if score.right[-1] else [f"{name} {truth[name]} -> {found[name]}"]
            continue
        at = parameter.encode(truth[name])
        moved = parameter.decode(at + QUARTER if at <= 1.0 - QUARTER else at - QUARTER)
        if name in space.active(found) and differs(procedure, {**truth, name: moved}, picture, place):
            score.errors.append(abs(parameter.encode(found[name]) - at))


def run(category: str, count: int, settings: sw.Settings, sheet: Path | None) -> Score:
    procedure = sw.load_procedure(ROOT / category / f"{VERSIONS[category]}.py")
    learned = procedure.space.sample(settings.samples, seed=settings.seed)
    known, truths, meshes = {tuple(values.values()) for values in learned}, [], []
    for values in procedure.space.sample(4 * count, seed=settings.seed + 1000):
        if tuple(values.values()) in known or len(meshes) == count:
            continue
        try:
            meshes.append(procedure(**values).normalised())
            truths.append(values)
        except sw.Infeasible:
            continue
    places = random_places(count, np.random.default_rng([settings.seed, 7]))
    masks = [framed(mesh, place[None], SIDE, 1)[0] for mesh, place in zip(meshes, places, strict=True)]
    references = sw.Collection.of({f"{i:03d}": Views((View(mask),)) for i, mask in enumerate(masks)})
    started = time.perf_counter()
    iteration = sw.fit(procedure, references, settings)
    score = Score(seconds=time.perf_counter() - started)
    print(f"    {dict(iteration.seconds)}", flush=True)
    builds = [procedure(**result.parameters) for result in iteration]
    judge = Judge.of(sw.Collection.of({f"{i:03d}": mesh for i, mesh in enumerate(meshes)}), settings)
    fidelities = judge.fidelities(builds)
    in_view = Judge.of(references, settings)
    for i, result in enumerate(iteration):
        compared(procedure, truths[i], result.parameters, places[i], score)
        camera = in_view.targets[i].in_view(builds[i]).places[0]
        apart = abs(camera - places[i])
        score.azimuth.append(apart[0])
        score.elevation.append(apart[1])
        score.replicated.append(result.grade == "replicated")
        score.whole.append(fidelities[i] >= settings.replicated)
        score.iou.append(result.iou)
        if sheet:
            _save(sheet / f"{category}-{i:03d}.png", masks[i], builds[i], camera, places[i], meshes[i])
    return score


def _save(path, mask, replica, camera, place, truth) -> None:
    from PIL import Image

    path.parent.mkdir(parents=True, exist_ok=True)
    row = [mask, framed(replica.normalised(), camera[None], SIDE, 1)[0]]
    row += [framed(mesh, np.array([[40.0, 25.0, 0.3]]), SIDE, 1)[0] for mesh in (truth, replica.normalised())]
    Image.fromarray(255 - np.concatenate(row, axis=1)).save(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(VERSIONS)}; default: all")
    parser.add_argument("--count", type=int, default=24)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--refine", choices=("off", "quick", "thorough"), default="quick")
    parser.add_argument("--samples", type=int, default=sw.Settings.samples)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--json", action="store_true")
    parser.add_argument(
        "--sheet", type=Path, help="folder for pictures: reference and replica, then both from one side"
    )
    arguments = parser.parse_args()
    settings = sw.Settings(
        seed=arguments.seed, workers=arguments.workers, refine=arguments.refine, samples=arguments.samples
    )
    rows = {}
    for category in arguments.categories or VERSIONS:
        score = run(category, arguments.count, settings, arguments.sheet)
        rows[category] = score.row()
        print(category, "  ".join(f"{name} {value:.3g}" for name, value in rows[category].items()), flush=True)
        print("    wrong: " + "; ".join(score.wrong), flush=True)
    if arguments.json:
        print(json.dumps(rows))


if __name__ == "__main__":
    main()
