"""Mutated files of every format, each read in a process with limits: what crashes, hangs, eats memory or lies.

    python benchmarks/fuzzing.py --seed 0 --count 10000
    python benchmarks/fuzzing.py --seed 0 --count 500 --format ply --format stl
    python benchmarks/fuzzing.py --seed 0 --first 2000 --count 2000

Small valid files of each format are mutated: bytes flipped, pieces cut, doubled, inserted, numbers raised, two files
spliced, what a file declares changed. Worker processes read each within 5 seconds of CPU and 1 GB. What comes out is
counted:

- read, noted, refused: the shape, the shape with notes, or a reason
- crash: the process ended, or a reason that shows an error of Python ("broken: KeyError: ...")
- hang, memory: the limits were reached
- size: the shape is read without a note, and is not what the file says: it is another shape although only the end was
  cut off, or although only a number was changed that declares how much the file holds; or it is 10 times as large as
  the largest file that was mutated although no number was touched. Not counted in OBJ, XYZ and .splat, which declare
  nothing: rows without a header, of which fewer are a file as good

Findings are kept in the folder of ``--keep``.
"""

from __future__ import annotations

import argparse
import os
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

from fuzzed_files import FORMATS, Mutant, mutated
from shapewright.processes import Limits, Loss
from shapewright.processes.calls import Calls
from shapewright.references import CollectionError, Reference
from shapewright.references.archives import _Job, _unpacked
from shapewright.references.reading import attempt
from shapewright.references.sources import find
from shapewright.shapes import Drawing, Mesh

SECONDS = 5.0
"""Of CPU that a file may take."""
LIMITS = Limits(seconds=60.0, memory_mb=1024)  # wall time: other programs may hold the cores
AT_ONCE = 200
SAYS_NOTHING = ("obj", "xyz", "splat")
"""Formats that declare neither how much they hold nor where they end."""
_NOTHING_LOST = ("normals estimated", "Gaussian splats: their centres")
"""Beginnings of notes that points have which are read as they are."""
_LOST = {"time": "hang", "memory": "memory", "crash": "crash"}
_SHOWN_ERROR = re.compile(r"broken: (\w*(?:Error|Exception|Iteration|Warning)\b.*)")


class Outcome(NamedTuple):
    """What came of a file.

    kind: a column of the table.
    why: the reason, or the notes.
    size: the largest extent.
    count: of faces or points.
    seconds: of CPU.
    """

    kind: str
    why: str = ""
    size: float = 0.0
    count: int = 0
    seconds: float = 0.0


def look(path: Path) -> Outcome:
    """Read a file; called in the processes that read."""
    started = time.process_time()
    outcome = unpacked(path)
    return outcome._replace(seconds=time.process_time() - started)


def unpacked(path: Path) -> Outcome:
    if path.suffix != ".zip":
        return seen(path)
    with tempfile.TemporaryDirectory() as folder:
        why = _unpacked(_Job(path, Path(folder), 2**26))
        return Outcome("refused", why) if why else seen(Path(folder))


def seen(path: Path) -> Outcome:
    try:
        found = [attempt(source) for source in find([path])]
    except CollectionError as error:
        return Outcome("refused", str(error))
    read = [one for one in found if isinstance(one, Reference)]
    if not read:
        return Outcome("refused", "; ".join(map(str, found)))
    match read[0].shape:
        case Mesh(faces=faces):
            count = len(faces)
        case Drawing():
            count = 1
        case points:
            count = len(points.positions)
    lost = [note for note in read[0].notes if not note.startswith(_NOTHING_LOST)]
    kind = "noted" if lost or len(read) < len(found) else "read"
    return Outcome(kind, " | ".join(lost), 1.0 / read[0].transform.scale, count)


def outcomes(paths: list[Path], calls: Calls[Path, Outcome]) -> Iterator[Outcome]:
    for result in calls.results([(path, LIMITS) for path in paths]):
        if isinstance(result, Loss):
            yield Outcome(_LOST[result.kind], result.message)
        elif result.seconds > SECONDS:
            yield Outcome("hang", f"{result.seconds:.1f} s")
        elif result.kind == "refused" and (shown := _SHOWN_ERROR.search(result.why)):
            yield Outcome("memory" if "MemoryError" in result.why else "crash", shown[1])
        else:
            yield result


def lies(kind: str, mutant: Mutant, outcome: Outcome, known: list[Outcome]) -> bool:
    """Whether a shape that was read without a note is not what its file says."""
    if outcome.kind != "read" or kind in SAYS_NOTHING:
        return False
    before = known[mutant.seed]
    other = (outcome.size, outcome.count) != (before.size, before.count)
    touched = mutant.changes & {"flip", "number", "word", "count"}
    large = not touched and outcome.size > 10 * max(one.size for one in known)
    return large or (other and mutant.changes in ({"cut"}, {"count"}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="number of the first file, to go on")
    parser.add_argument("--count", type=int, default=1000, help="files over all formats")
    parser.add_argument("--format", action="append", choices=FORMATS, help="one or several; default: all")
    parser.add_argument("--keep", type=Path, help="a folder for the files with findings")
    options = parser.parse_args()
    kinds = options.format or list(FORMATS)
    tables = {kind: Counter[str]() for kind in kinds}
    told: Counter[str] = Counter()
    os.environ["PYTHONPATH"] = os.pathsep.join([str(Path(__file__).resolve().parent), os.environ.get("PYTHONPATH", "")])
    os.environ["PYTHONWARNINGS"] = "ignore"
    import fuzzing  # under this name the processes find it

    started = time.time()
    with tempfile.TemporaryDirectory() as name, Calls(fuzzing.look) as calls:
        folder = Path(name)
        known: dict[str, list[Outcome]] = {}
        for kind in kinds:
            paths = [folder / f"seed{i}.{kind}" for i in range(len(FORMATS[kind]()))]
            for path, data in zip(paths, FORMATS[kind](), strict=True):
                path.write_bytes(data)
            list(outcomes(paths, calls))  # kernels are compiled once
            known[kind] = list(outcomes(paths, calls))
            if wrong := [one for one in known[kind] if one.kind not in ("read", "noted")]:
                sys.exit(f"a file of {kind} is not read as it is: {wrong[0]}")
        last = options.first + options.count
        for first in range(options.first, last, AT_ONCE):
            mutants = {}
            for number in range(first, min(first + AT_ONCE, last)):
                kind = kinds[number % len(kinds)]
                path = folder / f"{number}.{kind}"
                mutants[path] = kind, mutated(kind, np.random.default_rng([options.seed, number]))
                path.write_bytes(mutants[path][1].data)
            for path, outcome in zip(mutants, outcomes(list(mutants), calls), strict=True):
                kind, mutant = mutants[path]
                if lies(kind, mutant, outcome, known[kind]):
                    outcome = Outcome("size", f"{sorted(mutant.changes)}: size {outcome.size:g}, {outcome.count} faces")
                tables[kind][outcome.kind] += 1
                if outcome.kind in ("crash", "hang", "memory", "size"):
                    told[f"{kind} {outcome.kind}: {re.sub('[0-9]+', '#', outcome.why)[:110]}"] += 1
                    if options.keep:
                        options.keep.mkdir(parents=True, exist_ok=True)
                        (options.keep / path.name).write_bytes(mutant.data)
                path.unlink()
    columns = ("read", "noted", "refused", "crash", "hang", "memory", "size")
    print(f"| format | {' | '.join(columns)} |\n|---|{'---|' * len(columns)}")
    for kind in kinds:
        print(f"| {kind} | {' | '.join(str(tables[kind][column]) for column in columns)} |")
    print(f"{options.count} files in {time.time() - started:.0f} s")
    for what, count in told.most_common(40):
        print(f"{count:5} {what}")


if __name__ == "__main__":
    main()
