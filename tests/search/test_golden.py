"""What searches find, to the bit. ``python tests/search/test_golden.py`` writes the file anew.

References, prediction and measure are synthetic: a change of how shapes are rendered or judged does not touch them.
"""

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
import pytest
import shapely

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.building import Workers
from shapewright.parameters import Prediction
from shapewright.rendering.ink import coverage
from shapewright.search.budgets import DRAWN, DRAWN_THOROUGH, QUICK, THOROUGH, Budget
from shapewright.search.moves import Probe, Return, Scan, Step, SwitchChoices, UseScale
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine

FILE = Path(__file__).with_suffix(".json")
CORNERS = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
FACES = np.array(
    [
        *([0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1]),
        *([2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]),
    ]
)
GRID = np.stack(np.meshgrid(*[np.linspace(-0.6, 0.6, 9)] * 3, indexing="ij"), axis=-1)


@sw.procedure
def stand(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    top: Annotated[float, Range(0.3, 1.0)] = 0.8,
    thickness: Annotated[float, Range(0.05, 0.3)] = 0.1,
    shelves: Annotated[int, Range(0, 3)] = 0,
    foot: Literal["post", "sled", "block"] = "post",
    back: bool = False,
    rise: Annotated[float, Range(0.1, 0.5, when=lambda p: p.back)] = 0.3,
):
    if foot == "block" and top < 0.4:
        raise Infeasible("too small a block")
    width = {"post": thickness, "sled": top, "block": 0.7 * top}[foot]
    depth = {"post": thickness, "sled": thickness, "block": 0.7 * top}[foot]
    boxes = [(width, height, depth, 0.0, 0.0), (top, thickness, top, height, 0.0)]
    boxes += [(0.8 * top, 0.05, 0.8 * top, height * (i + 1) / (shelves + 1), 0.0) for i in range(shelves)]
    if back:
        boxes.append((top, rise, 0.05, height + thickness, top / 2))
    vertices = [CORNERS * box[:3] + [-box[0] / 2, box[3] - 0.6, box[4] - box[2] / 2] for box in boxes]
    return np.concatenate(vertices), np.concatenate([FACES + 8 * i for i in range(len(boxes))])


@sw.procedure
def desk(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    leg: Annotated[float, Range(0.02, 0.15)] = 0.1,
    inset: Annotated[float, Range(0.0, 0.25)] = 0.0,
    bars: Annotated[int, Range(0, 2)] = 0,
    side: Literal["legs", "panel"] = "legs",
    drawer: bool = False,
):
    boxes = [shapely.box(0, height - 0.06, 1, height)]
    if side == "panel":
        boxes.append(shapely.box(inset, height / 4, 1 - inset, height - 0.06))
    boxes += [shapely.box(x, 0, x + leg, height) for x in (inset, 1 - inset - leg)]
    boxes += [shapely.box(inset, height * (i + 1) / 4, 1 - inset, height * (i + 1) / 4 + 0.03) for i in range(bars)]
    if drawer:
        boxes.append(shapely.box(0.3, height - 0.25, 0.7, height))
    return sw.Drawing(shapely.union_all(boxes))


@sw.procedure
def slab(height: Annotated[float, Range(0.3, 1.0)] = 0.6, top: Annotated[float, Range(0.3, 1.0)] = 0.8):
    return CORNERS * (top, height, 0.5) - (top / 2, 0.6, 0.25), FACES


STANDS = [
    {"height": 0.8, "top": 0.5, "thickness": 0.12, "shelves": 2, "foot": "sled", "back": True, "rise": 0.2},
    {"height": 0.45, "top": 0.9, "thickness": 0.08, "shelves": 0, "foot": "block", "back": False, "rise": 0.3},
    {"height": 0.6, "top": 0.62, "thickness": 0.2, "shelves": 1, "foot": "post", "back": True, "rise": 0.45},
]
DESKS = [
    {"height": 0.85, "leg": 0.03, "inset": 0.05, "bars": 1, "side": "legs", "drawer": True},
    {"height": 0.45, "leg": 0.05, "inset": 0.2, "bars": 0, "side": "panel", "drawer": False},
    {"height": 0.7, "leg": 0.12, "inset": 0.11, "bars": 2, "side": "legs", "drawer": False},
]


def filled(mesh):
    """(729,): how much of the boxes is about each point of the grid; by sums and quotients alone."""
    cells = np.zeros(GRID.shape[:3])
    for box in mesh.vertices.reshape(-1, 8, 3):
        inside = np.minimum(GRID - box.min(axis=0), box.max(axis=0) - GRID) / 0.15 + 0.5
        cells += np.clip(inside, 0.0, 1.0).prod(axis=-1)
    return cells.ravel() * 20.0


def drawn(drawing):
    """(1364,): the picture's means over blocks of 16, 8, 4 and 2 pixels."""
    sharp = coverage(drawing, 64) * 56.0
    blocks = [sharp.reshape(64 // k, k, 64 // k, k).mean(axis=(1, 3)) * k for k in (16, 8, 4, 2)]
    return np.concatenate([block.ravel() for block in blocks])


SCALES = tuple(slice(start, end) for start, end in ((0, 16), (16, 80), (80, 336), (336, 1360)))


def measure_against(shapes, picture):
    targets = [picture(shape) for shape in shapes]
    return lambda pairs: [picture(shape) - targets[i] for i, shape in pairs]


def guessed(space, truth, seed):
    """A prediction in single precision, as a network gives: near the truth, and sure of a wrong class at times."""
    rng = np.random.default_rng(seed)
    encoded, columns = np.array([space.encode(values) for values in truth]), []
    for column, parameter in zip(encoded.T, space, strict=True):
        if parameter.classes:
            shares = rng.dirichlet(np.full(parameter.classes, 0.6), len(truth))
            shares[np.arange(len(truth)), column.astype(int)] += 0.3
            columns.append((shares / shares.sum(axis=1, keepdims=True)).astype(np.float32))
        else:
            columns.append(np.clip(column + 0.12 * rng.standard_normal(len(truth)), 0.0, 1.0).astype(np.float32))
    return Prediction(space, tuple(columns))


CLOSER = Budget(
    (Scan(6), Probe(2, rival=1.25), Step(2, scatter=4, rival=1.25), *(Step(1, scatter=5),) * 10),
    patience=2,
    spread=0.2,
)
OTHERS = Budget(
    (
        *(Scan(4), Probe(2), Step(2, scatter=2), Probe(1, 0.05, both=True, again=True), Step(1, 3)),
        *(
            SwitchChoices("single"),
            Scan(6),
            Probe(3, rival=3.0),
            Step(2, 3, 1, rival=3.0),
            Return(2),
            Step(2, scatter=4),
        ),
        *(SwitchChoices("defaults"), Scan(5), Probe(2), Step(2, 1), Return(1), Step(1, scatter=2)),
        *(SwitchChoices("likely"), Scan(8), Probe(2, rival=2.0), Return(1), Step(1, 3)),
    ),
    simple=2,
)
SCALED = Budget(
    (
        *(Scan(3), Probe(2), UseScale(1, keep=2), Step(2), UseScale(2, keep=2), Step(2)),
        *(UseScale(3, keep=1), *(Step(1),) * 9),
    )
)


def numbers(space, truth, by):
    """Other starts that are known: the true choices, with numbers off by some share of their Ranges."""
    encoded = [
        np.where(space.scalars, np.clip(space.encode(values) + by, 0.0, 1.0), space.encode(values)) for values in truth
    ]
    return [space.canonical(space.decode(vector)) for vector in encoded]


def limits(space, truth):
    encoded = np.array([space.encode(values) for values in truth])
    free = np.array([name not in ("top", "rise") for name in space.names])
    return np.where(free, np.maximum(encoded - 0.05, 0.0), encoded), np.where(free, 1.0, encoded)


def cases():
    """By name: procedure, true parameters, and what the search is asked."""
    space = stand.space
    known, within = [*numbers(space, STANDS, 0.0)[:1], None, *numbers(space, STANDS, 0.03)[2:]], limits(space, STANDS)
    uncut = {"parts": SCALES}
    yield "quick", stand, {"budget": QUICK, "surprise_cost": 5.0, "goal": 900.0}
    yield "thorough", stand, {"budget": THOROUGH, "surprise_cost": 5.0, "goal": 900.0}
    yield "thorough, enough", stand, {"budget": THOROUGH, "surprise_cost": 0.5, "enough": 60.0}
    yield "known", stand, {"budget": QUICK, "known": known, "goal": 900.0}
    yield "known and new", stand, {"budget": QUICK, "known": known, "new": {"height"}, "goal": 900.0}
    yield "known and nothing new", stand, {"budget": QUICK, "known": known, "new": set(), "goal": 900.0}
    yield "within", stand, {"budget": CLOSER, "within": within, "known": known}
    yield "others", stand, {"budget": replace(OTHERS, spread=0.06), "surprise_cost": 1.0}
    yield "others, cut", stand, {"budget": OTHERS.within(60, 4)}
    yield "drawn", desk, {"budget": DRAWN, **uncut}
    yield "drawn, enough", desk, {"budget": DRAWN, "enough": 100.0, **uncut}
    yield "drawn, cut", desk, {"budget": DRAWN.within(100, 3), **uncut}
    yield "drawn, cut while the best rests", desk, {"budget": DRAWN_THOROUGH.within(220, 3), **uncut}
    yield "drawn, thorough", desk, {"budget": DRAWN_THOROUGH, "known": [None, DESKS[1]], **uncut}
    yield "scaled", desk, {"budget": SCALED, **uncut}
    yield "scaled, patient", desk, {"budget": replace(SCALED, patience=1), **uncut}
    yield "no other choice", slab, {"budget": THOROUGH.within(300, 2), "surprise_cost": 5.0}
    yield "no other choice drawn", slab, {"budget": DRAWN, "parts": tuple(slice(k, None) for k in (0, 200, 400, 600))}


def found(name):
    """What the search gives, numbers as Python writes them, and how many shapes it has measured."""
    procedure, asked = next((procedure, asked) for case, procedure, asked in cases() if case == name)
    flat = procedure is desk
    truth = [{n: values[n] for n in procedure.space.names} for values in (DESKS if flat else STANDS)]
    truth = truth[: 2 if "thorough" in name else None]
    measure, count = measure_against([procedure(**values) for values in truth], drawn if flat else filled), [0]

    def counting(pairs):
        count[0] += len(pairs)
        return measure(pairs)

    with Workers(procedure, 1) as crew:
        start = {name: asked.pop(name) for name in ("known", "new", "within") if name in asked}
        budget = asked.pop("budget")
        start = SearchStart(guessed(procedure.space, truth, 7), **start)
        vectors = refine(start, Criterion(counting, **asked), crew, budget, seed=3)
    return {"shapes": count[0], "parameters": [{n: repr(v) for n, v in vector.items()} for vector in vectors]}


def spent():
    """Shapes that budgets pay for, by the number of scalars, and where they are cut."""
    budgets = {"quick": QUICK, "thorough": THOROUGH, "drawn": DRAWN, "drawn thorough": DRAWN_THOROUGH}
    return {
        name: {
            "evaluations": [budget.evaluations(scalars) for scalars in (0, 1, 4, 9)],
            "cut": [budget.within(most, 4).evaluations(4) for most in (0, 5, 30, 100, 300, 1000, 1e9)],
        }
        for name, budget in budgets.items()
    }


def arithmetic():
    """Sums of products differ in their last bits between processors; what is found here is theirs."""
    rng = np.random.default_rng(0)
    return repr([float(np.dot(*rng.standard_normal((2, size)))) for size in (729, 1360)])


@pytest.mark.parametrize("name", [name for name, *_ in cases()])
def test_a_search_finds_the_same_parameters_to_the_bit(name):
    golden = json.loads(FILE.read_text(encoding="utf-8"))
    if golden["arithmetic"] != arithmetic():
        pytest.skip("another processor wrote the file")
    assert found(name) == golden["found"][name]


def test_budgets_pay_for_the_same_shapes():
    assert spent() == json.loads(FILE.read_text(encoding="utf-8"))["spent"]


if __name__ == "__main__":
    golden = {"arithmetic": arithmetic(), "spent": spent(), "found": {name: found(name) for name, *_ in cases()}}
    FILE.write_text(json.dumps(golden, indent=1) + "\n", encoding="utf-8")
