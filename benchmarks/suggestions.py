"""What suggestions are worth: rules taken out of a procedure, and a real collection improved by suggestions alone.

    python benchmarks/suggestions.py rules                    # 12 rules removed, one row each
    python benchmarks/suggestions.py rules --only pedestal    # those whose name holds this
    python benchmarks/suggestions.py steps examples/tables/v1.py ../shared/data/references/furniture/table

``rules``: for each rule, shapes of the full procedure whose parameters the one without the rule cannot take; all others
it replicates exactly. Lost are those that a long search, from what it can take over of their parameters, does not
replicate either: so many are searched, a dozen at a time, that --count are lost. Restored are those of them that a
suggestion makes replicated, by --judge (fidelity, or paper): in the little search that tries it, without a network;
and in a fit with default settings once it is applied, as an author does, of the first three until one reaches 80 %.
With --json FILE what was measured before is not measured again, but for rules named by --only. ``steps``: fit, apply
the first suggestion, and again; further collections may follow, and ``--against FILE`` names a procedure to compare
with. Options: --seed, --workers, --out folder for pictures and snippets, --fast for a smaller network.
"""

import argparse
import json
import math
import os
import re
import sys
import tempfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

import shapewright as sw
from shapewright.building import Build, Workers
from shapewright.feedback.case import Case, Replica
from shapewright.feedback.causes.better_replicas import covering_replicas, measured, nearest_replicas
from shapewright.feedback.explanation import explain
from shapewright.feedback.suggestions import suggestions
from shapewright.feedback.surfaces.placement import Overlay
from shapewright.feedback.surfaces.residuals import residuals
from shapewright.feedback.surfaces.visible_surface import VisibleSurface
from shapewright.judging.judge import Judge
from shapewright.parameters import Parameters, Prediction

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
SAMPLED = 4000
ENOUGH = 0.8  # of what is lost
BATCH, MOST = 12, 96  # shapes searched for at once, and at most
NOTHING = sw.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
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


FIVE, TWO = "tables/v5.py", "categories/table/v2.py"
TABLE, CHAIR = "categories/table/v3.py", "categories/chair/v3.py"
TIERS = "    tiers: Annotated[int, Range(0, 2, when=room_for_tiers)] = 0,\n"
BACK = """    yield back.bend(angle, "x", towards="z", fixed=0.5).path(*leaning).tag("back")\n"""
THICKNESS = "    back_thickness: Annotated[float, Range(0.02, 0.2)] = 0.05,\n"
RULES: dict[str, tuple[str, Edit]] = {
    "tables: stretchers": (FIVE, without(', "support"')),
    "tables: pedestal and foot": (FIVE, without(', "pedestal"')),
    "tables: trestles": (FIVE, without(', "split"')),
    "tables: breadth, lower half": (FIVE, limited("breadth", 0.7, 1.0)),
    "table: columns": (TABLE, without('"column", ')),
    "table: star feet": (TABLE, without(', "star"')),
    "table: low heights": (TABLE, limited("height", 0.7, 1.5)),
    "table: tiers": (
        TABLE,
        then(
            without(TIERS),
            without("**locals()", instead="tiers=0, **locals()"),
            without("p.tiers > 0", instead="False"),
            without("p.tiers == 0", instead="True"),
        ),
    ),
    "table: chests": (TWO, without(', "chest"')),
    "chair: legs": (CHAIR, then(without('"legs", '), without('] = "legs"', instead='] = "sled"'))),
    "chair: star feet": (CHAIR, without('"star", ')),
    "chair: backs": (
        CHAIR,
        then(without(THICKNESS, BACK), without("back_thickness=back_thickness", instead="back_thickness=0.05")),
    ),
}


def reduced(example: Path, edit: Edit, folder: Path):
    source = example.read_text(encoding="utf-8")
    path = folder / example.name
    path.write_text(edit(source), encoding="utf-8")
    return sw.load_procedure(path)


def concerned(full: sw.Procedure, cut: sw.Procedure, seed: int) -> list[Build]:
    """Shapes of the whole procedure whose parameters the one without the rule cannot take."""
    vectors = [v for v in full.space.sample(SAMPLED, seed + 1000) if not taken(full.space, cut.space, v)]
    with Workers(full, 1) as crew:
        return [build for build in crew.build(vectors[:MOST]) if isinstance(build.shape, sw.Mesh)]


def taken(full: sw.ParameterSpace, cut: sw.ParameterSpace, values: Parameters) -> bool:
    """Whether all that matters is there in the other space, too."""
    there = {**full.defaults, **cut.carry(values)}
    return all(there[n] == values[n] or _near(there[n], values[n]) for n in full.active(values))


def _near(a: object, b: object) -> bool:
    return isinstance(a, float) and isinstance(b, float) and math.isclose(a, b, rel_tol=1e-6)


def searched(
    procedure: sw.Procedure, builds: list[Build], crew: Workers, settings: sw.Settings
) -> list[tuple[Build, Replica]]:
    """The shapes that a search from the parameters taken over does not replicate, and their nearest replicas."""
    space, judge = procedure.space, Judge.of(gathered(builds), settings)
    starts = [space.carry(build.parameters) for build in builds]
    asked = list(enumerate(starts))
    known = [
        replica or Replica(row, start, NOTHING, np.inf)
        for replica, (row, start) in zip(measured(asked, crew, judge), asked, strict=True)
    ]
    best = nearest_replicas(known, Prediction.of(space, starts, doubt=0.4), crew, judge)
    return [(b, replica) for b, replica in zip(builds, best, strict=True) if replica.apart > 1.0]


def explained(procedure: sw.Procedure, lost: list[tuple[Build, Replica]], crew: Workers, judge: Judge) -> list[Case]:
    """What is lost, each with the replica that has most of its surface in common."""
    references = judge.references.references
    known = [replace(replica, row=row) for row, (_, replica) in enumerate(lost)]
    surfaces = [VisibleSurface.of(references[replica.row].shape.normalised()) for replica in known]
    overlays = [Overlay(surface, replica.mesh) for surface, replica in zip(surfaces, known, strict=True)]
    space = procedure.space
    prediction = Prediction.of(space, [space.carry(build.parameters) for build, _ in lost], doubt=0.4)
    covering = covering_replicas(known, overlays, prediction, crew, judge)
    return [lost_one(references[near.row], near, like) for near, like in zip(known, covering, strict=True)]


def gathered(builds: list[Build]) -> sw.Collection:
    return sw.Collection.of({f"reference-{i:03d}": build.shape for i, build in enumerate(builds)})


def lost_one(reference, nearest: Replica, covering: Replica) -> Case:
    where = residuals(reference.shape, covering.mesh)
    case = Case.of(reference.name, reference.shape, False, nearest, where)
    return replace(case, covering=covering)


def rules(arguments: argparse.Namespace) -> None:
    done = json.loads(arguments.json.read_text()) if arguments.json and arguments.json.exists() else {}
    print("| rule removed | lost | restored by the first, and once fitted | second | third | best share | CPU s |")
    print(7 * "|---" + "|")
    for name, (example, edit) in RULES.items():
        if arguments.only and arguments.only not in name:
            continue
        if name not in done or arguments.only:
            done[name] = rule(name, arguments.examples / example, edit, arguments)
            if arguments.json:
                arguments.json.write_text(json.dumps(done, indent=1))
        told = done[name]
        made = [f"{s['gain']}, {s.get('fitted', '–')}, {s['kind']}" for s in told["suggestions"][:3]] + ["–"] * 3
        share = restored(told)
        cells = [name, f"{told['lost']} of {told['concerned']}", *made[:3], f"{share:.0%}", f"{told['seconds']:.0f}"]
        print(f"| {' | '.join(cells)} |", flush=True)
    print(f"\n{sum(restored(told) >= ENOUGH for told in done.values())} of {len(done)} rules restored to 80 % or more")


def restored(told: dict[str, Any]) -> float:
    """The share of what is lost that the best of the first three suggestions restores, when it is fitted."""
    return max((s.get("fitted", s["gain"]) for s in told["suggestions"][:3]), default=0) / max(told["lost"], 1)


def rule(name: str, example: Path, edit: Edit, arguments: argparse.Namespace) -> dict[str, Any]:
    """One rule removed: references lost without it, and what each suggestion restores."""
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers, judge=arguments.judge)
    before = cpu_seconds()
    with tempfile.TemporaryDirectory() as folder:
        procedure = reduced(example, edit, Path(folder))
        builds, tried, lost = concerned(sw.load_procedure(example), procedure, arguments.seed), 0, []
        with Workers(procedure, settings.workers) as crew:
            while len(lost) < arguments.count and tried < len(builds):
                batch = builds[tried : tried + BATCH]
                lost += searched(procedure, batch, crew, settings)
                tried += len(batch)
            judge = Judge.of(gathered([build for build, _ in lost]), settings)
            made = suggestions(procedure, explained(procedure, lost, crew, judge), crew, judge)[0] if lost else ()
        told = []
        for number, s in enumerate(made):
            told.append({"kind": s.kind, "title": s.title, "gain": s.gain, "after": s.tried["after"]})
            if number < 3 and not any(one.get("fitted", 0) >= ENOUGH * len(lost) for one in told):
                told[-1]["fitted"] = fitted(s, example, gathered([build for build, _ in lost]), settings, Path(folder))
    keep(arguments.out, re.sub(r"\W+", "-", name), made)
    seconds = cpu_seconds() - before
    return {"lost": len(lost), "concerned": tried, "suggestions": told, "seconds": seconds}


def fitted(suggestion, example: Path, references: sw.Collection, settings: sw.Settings, folder: Path) -> int:
    """How many references a fit with default settings replicates once the suggestion is applied."""
    path = folder / f"suggested-{example.name}"
    path.write_text(suggestion.source, encoding="utf-8")
    known = {name: [values] for name, values in suggestion.tried["parameters"].items()}
    return len(sw.fit(sw.load_procedure(path), references, settings, known=known).replicated)


def cpu_seconds() -> float:
    """Of this process and those it started that have ended."""
    return sum(os.times()[:4])


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
            last = step == arguments.steps
            made = () if last else explain(iteration, procedure, references).suggestions
            if not made:
                print()
                break
            print(f"; {made[0].title}: {made[0].gain}", flush=True)
            keep(arguments.out, f"step-{step}", made[:3])
            path = Path(folder) / f"step{step}.py"
            path.write_text(made[0].source, encoding="utf-8")
            previous = iteration


FAST = {"samples": 1200, "epochs": 6}


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
    one.add_argument("--count", type=int, default=6)
    one.add_argument("--json", type=Path)
    one.add_argument("--judge", choices=("fidelity", "paper"), default="fidelity")
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
