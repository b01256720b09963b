"""How often the right cause is told: tables whose procedure lost a rule, has a Range cut short, or is badly predicted.

    python benchmarks/causes.py [--count 24] [--seed 0] [--fit] [--json FILE] [--only WORDS]

Each case takes a collection that the whole procedure (examples/tables/v5.py) built at random parameters, spoils the
procedure, or what was found, in one way, and explains the references that are then incompatible. Without --fit the
iteration is made from the true parameters, carried over to the spoilt procedure and refined at length, which takes no
training; with it the spoilt procedure is fitted, as an author would.

One row a case: misfits, the chief cause that is right, how many have it, what the others have. A reference that the
spoilt procedure replicates with other parameters is none: nothing is lost for it. Then precision and recall of each
cause over all cases.
"""

import argparse
import json
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

import shapewright as sw
from shapewright.building import Workers
from shapewright.feedback.case import Replica
from shapewright.feedback.causes.better_replicas import NEAREST, measured, nearest_replicas, with_fields
from shapewright.feedback.explanation import explain
from shapewright.judging.judge import Judge
from shapewright.judging.target import Measures
from shapewright.judging.verdict import grade_of
from shapewright.modelling.solids import Solid, box, cylinder, sphere
from shapewright.parameters import Parameters, Prediction
from shapewright.runs.result import Result
from shapewright.search.budgets import QUICK

WHOLE = Path(__file__).parent.parent / "examples" / "tables" / "v5.py"
LEGS = 'Literal["basic", "support", "pedestal", "split"] = "basic"'
Of = Callable[[Parameters], bool]


@dataclass(frozen=True)
class Case:
    """What is done to the procedure's text, or to what is found; which references it concerns; what it should say.

    reformed: what is done to the text of the procedure that builds the references.
    """

    name: str
    right: tuple[str, ...]
    concerns: Of = lambda p: True
    edits: tuple[tuple[str, str], ...] = ()
    reformed: tuple[tuple[str, str], ...] = ()
    spoil: str = ""
    foreign: bool = False


def without(option: str) -> tuple[tuple[str, str], ...]:
    kept = [f'"{other}"' for other in ("basic", "support", "pedestal", "split") if other != option]
    return ((LEGS, f"Literal[{', '.join(kept)}] = {kept[0]}"),)


def cut(text: str, short: str) -> tuple[tuple[str, str], ...]:
    low, high = (float(end) for end in short[6:-1].split(",")[:2])
    line = next(line for line in WHOLE.read_text().splitlines() if text in line)
    annotation = line[line.index("Range(") : line.index(")]") + 1]
    default = line.split("=")[-1].split(",")[0].strip()
    inside = min(max(float(default), low), high)
    return ((line, line.replace(annotation, short).replace(f"= {default},", f"= {inside},")),)


CASES = (
    Case("no stretchers", ("missing part",), lambda p: p["legs"] == "support", without("support")),
    Case("no pedestal", ("missing part",), lambda p: p["legs"] == "pedestal", without("pedestal")),
    Case("no trestle", ("missing part",), lambda p: p["legs"] == "split", without("split")),
    Case("stretchers always", ("surplus part",), lambda p: p["legs"] == "basic", without("basic")),
    Case(
        "no round tops",
        ("wrong form",),
        lambda p: bool(p["round_top"]),
        (("    round_top: bool = False,\n", ""), ("    thick =", "    round_top = False\n    thick =")),
    ),
    Case(
        "no leaning legs",
        ("wrong form",),
        lambda p: p["legs"] == "basic",
        reformed=(("at=(x, 0, z)).label", "at=(x, 0, z)).path((0.8 * side - x, 0, 0.8 * side - z), (0, 0, 0)).label"),),
    ),
    Case(
        "no sloping tops",
        ("wrong form",),
        reformed=(('.label("top")', '.rotate(20, "z", about=(0, height / 2, 0)).label("top")'),),
    ),
    Case("height to 0.65", ("out of range",), lambda p: p["height"] > 0.7, cut("height:", "Range(0.5, 0.65)")),
    Case("breadth to 0.55", ("out of range",), lambda p: p["breadth"] > 0.6, cut("breadth:", "Range(0.3, 0.55)")),
    Case("breadth from 0.7", ("out of range",), lambda p: p["breadth"] < 0.6, cut("breadth:", "Range(0.7, 1.0)")),
    Case(
        "tops to 0.1", ("out of range",), lambda p: p["top_thickness"] > 0.12, cut("top_thickness:", "Range(0.05, 0.1)")
    ),
    Case(
        "legs to 0.1", ("out of range",), lambda p: p["leg_thickness"] > 0.12, cut("leg_thickness:", "Range(0.05, 0.1)")
    ),
    Case("scalars spoilt", ("badly predicted",), spoil="scalars"),
    Case("choices spoilt", ("wrong choice",), spoil="choices"),
    Case("other shapes", ("not such a shape",), foreign=True),
)


def foreign(count: int, seed: int) -> Iterator[tuple[str, Solid]]:
    """Lamps, chairs and bottles."""
    rng = np.random.default_rng(seed)
    for i in range(count):
        a, b, c = rng.uniform(0.7, 1.3, 3)
        if i % 3 == 0:
            lamp = cylinder((0.05, 1.6 * a, 0.05)) | cylinder((0.4 * b, 0.04, 0.4 * b), at=(0, -0.8 * a, 0))
            yield f"lamp {i}", lamp | sphere(0.45 * c, at=(0, 0.8 * a, 0))
        elif i % 3 == 1:
            back = box((0.5, 0.8 * a, 0.05), at=(0, 0.4 * a, -0.22 * b))
            yield f"chair {i}", back | box((0.5, 0.4 * c, 0.5 * b), at=(0, -0.2 * c, 0))
        else:
            yield f"bottle {i}", cylinder((0.4 * b, 1.0 * a, 0.4 * b)) | cylinder((0.14 * c, 1.6 * a, 0.14 * c))


def collection(case: Case, folder: Path, count: int, seed: int) -> tuple[sw.Collection, dict[str, Parameters]]:
    """References that the case concerns, and half as many of any kind."""
    whole = changed(case.reformed, folder / "whole.py")
    vectors = whole.space.sample(40 * count, seed=seed)
    some = [vector for vector in vectors if case.concerns(vector)][:count]
    rest = [vector for vector in vectors if vector not in some][: count // 2]
    truth = {f"{'case' if i < len(some) else 'rest'} {i:03d}": vector for i, vector in enumerate(some + rest)}
    shapes = {name: whole(**vector) for name, vector in truth.items()}
    if case.foreign:
        shapes |= {name: solid.mesh() for name, solid in foreign(max(3, count // 4), seed)}
    return sw.Collection.of(shapes), truth


def changed(edits: Iterable[tuple[str, str]], path: Path) -> sw.Procedure:
    """The whole procedure with changes of its text."""
    text = WHOLE.read_text()
    for before, after in edits:
        assert before in text, before
        text = text.replace(before, after)
    path.write_text(text)
    return sw.load_procedure(path)


def badly(procedure: sw.Procedure, values: Parameters, how: str, rng: np.random.Generator) -> Parameters:
    """What a bad predictor would say."""
    encoded = procedure.space.encode(values)
    for column, parameter in enumerate(procedure.space):
        if how == "scalars" and not parameter.classes:
            encoded[column] = (encoded[column] + rng.uniform(0.3, 0.7)) % 1.0
        if how == "choices" and parameter.name == "legs":
            encoded[column] = (encoded[column] + rng.integers(1, parameter.classes)) % parameter.classes
    return procedure.space.canonical(procedure.space.decode(encoded))


def made(
    case: Case, procedure: sw.Procedure, references: sw.Collection, truth: dict[str, Parameters], settings: sw.Settings
) -> sw.Iteration:
    """The iteration that a long refinement from the true parameters gives, or the spoilt ones themselves.

    What it replicates is not lost without the rule, so that no cause is asked for.
    """
    rng = np.random.default_rng(settings.seed)
    space = procedure.space
    start = [space.carry(truth[name]) if name in truth else space.defaults for name in references.names]
    if case.spoil:
        start = [badly(procedure, values, case.spoil, rng) for values in start]
    judge = Judge.of(references, settings)
    rows = list(range(len(references)))
    with Workers(procedure, settings.workers) as crew:
        nothing = sw.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))
        asked = list(zip(rows, start, strict=True))
        known = [
            replica or Replica(row, values, nothing, np.inf)
            for replica, (row, values) in zip(measured(asked, crew, judge), asked, strict=True)
        ]
        if not case.spoil:
            prediction = Prediction.of(space, start, doubt=1.0)
            known = nearest_replicas(known, prediction, crew, judge, replace(QUICK, spread=NEAREST.spread))
            known = nearest_replicas(with_fields(known, judge), prediction, crew, judge, NEAREST)
    results = tuple(
        Result(
            name=reference.name,
            path=None,
            parameters=found.parameters,
            active=space.active(found.parameters),
            at_limit=space.at_limit(found.parameters),
            replica=found.mesh,
            measured=Measures(found.distance, fidelity=found.fidelity),
            grade=grade_of(found.fidelity, settings),
            compatible=found.distance <= settings.threshold,
            group=None,
            reference=reference.shape,
        )
        for reference, found in zip(references, known, strict=True)
    )
    return sw.Iteration(results, judge.metric, (), settings, {}, {}, "", {}, {}, {}, "")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=24, help="references that a case concerns")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int)
    parser.add_argument("--fit", action="store_true", help="fit the spoilt procedure instead of starting at the truth")
    parser.add_argument("--only", default="", help="cases whose name holds these words")
    parser.add_argument("--json", type=Path)
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    settings = sw.Settings(seed=arguments.seed, workers=arguments.workers)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for number, case in enumerate(case for case in CASES if arguments.only in case.name):
            place = Path(folder) / str(number)
            place.mkdir()
            procedure = changed(case.edits, place / "procedure.py")
            references, truth = collection(case, place, arguments.count, arguments.seed)
            if arguments.fit and not case.spoil:
                iteration = replace(sw.fit(procedure, references, settings), predictor=None)
            else:
                iteration = made(case, procedure, references, truth, settings)
            started = time.perf_counter()
            explanation = explain(iteration, procedure, references, suggest=False)
            seconds = time.perf_counter() - started
            concerned = [
                each
                for each in explanation.references.values()
                if each.causes and ((each.name not in truth) if case.foreign else case.concerns(truth[each.name]))
            ]
            lost = [each for each in concerned if case.spoil or each.nearest.apart > 1.0]
            kinds = Counter(each.causes[0].kind for each in lost)
            rows.append((case, kinds))
            right = sum(kinds[kind] for kind in case.right)
            others = ", ".join(f"{kind} {n}" for kind, n in kinds.most_common() if kind not in case.right)
            print(
                f"{case.name:20} {len(lost):3} misfits of {len(concerned):3}  {case.right[0]:17} {right:3}   {others}"
                f"   [{len(iteration.misfits)} of {len(iteration)} explained in {seconds:.0f} s]",
                flush=True,
            )
            if arguments.verbose:
                for each in concerned:
                    known = (each.replica, each.covering, each.nearest, each.outside)
                    print(f"    {each.name}", *(f"{replica.apart:.2f}" for replica in known), end=" ")
                    print(" | ".join(f"{cause.kind}: {cause.text}" for cause in each.causes))
    print("\n| cause | told | rightly | precision | right ones | recall |\n|---|---|---|---|---|---|")
    for kind in dict.fromkeys(case.right[0] for case in CASES):
        told = sum(kinds[kind] for _, kinds in rows)
        rightly = sum(kinds[kind] for case, kinds in rows if kind in case.right)
        there = sum(sum(kinds.values()) for case, kinds in rows if kind in case.right)
        share = f"{rightly / told:.2f}" if told else "–"
        found = f"{rightly / there:.2f}" if there else "–"
        print(f"| {kind} | {told} | {rightly} | {share} | {there} | {found} |")
    if arguments.json:
        arguments.json.write_text(json.dumps([{"case": c.name, "right": c.right, "told": k} for c, k in rows]))


if __name__ == "__main__":
    main()
