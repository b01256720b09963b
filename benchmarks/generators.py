"""Whether known parameters come back: references that a generator made with another seed, written as STL without names.

    .venv-adapters/bin/python benchmarks/generators.py examples/generators/stool.py ... [--references 20] [--seed 1000]
        [--within SECONDS]

For each generator: the mean absolute error of each scalar as a share of its Range, F1 of each other parameter (the mean
over the classes that occur), how many references are replicated, and the time. Settings are the defaults, but
for the time that a fit may take.
"""

from __future__ import annotations

import argparse
import csv
import tempfile
import time
from pathlib import Path

import numpy as np
from sklearn.metrics import f1_score

import shapewright as sw
from shapewright.fitting.samples import write_samples


def recovered(path: str, count: int, seed: int, within: float | None) -> None:
    """Print a row of the table, and one for each parameter."""
    generator = sw.load_procedure(path)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "references"
        write_samples(generator, count, folder, "stl", seed)
        with (folder / "manifest.csv").open(encoding="utf-8") as table:
            truth = {Path(row["path"]).stem: row for row in csv.DictReader(table) if row["path"]}
        started = time.perf_counter()
        iteration = sw.fit(generator, sw.Collection.load(str(folder / "*.stl")), sw.Settings(within=within))
        seconds = time.perf_counter() - started
    errors, scores = {}, {}
    for parameter in generator.space:
        name = parameter.name
        rows = [key for key in truth if name in iteration[key].active]
        found, known = [iteration[key].parameters[name] for key in rows], [truth[key][name] for key in rows]
        if parameter.classes:
            found = [str(value) for value in found]
            scores[name] = f1_score(known, found, labels=sorted(set(known)), average="macro")
        else:
            errors[name] = float(np.mean(np.abs(np.array(found) - np.array(known, dtype=float)))) / (
                parameter.high - parameter.low
            )
    replicated = f"{len(iteration.replicated)} of {len(iteration)}"
    mae = f"{np.mean(list(errors.values())):.3f}" if errors else "-"
    f1 = f"{np.mean(list(scores.values())):.2f}" if scores else "-"
    print(f"| {generator.name} | {mae} | {f1} | {replicated} | {seconds:.0f} s |", flush=True)
    print("   ", {name: round(value, 4) for name, value in (errors | scores).items()}, flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("generators", nargs="+")
    parser.add_argument("--references", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1000)
    parser.add_argument("--within", type=float)
    chosen = parser.parse_args()
    for path in chosen.generators:
        recovered(path, chosen.references, chosen.seed, chosen.within)


if __name__ == "__main__":
    main()
