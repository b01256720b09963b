"""The categories of examples/, version by version, on open furniture and cuboid assemblies.

    python benchmarks/categories.py table chair --workers 2
    python benchmarks/categories.py table --versions v3 --out runs

A row a version: references compatible at 0.18 and mean IoU of both sets, fitted in one iteration with the default
settings; mean absolute error of the scalars (normalised) and least F1 of the other parameters, by the network alone on
held-out samples; number of parameters. --out keeps the runs with their reports, as DIR/CATEGORY-VERSION.
"""

import argparse
import time
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.report import write_report
from shapewright.runs.folder import check_free
from shapewright.runs.result import Result
from shapewright.storage import cache_folder

ROOT = Path(__file__).resolve().parents[1]
SETS = {
    "bed": ("furniture/bed",),
    "chair": ("furniture/chair", "cuboids/chair"),
    "shelf": ("furniture/shelf", "cuboids/storage"),
    "table": ("furniture/table", "cuboids/table"),
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("categories", nargs="*", metavar="CATEGORY", help=f"of {', '.join(SETS)}; default: all")
    parser.add_argument("--versions", nargs="*", help="such as v1 v3; default: all")
    parser.add_argument("--references", type=Path, default=ROOT.parent / "shared" / "data" / "references")
    parser.add_argument("--out", type=Path, help="folder that keeps the runs")
    parser.add_argument("--refine", choices=("off", "quick", "thorough"), default="quick")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    arguments = parser.parse_args()
    if unknown := set(arguments.categories) - set(SETS):
        parser.error(f"no category {', '.join(sorted(unknown))}; there are {', '.join(SETS)}")
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers, refine=arguments.refine)
    print(f"{'':<10}{'furniture (IoU)':>20}{'cuboids (IoU)':>20}{'MAE':>8}{'F1':>7}{'parameters':>12}{'seconds':>9}")
    for category in arguments.categories or SETS:
        collections = [sw.Collection.load(arguments.references / name) for name in SETS[category]]
        for path in sorted((ROOT / "examples" / "categories" / category).glob("v*.py")):
            if not arguments.versions or path.stem in arguments.versions:
                print(row(category, path, collections, settings, arguments.out), flush=True)


def row(category: str, path: Path, collections: list[sw.Collection], settings: sw.Settings, out: Path | None) -> str:
    procedure, names = sw.load_procedure(path), SETS[category]
    shapes = {
        f"{Path(name).parent}/{reference.name}": reference.shape
        for name, collection in zip(names, collections, strict=True)
        for reference in collection
    }
    folder = out / f"{category}-{path.stem}" if out else None
    if folder:
        check_free(folder)
    started = time.perf_counter()
    iteration = sw.fit(procedure, sw.Collection.of(shapes), settings, cache=cache_folder())
    seconds = time.perf_counter() - started
    if folder:
        iteration.save(folder, write_report)
    scores = iteration.metrics["validation"].values()
    mae = np.mean([score["mae"] for score in scores if "mae" in score])
    f1 = min((score["f1"] for score in scores if "f1" in score), default=np.nan)
    kinds = [[result for result in iteration if result.name.startswith(kind)] for kind in ("furniture", "cuboids")]
    cells = [counted(results) for results in kinds]
    return (
        f"{category} {path.stem:<{9 - len(category)}}{cells[0]:>20}{cells[1]:>20}"
        f"{mae:>8.4f}{f1:>7.3f}{len(procedure.space):>12}{seconds:>9.0f}"
    )


def counted(results: list[Result]) -> str:
    """How many are compatible, the share, and the mean IoU."""
    if not results:
        return "-"
    compatible = sum(result.compatible for result in results)
    iou = np.nanmean([result.iou for result in results])
    return f"{compatible}/{len(results)} {compatible / len(results):.0%} ({iou:.2f})"


if __name__ == "__main__":
    main()
