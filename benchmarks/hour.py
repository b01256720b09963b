"""An hour of authoring by suggestions alone, beside one by hand.

    python benchmarks/hour.py                              # the first suggestion applied, up to five times, each kind
    python benchmarks/hour.py --kind vessels --steps 2     # one kind, fewer times
    python benchmarks/hour.py --hand                       # the versions written by hand instead

Each kind begins with benchmarks/hour/KIND/v1.py, a page of code. It is fitted and explained. The suggestion that is
shown first is written to a copy in a temporary folder, and that is fitted, from the run before, with the default
settings. By hand: v2.py to v6.py, one edit each. A row a version: references replicated and close, the mean fidelity,
seconds that the author waits for fit and explanation, and what the edit was. --out keeps runs (of --hand; what is
there is not fitted again) and the changed files.
"""

import argparse
import random
import shutil
import tempfile
import time
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.report import write_report
from shapewright.rules.library import library
from shapewright.storage import cache_folder

ROOT = Path(__file__).resolve().parents[1]
DATA = ROOT.parent / "shared" / "data" / "references"
LARGE = 40  # of a larger kind a half drawn at random is used


@dataclass(frozen=True)
class Hour:
    """A kind of shapes, and the procedures written for it."""

    kind: str
    folders: tuple[str, ...]  # of references, within ``DATA``
    own: tuple[
        str, ...
    ]  # bundled rules for this kind: they are left out, so that the library does not answer with them

    @property
    def versions(self) -> list[Path]:
        """The first version, and those after each edit by hand."""
        return sorted((ROOT / "benchmarks" / "hour" / self.kind).glob("v*.py"))

    def references(self) -> sw.Collection:
        found = {r.name: r.shape for folder in self.folders for r in sw.Collection.load(DATA / folder)}
        names = sorted(found)
        if len(names) > LARGE:
            names = sorted(random.Random(0).sample(names, len(names) // 2))
        return sw.Collection.of({name: found[name] for name in names})


KINDS = (
    Hour("vessels", ("vessels",), ("vessels",)),
    Hour("buildings", ("buildings",), ("buildings",)),
    Hour("lamps", ("furniture/lamp",), ("lamps",)),
    Hour("sofas", ("furniture/sofa", "furniture/lounger"), ("cabinets",)),
    Hour("trees", ("trees",), ("plants",)),
    Hour("chairs", ("furniture/chair",), ("cabinets", "supports")),
)


def suggested(hour: Hour, steps: int, settings: sw.Settings, out: Path | None) -> Iterator[str]:
    """A row for the first version and for each after a suggestion."""
    references, path, edit, iteration, known = hour.references(), hour.versions[0], "", None, {}
    with tempfile.TemporaryDirectory() as folder:
        for step in range(steps + 1):
            began = time.perf_counter()
            procedure = sw.load_procedure(path)
            iteration = sw.fit(procedure, references, settings, None, cache_folder(), iteration, known)
            fitted = time.perf_counter()
            rules = library(without=hour.own)
            made = sw.explain(iteration, procedure, references, rules=rules).suggestions if step < steps else ()
            explained = time.perf_counter() - fitted
            yield row(hour, f"{step}", iteration, fitted - began, f"{explained:.0f}" if step < steps else "", edit)
            if not made:
                if step < steps:
                    yield f"| {hour.kind}, {step + 1} | | | | | | nothing is suggested |"
                break
            known = {name: [values] for name, values in made[0].tried["parameters"].items()}
            edit, path = made[0].title, Path(folder) / f"step{step + 1}.py"
            path.write_text(made[0].source, encoding="utf-8")
            if out:
                keep = out / f"{hour.kind}-suggested"
                keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(path, keep)
                (keep / f"step{step + 1}.png").write_bytes(made[0].picture)


def by_hand(hour: Hour, steps: int, settings: sw.Settings, out: Path | None) -> Iterator[str]:
    """A row for each version; what an edit was is the first line of the file."""
    references, iteration = hour.references(), None
    for path in hour.versions[: steps + 1]:
        began, run = time.perf_counter(), out / f"{hour.kind}-{path.stem}" if out else None
        if run and run.exists():
            iteration = sw.Iteration.load(run)
        else:
            procedure = sw.load_procedure(path)
            iteration = sw.fit(procedure, references, settings, cache=cache_folder(), previous=iteration)
            if run:
                iteration.save(run, write_report)
        edit = path.read_text(encoding="utf-8").split("\n")[0].strip('"').split(": ")[-1]
        yield row(hour, path.stem, iteration, time.perf_counter() - began, "", edit)


def row(hour: Hour, version: str, iteration: sw.Iteration, fitted: float, explained: str, edit: str) -> str:
    count = len(iteration)
    replicated, close = len(iteration.replicated), len(iteration.close)
    fidelity = np.mean([np.nan_to_num(result.fidelity) for result in iteration])
    shares = f"{replicated} ({replicated / count:.0%}) | {close} ({close / count:.0%})"
    return f"| {hour.kind} of {count}, {version} | {shares} | {fidelity:.2f} | {fitted:.0f} | {explained} | {edit} |"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kind", choices=[hour.kind for hour in KINDS], help="default: all")
    parser.add_argument("--steps", type=int, default=5)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--hand", action="store_true", help="the versions written by hand")
    parser.add_argument("--out", type=Path)
    arguments = parser.parse_args()
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers)
    print("| version | replicated | close | fidelity | fit, s | explain, s | edit |")
    print(7 * "|---" + "|")
    for hour in KINDS:
        if arguments.kind in (None, hour.kind):
            for line in (by_hand if arguments.hand else suggested)(hour, arguments.steps, settings, arguments.out):
                print(line, flush=True)


if __name__ == "__main__":
    main()
