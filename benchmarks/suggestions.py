"""What suggestions are worth: rules taken out of a procedure, and a real collection improved by suggestions alone.

    python benchmarks/suggestions.py rules                    # 12 rules removed, one row each
    python benchmarks/suggestions.py rules --only pedestal    # those whose name holds this
    python benchmarks/suggestions.py steps examples/tables/v1.py ../shared/data/references/furniture/table

``rules``: for each rule, a synthetic collection from the full procedure; lost are the references that the procedure
without the rule cannot replicate, restored those of them that a suggestion makes compatible. The network is left out:
parameters are those of the most similar of 600 samples, refined. ``steps``: fit, apply the first suggestion, and again;
further collections may follow, and ``--against FILE`` names a procedure to compare with. Options: --count references,
--seed, --workers, --out folder for pictures and snippets, --fast for a smaller network.
"""

import argparse
import re
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.explanation import Explained, explain
from shapewright.feedback.placement import Overlay, place
from shapewright.feedback.residuals import residuals
from shapewright.feedback.search import Found, Searcher
from shapewright.feedback.suggestions import Suggestion, suggest
from shapewright.feedback.surface import Surface
from shapewright.judge import Judge
from shapewright.prediction.lookup import nearest as most_similar
from shapewright.rendering.cameras import THREE_VIEWS
from shapewright.rendering.raster import render

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SAMPLES = 600
Edit = Callable[[str], str]


def without(*texts: str, instead: str = "") -> Edit:
    """The source without these texts, each of which must be there."""

    def edit(source: str) -> str:
        for text in texts:
            assert text in source, f"the procedure has changed: {text!r} is not in it"
            source = source.replace(text, instead)
        return source

    return edit


def limited(parameter: str, low: float, high: float) -> Edit:
    """The source with a shorter Range, and its middle as the default."""

    def edit(source: str) -> str:
        pattern = rf"({parameter}: Annotated\[float, Range)\([^,]*, [^,)]*([^\n]*\]) = [0-9.]+"
        changed, count = re.subn(pattern, rf"\1({low}, {high}\2 = {(low + high) / 2}", source)
        assert count == 1, f"the procedure has changed: {parameter} has no Range as expected"
        return re.sub(rf"({parameter}: .*), steps=\w+", r"\1", changed)

    return edit


def then(*edits: Edit) -> Edit:
    def edit(source: str) -> str:
        for each in edits:
            source = each(source)
        return source

    return edit


FIVE, TABLE, CHAIR = "tables/v5.py", "table/v3.py", "chair/v3.py"
RULES: dict[str, tuple[str, Edit]] = {
    "stretchers": (FIVE, without(', "support"')),
    "pedestal and foot": (FIVE, without(', "pedestal"')),
    "trestles": (FIVE, without(', "split"')),
    "breadth, lower half": (FIVE, limited("breadth", 0.7, 1.0)),
    "table: columns": (TABLE, without('"column", ')),
    "table: star feet": (TABLE, without(', "star"')),
    "table: panels": (TABLE, without('"panels", ')),
    "table: low heights": (TABLE, limited("height", 0.7, 1.6)),
    "chair: plinths": (CHAIR, without(', "plinth"')),
    "chair: star feet": (CHAIR, without('"star", ')),
    "chair: pedestals": (CHAIR, without('"pedestal", ')),
    "chair: solid arms": (CHAIR, without(', "solid"')),
}


def reduced(example: Path, edit: Edit, folder: Path):
    source = example.read_text(encoding="utf-8")
    path = folder / example.name
    path.write_text(edit(source), encoding="utf-8")
    return sw.load_procedure(path)


def collection(example: Path, count: int, seed: int) -> sw.Collection:
    full = sw.load_procedure(example)
    with Workers(full, 1) as crew:
        builds = crew.build(full.space.sample(2 * count, seed + 1000))
    shapes = [build.shape for build in builds if isinstance(build.shape, sw.Mesh)]
    return sw.Collection.of({f"reference-{i:03d}": shape for i, shape in enumerate(shapes[:count])})


def searched(procedure, references, crew, judge, settings) -> list[Explained]:
    """The references that a search from the most similar sample does not replicate, with the nearest shapes."""
    builds = [b for b in crew.build(procedure.space.sample(SAMPLES, settings.seed)) if isinstance(b.shape, sw.Mesh)]
    pictures = render([b.shape for b in builds], THREE_VIEWS, 64, threads=settings.workers)
    theirs = render([reference.shape for reference in references], THREE_VIEWS, 64, threads=settings.workers)
    rows = list(range(len(references)))
    starts = [builds[i].parameters for i in most_similar(theirs, pictures)]
    searcher = Searcher(procedure.space, crew, judge, settings.seed)
    known = [
        f or Found(p, builds[0].shape, np.inf) for f, p in zip(searcher.measured(rows, starts), starts, strict=True)
    ]
    inferred = doubtful(procedure.space, starts)
    best = searcher.longer(rows, inferred, known)
    lost = [row for row in rows if best[row].distance > settings.threshold]
    overlays = {row: overlay(references.references[row].shape, best[row].mesh) for row in lost}
    laid = searcher.laid(lost, [column[lost] for column in inferred], [best[row] for row in lost], overlays)
    return [lost_one(references.references[row], row, best[row], like) for row, like in zip(lost, laid, strict=True)]


def overlay(reference: sw.Mesh, replica: sw.Mesh) -> Overlay:
    theirs, ours = Surface.of(reference.normalised()), Surface.of(replica.normalised())
    return Overlay(theirs, [place(theirs, ours)[0]])


def doubtful(space, starts) -> list[np.ndarray]:
    """Parameters in the form of a prediction that is not sure of them."""
    columns = []
    for parameter in space:
        values = np.array([parameter.encode(start[parameter.name]) for start in starts], dtype=np.float32)
        if parameter.classes:
            likely = np.full((len(starts), parameter.classes), 0.4 / parameter.classes, dtype=np.float32)
            likely[np.arange(len(starts)), values.astype(int)] += 0.6
            values = likely
        columns.append(values)
    return columns


def lost_one(reference, row: int, nearest: Found, like: Found) -> Explained:
    misfit = residuals(reference.shape, like.mesh)
    return Explained(reference.name, row, reference.shape, False, nearest, misfit, nearest, like, misfit)


def rules(arguments: argparse.Namespace) -> None:
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers)
    told = "restored by the first, second, third suggestion"
    print(f"{'rule removed':<24}{'lost':>5}  {told:<50}{'best':>6}{'seconds':>9}")
    for name, (example, edit) in RULES.items():
        if arguments.only and arguments.only not in name:
            continue
        full = arguments.examples / example
        references = collection(full, arguments.count, arguments.seed)
        with tempfile.TemporaryDirectory() as folder:
            procedure = reduced(full, edit, Path(folder))
            judge = Judge.of(references, settings)
            with Workers(procedure, settings.workers) as crew:
                lost = searched(procedure, references, crew, judge, settings)
                started = time.perf_counter()
                made = suggest(procedure, lost, crew, judge, limit=5)
                seconds = time.perf_counter() - started
        shares = [suggestion.gain / max(len(lost), 1) for suggestion in made[:3]]
        cells = ", ".join(f"{s.gain} ({s.kind})" for s in made[:3])
        print(f"{name:<24}{len(lost):>5}  {cells:<50}{max(shares, default=0):>6.0%}{seconds:>9.0f}", flush=True)
        keep(arguments.out, re.sub(r"\W+", "-", name), made)


def steps(arguments: argparse.Namespace) -> None:
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers, **(FAST if arguments.fast else {}))
    loaded = {source: sw.Collection.load(source) for source in arguments.collections}
    references = sw.Collection.of({f"{s}|{r.name}": r.shape for s, refs in loaded.items() for r in refs})
    if arguments.against:
        iteration = sw.fit(sw.load_procedure(arguments.against), references, settings)
        print(f"{arguments.against}: {len(iteration.compatible)} of {len(references)}", flush=True)
    previous, path = None, arguments.procedure
    with tempfile.TemporaryDirectory() as folder:
        for step in range(arguments.steps + 1):
            procedure = sw.load_procedure(path)
            iteration = sw.fit(procedure, references, settings, previous=previous)
            counts = [sum(n.startswith(f"{s}|") for n in iteration.compatible) for s in loaded]
            cells = ", ".join(f"{count} of {len(refs)}" for count, refs in zip(counts, loaded.values(), strict=True))
            print(f"step {step}: {len(iteration.compatible)} of {len(references)} ({cells})", end="", flush=True)
            made: list[Suggestion] = []
            if step < arguments.steps:
                explain(procedure, references, iteration, suggest=recording(made))
            if not made:
                print()
                break
            print(f"; {made[0].title}: {made[0].gain}", flush=True)
            keep(arguments.out, f"step-{step}", made[:3])
            path = Path(folder) / f"step{step}.py"
            path.write_text(made[0].source, encoding="utf-8")
            previous = iteration


FAST = {"samples": 1200, "epochs": 6}


def recording(made: list[Suggestion]):
    def hook(procedure, wanting, crew, judge, stages):
        made.extend(suggest(procedure, wanting, crew, judge, stages))
        return [suggestion.record for suggestion in made]

    return hook


def keep(out: Path | None, stem: str, made) -> None:
    if out is None:
        return
    out.mkdir(parents=True, exist_ok=True)
    for number, suggestion in enumerate(made, start=1):
        (out / f"{stem}-{number}.png").write_bytes(suggestion.picture)
        text = f'"""{suggestion.kind}: {suggestion.title}\n\n{suggestion.text}\n"""\n\n{suggestion.snippet}'
        (out / f"{stem}-{number}.snippet.py").write_text(text, encoding="utf-8")
        (out / f"{stem}-{number}.py").write_text(suggestion.source, encoding="utf-8")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--out", type=Path)
    commands = parser.add_subparsers(required=True)
    one = commands.add_parser("rules")
    one.add_argument("--only")
    one.add_argument("--count", type=int, default=40)
    one.add_argument("--examples", type=Path, default=EXAMPLES)
    one.set_defaults(run=rules)
    two = commands.add_parser("steps")
    two.add_argument("procedure", type=Path)
    two.add_argument("collections", nargs="+")
    two.add_argument("--steps", type=int, default=5)
    two.add_argument("--against", type=Path)
    two.add_argument("--fast", action="store_true")
    two.set_defaults(run=steps)
    arguments = parser.parse_args()
    arguments.run(arguments)


if __name__ == "__main__":
    sys.exit(main())
