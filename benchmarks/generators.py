"""Whether known parameters come back: references that a generator made with another seed, written as STL without names.

    .venv-adapters/bin/python benchmarks/generators.py examples/generators/stool.py ... [--references 20] [--seed 1000]
        [--within SECONDS]

For each generator: the mean absolute error of each scalar as a share of its Range, F1 of each other parameter (the mean
over the classes that occur), both of what can be seen in a reference and the share of the parameters that can, how many
references are replicated, and the time. Settings are the defaults, but for the time that a fit may take.
"""

from __future__ import annotations

import argparse
import csv
import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.metrics import f1_score

import shapewright as sw
from shapewright.fitting.samples import write_samples
from shapewright.parameters import Parameters, ParameterSpace
from shapewright.rendering.surround import Surround

SEEN, STEP = 20, 0.01
"""Pixels of the 14 pictures of ``Surround``, of 57,344, by which a shape has to change; how much nearer or farther a
pixel is then, in units of the largest extent."""


def recovered(path: str, count: int, seed: int, within: float | None) -> None:
    """Print a row of the table, and one for each parameter."""
    generator = sw.load_procedure(path)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "references"
        write_samples(generator, count, folder, "stl", seed)
        with (folder / "manifest.csv").open(encoding="utf-8") as table:
            truth = {
                Path(row["path"]).stem: values(generator.space, row) for row in csv.DictReader(table) if row["path"]
            }
        started = time.perf_counter()
        iteration = sw.fit(generator, sw.Collection.load(str(folder / "*.stl")), sw.Settings(within=within))
        seconds = time.perf_counter() - started
    errors, scores, hidden = {}, {}, []
    shown = {key: seen(generator, known) for key, known in truth.items()}
    for parameter in generator.space:
        name = parameter.name
        rows = [key for key in truth if name in shown[key]]
        found, known = [iteration[key].parameters[name] for key in rows], [truth[key][name] for key in rows]
        if not rows:
            hidden.append(name)
        elif parameter.classes:
            found, known = [str(value) for value in found], [str(value) for value in known]
            scores[name] = f1_score(known, found, labels=sorted(set(known)), average="macro")
        else:
            off = np.abs(np.array(found) - np.array(known, dtype=float))
            errors[name] = float(np.mean(off)) / (parameter.high - parameter.low)
    replicated = f"{len(iteration.replicated)} of {len(iteration)}"
    mae = f"{np.mean(list(errors.values())):.3f}" if errors else ""
    f1 = f"{np.mean(list(scores.values())):.2f}" if scores else ""
    told, asked = sum(map(len, shown.values())), sum(len(generator.space.active(known)) for known in truth.values())
    print(f"| {generator.name} | {mae} | {f1} | {told / asked:.0%} | {replicated} | {seconds:.0f} s |", flush=True)
    print("   ", {name: round(value, 4) for name, value in (errors | scores).items()}, "unseen:", hidden, flush=True)


def values(space: ParameterSpace, row: Mapping[str, str]) -> Parameters:
    """The parameters in a row of a manifest."""
    known: Parameters = {}
    for parameter in space:
        text = row[parameter.name]
        spelled = {str(value): value for value in _classes(parameter)}
        known[parameter.name] = spelled[text] if spelled else type(parameter.default)(float(text))
    return known


def seen(generator: sw.Procedure, known: Parameters) -> set[str]:
    """The parameters that matter to a shape and that pictures from all round tell.

    Each other class changes them, and a quarter of the Range to either side.
    """
    whole = _pictures(generator, known)
    names = set()
    for parameter in generator.space:
        if parameter.name in generator.space.active(known) and all(
            _differs(generator, {**known, parameter.name: other}, whole)
            for other in _others(parameter, known[parameter.name])
        ):
            names.add(parameter.name)
    return names


def _classes(parameter: Any) -> list[Any]:
    return [parameter.decode(number) for number in range(parameter.classes)]


def _others(parameter: Any, value: Any) -> list[Any]:
    if parameter.classes:
        return [other for other in _classes(parameter) if other != value]
    quarter = (parameter.high - parameter.low) / 4
    near = [value - quarter, value + quarter]
    return [type(value)(other) for other in near if parameter.low <= other <= parameter.high]


def _pictures(generator: sw.Procedure, known: Parameters) -> Any:
    shape = generator(**generator.space.canonical(known))
    assert isinstance(shape, sw.Mesh)
    return Surround.of(shape.normalised()).nearness


def _differs(generator: sw.Procedure, changed: Parameters, whole: Any) -> bool:
    """Whether a shape looks otherwise than pictures; one that cannot be built does."""
    try:
        other = _pictures(generator, changed)
    except (sw.ProcedureError, sw.Infeasible, ValueError):
        return True
    return int((np.abs(other - whole) > STEP).sum()) >= SEEN


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
