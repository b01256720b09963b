from dataclasses import replace
from typing import Annotated, Literal

import numpy as np
import pytest

import shapewright as sw
from shapewright import Infeasible, Range
from shapewright.building import Workers
from shapewright.comparison.light_field.aligned import AlignedCost
from shapewright.modelling.solids import box, cylinder
from shapewright.parameters import Prediction
from shapewright.search.budgets import QUICK, THOROUGH, Budget
from shapewright.search.candidates import others
from shapewright.search.moves import Continue, Probe, Return, Scan, Step, SwitchChoices, UseScale
from shapewright.search.objective import Criterion
from shapewright.search.search import SearchStart, refine


@sw.procedure
def post(
    height: Annotated[float, Range(0.2, 2.0)] = 1.0,
    width: Annotated[float, Range(0.1, 1.0)] = 0.5,
    form: Literal["square", "round", "bare"] = "square",
    cap: Annotated[float, Range(0.0, 1.0, when=lambda p: p.form != "bare")] = 0.5,
):
    if form == "bare" and width > 0.8:
        raise Infeasible("too wide to be bare")
    shaft = box((width / 2, height, width / 2))
    if form == "bare":
        return shaft
    return shaft | (cylinder if form == "round" else box)((1, 0.1, 0.3 + cap), at=(0, height / 2, 0))


def predicted(*rows):
    """As a network would give: (height, width, probabilities of the forms, cap), encoded."""
    return Prediction(post.space, tuple(np.array(column) for column in zip(*rows, strict=True)))


def measure_against(targets):
    costs = [AlignedCost(target) for target in targets]
    return lambda pairs: [costs[i].residual(mesh) for i, mesh in pairs]


SURE, MISTAKEN = [0.98, 0.01, 0.01], [0.6, 0.39, 0.01]


def test_refinement_finds_the_parameters_and_mends_a_wrong_choice():
    truth = [
        {"height": 1.4, "width": 0.3, "form": "square", "cap": 0.2},
        {"height": 0.5, "width": 0.6, "form": "round", "cap": 0.7},
    ]
    targets = [post(**values) for values in truth]
    start = predicted((0.6, 0.3, SURE, 0.3), (0.25, 0.45, MISTAKEN, 0.6))
    measure = measure_against(targets)
    criterion = Criterion(measure)
    with Workers(post, 1) as crew:
        quick = refine(SearchStart(start), criterion, crew, QUICK, seed=3)
        again = refine(SearchStart(start), criterion, crew, QUICK, seed=3)
        alone = refine(SearchStart(start.take([0])), criterion, crew, QUICK, seed=3)
        thorough = refine(SearchStart(start), Criterion(measure, enough=300.0), crew, THOROUGH, seed=3)
    assert quick == again and quick[0] == alone[0]
    assert [found["form"] for found in quick] == ["square", "round"]
    at_first = [post.space.decode(row) for row in ([0.6, 0.3, 0, 0.3], [0.25, 0.45, 0, 0.6])]
    for target, found, better, before in zip(targets, quick, thorough, at_first, strict=True):
        cost = AlignedCost(target)
        assert cost(post(**found)) < 0.6 * cost(post(**before))
        assert cost(post(**better)) < 0.2 * cost(post(**before))


def test_refinement_stays_within_the_limits_of_each_reference():
    limits = (
        np.array([[0.6, 0.2, 0.0, 0.1], [0.0, 0.0, 0.0, 0.4]]),
        np.array([[0.7, 0.3, 2.0, 0.4], [0.3, 0.6, 2.0, 0.9]]),
    )
    start = predicted((0.65, 0.3, SURE, 0.3), (0.25, 0.45, SURE, 0.6))
    measure = measure_against([post(height=0.3, width=0.9, cap=0.9), post(height=2.0, width=0.9, cap=0.0)])
    with Workers(post, 1) as crew:
        found = refine(SearchStart(start, within=limits), Criterion(measure), crew)
    for values, low, high in zip(found, *limits, strict=True):
        encoded = post.space.encode(values)[:2]
        assert (encoded >= low[:2] - 1e-9).all() and (encoded <= high[:2] + 1e-9).all()


def test_refinement_never_makes_it_worse():
    targets = [box((1, 0.2 * i, 0.5)).mesh() for i in range(1, 6)]
    rng = np.random.default_rng(0)
    start = predicted(*[(rng.random(), rng.random(), rng.dirichlet(np.ones(3)), rng.random()) for _ in targets])
    measure = measure_against(targets)
    with Workers(post, 1) as crew:
        found = refine(SearchStart(start), Criterion(measure), crew, QUICK.within(24, 3), seed=1)
        builds = crew.build([post.space.canonical(post.space.decode(start.likeliest(i, 1)[0])) for i in range(5)])
    for i, (build, values) in enumerate(zip(builds, found, strict=True)):
        if build.shape is not None:
            after, before = (np.abs(measure([(i, shape)])[0]).sum() for shape in (post(**values), build.shape))
            assert after <= before


def test_of_forms_that_look_alike_the_likelier_is_chosen():
    likely = np.array([0.3, 0.7, 0.0])
    start = predicted((0.5, 0.5, likely, 0.5), (0.5, 0.5, likely, 0.5))

    def measure(pairs):  # the unlikely form is a little better for the first reference, and clearly for the second
        return [np.array([100.0, (2.0, 50.0)[i] if len(mesh.faces) > 40 else 0.0]) for i, mesh in pairs]

    with Workers(post, 1) as crew:
        careful = refine(SearchStart(start), Criterion(measure, surprise_cost=5.0), crew)
        careless = refine(SearchStart(start), Criterion(measure), crew)
    assert [found["form"] for found in careful] == ["round", "square"]
    assert [found["form"] for found in careless] == ["square", "square"]


def test_other_choices_are_tried_and_the_best_one_comes_back():
    truth = [{"height": 1.2, "width": 0.4, "form": form, "cap": 0.6} for form in ("square", "round")]
    start = predicted(*[(0.5, 0.3, [1.0, 0.0, 0.0], 0.6)] * 2)
    first = (Scan(1), Probe(1), Step(1, 3))
    budget = Budget((*first, SwitchChoices("single"), Scan(2), Probe(2), Return(1), Step(1, 3)))
    with Workers(post, 1) as crew:
        criterion = Criterion(measure_against([post(**values) for values in truth]))
        found = refine(SearchStart(start), criterion, crew, budget)
        before = refine(SearchStart(start), criterion, crew, replace(budget, moves=first))
    assert [values["form"] for values in found] == ["square", "round"]
    assert [values["form"] for values in before] == ["square", "square"]


def test_where_nothing_can_be_built_the_prediction_stays():
    start = predicted((0.5, 0.95, [0.0, 0.0, 1.0], 0.5))
    with Workers(post, 1) as crew:
        (found,) = refine(SearchStart(start), Criterion(lambda pairs: [None] * len(pairs)), crew, QUICK.within(1, 3))
    assert found["form"] == "bare" and found["width"] == pytest.approx(0.955) and found["cap"] == 0.5


def test_others_are_a_single_choice_away_or_the_likeliest_each_once():
    space = sw.ParameterSpace(
        (sw.Scalar("s", 0, 1, 0), sw.Choice("a", ("x", "y", "z"), "x"), sw.Choice("b", ("m", "n", "o"), "m"))
    )
    centre = np.array([0.25, 0.0, 0.0])
    away = others(space, centre)
    assert [tuple(v) for v in away] == [(0.25, 1, 0), (0.25, 2, 0), (0.25, 0, 1), (0.25, 0, 2)]
    columns = (np.array([0.9]), np.array([[0.1, 0.3, 0.6]]), np.array([[0.1, 0.2, 0.7]]))
    likely = Prediction(space, columns).likeliest(0, 4)
    known = [tuple(v) for v in others(space, centre, likely)]
    assert known == [*(tuple(v) for v in away), (0.25, 2, 2), (0.25, 1, 2), (0.25, 2, 1)]
    assert [tuple(v) for v in others(space, np.array([0.25, 0.0, 1.0]), likely)][4:] == [(0.25, 2, 2), (0.25, 1, 2)]


def test_counts_of_many_values_are_changed_by_one_and_two_and_lengths_in_millimetres_are_not():
    teeth = sw.Scalar("teeth", 14, 40, 20, whole=True)
    space = sw.ParameterSpace((teeth, sw.Scalar("length", 40, 140, 90, whole=True), sw.Scalar("width", 3, 20, 8)))
    beside = others(space, np.array([teeth.encode(39), 0.5, 0.5]))
    assert [space.decode(vector)["teeth"] for vector in beside] == [38, 40, 37]
    assert all(vector[1] == vector[2] == 0.5 for vector in beside)


def test_of_too_many_other_choices_the_likeliest_are_built():
    start = predicted((0.6, 0.3, [0.9, 0.01, 0.09], 0.3))
    built = []

    def measure(pairs):
        built.extend(mesh for _, mesh in pairs)
        return measure_against([post(height=1.4, width=0.3, form="square", cap=0.3)])(pairs)

    budget = Budget((Scan(1), SwitchChoices("single"), Scan(1)))
    with Workers(post, 1) as crew:
        refine(SearchStart(start), Criterion(measure, surprise_cost=1.0), crew, budget)
    bare = post(height=1.4, width=0.3, form="bare")
    assert len(built) == 2 and built[1].vertices.shape == bare.vertices.shape  # not the round one, which comes first


def test_a_search_goes_on_where_its_cost_falls_and_ends_where_it_does_not():
    start = predicted((0.6, 0.3, SURE, 0.3), (0.6, 0.3, SURE, 0.3))
    near = measure_against([post(height=1.5, width=0.35, form="square", cap=0.4)])
    rounds = []

    def measure(pairs):
        rounds.append({row for row, _ in pairs})
        return [near([(0, mesh)])[0] if row == 0 else np.full(9, 100.0) for row, mesh in pairs]

    model = (Scan(1), Probe(1, 0.08), Step(1, 3))
    budget = Budget((*model, Continue(), Probe(1, 0.05, both=True, again=True), Step(1, 3), Continue(0.8), Step(1)))
    with Workers(post, 1) as crew:
        refine(SearchStart(start), Criterion(measure), crew, budget)
    assert rounds[-2] == {0, 1} and rounds[-1] == {0}


def test_budgets_are_cut_to_what_there_is_time_for():
    assert QUICK.evaluations(0) < QUICK.evaluations(3) and THOROUGH.evaluations(3) > 3 * QUICK.evaluations(3)
    assert QUICK.within(26, 3).evaluations(3) == 26 and QUICK.within(1e9, 3) == QUICK
    assert QUICK.within(3, 3).evaluations(3) == 3 and QUICK.within(0, 3).evaluations(3) == 1


def test_variants_find_a_choice_that_the_prediction_excludes_and_plain_starts_what_it_missed():
    target = post(height=1.4, width=0.3, form="round", cap=0.5)
    start = predicted((0.65, 0.2, SURE, 0.5))
    built = []

    def measure(pairs):
        built.extend(pairs)
        return measure_against([target])(pairs)

    moves = (Scan(1), Probe(1), Step(1, 2))
    further = (*moves, SwitchChoices("single"), Scan(3), Probe(2, 0.01), Step(2, 2))
    far = predicted((0.0, 1.0, SURE, 0.0))
    with Workers(post, 1) as crew:
        (as_predicted,) = refine(SearchStart(start), Criterion(measure), crew, Budget(moves))
        assert len(built) == Budget(moves).evaluations(3) == 6
        (varied,) = refine(SearchStart(start), Criterion(measure), crew, Budget(further))
        assert Budget(further).evaluations(3) == 6 + 3 + 6 + 4
        (plain,) = refine(SearchStart(far), Criterion(measure), crew, Budget((Scan(2),), simple=1))
        again = Budget((Scan(1), SwitchChoices("defaults"), Scan(3)))
        (restarted,) = refine(SearchStart(far), Criterion(measure_against([post(form="round")])), crew, again)
    assert as_predicted["form"] == "square" and varied["form"] == "round"
    assert plain == {"height": 1.0, "width": 0.5, "form": "square", "cap": 0.5}
    assert restarted == {**plain, "form": "round"}
    assert Budget((Scan(4), Probe(1)), simple=3).within(2, 3) == Budget((Scan(2),))


def test_the_best_rests_while_others_are_tried_by_a_coarser_part():
    def measure(pairs):
        """Coarsely any second part is wrong; finely the bare post is, and others are right at a width of 0.4."""
        tried.update(len(shape.vertices) for _, shape in pairs)
        coarse = [0.0 if len(shape.vertices) == 8 else 10.0 for _, shape in pairs]
        widths = [np.ptp(shape.vertices[shape.vertices[:, 1] < 0][:, 0]) for _, shape in pairs]
        return [np.array([0.0 if c else 5.0, w - 0.2, c]) for c, w in zip(coarse, widths, strict=True)]

    tried: set[int] = set()
    fine, coarse = slice(0, 2), slice(2, 3)
    start = predicted((0.5, 0.2, SURE, 0.5))
    first = (UseScale(1, keep=1), Scan(1), Probe(1), *(Step(1),) * 2)
    others_too = (*first, SwitchChoices("single", scale=0), Scan(3), Probe(3), Step(3))
    with Workers(post, 1) as crew:
        found = [
            refine(SearchStart(start), Criterion(measure, (coarse, fine)), crew, Budget(moves))[0]
            for moves in (first, others_too, (*others_too, UseScale(1, keep=1), Step(1)))
        ]
    assert [values["form"] for values in found] == ["square"] * 3  # where the rounds end before the last part as well
    assert [values["width"] for values in found] == [pytest.approx(0.4)] * 3
    assert 8 in tried  # the coarser part had preferred a bare post


def test_only_what_is_nearly_compatible_is_explored_further():
    start = predicted((0.5, 0.5, SURE, 0.5), (0.5, 0.5, SURE, 0.5))
    target = post(height=1.0, width=0.5, cap=0.9)
    measured = []

    def measure(pairs):
        measured.extend(i for i, _ in pairs)
        return measure_against([target, box((1, 0.1, 1)).mesh()])(pairs)

    budget = Budget((Scan(1), Probe(1), Step(1, 1), Step(1, 1, 5, near=4.0)))
    with Workers(post, 1) as crew:
        refine(SearchStart(start), Criterion(measure, goal=400.0), crew, budget)
    assert measured.count(0) in (5, 11) and measured.count(1) == 5
    costs = [np.abs(measure_against([target])([(0, post(**post.space.decode([0.5, 0.5, 0, 0.5])))])[0]).sum()]
    assert costs[0] > 400.0


def test_where_an_earlier_search_ended_at_the_best_nothing_more_is_spent():
    target = post(height=1.0, width=0.5, cap=0.9)
    known = [{"height": 1.0, "width": 0.5, "form": "square", "cap": 0.88}]
    start = predicted((0.2, 0.9, SURE, 0.1))
    counts = []
    with Workers(post, 1) as crew:
        for new in (None, set(), {"height"}, {"never"}):
            measured = []

            def measure(pairs, measured=measured):
                measured.extend(pairs)
                return measure_against([target])(pairs)

            (found,) = refine(SearchStart(start, known, new), Criterion(measure), crew)
            counts.append(len(measured))
            assert found["height"] == pytest.approx(1.0, abs=0.05)
    assert counts[0] == counts[2] > counts[1] == counts[3] == 3


def test_a_search_that_is_cut_short_keeps_the_best_that_rested():
    first = (Scan(2), Probe(1), Step(1, 2))
    budget = Budget((*first, SwitchChoices("single"), Scan(2), Probe(2), UseScale(1, keep=2), Step(2, 2)))
    cost = AlignedCost(post(height=1.4, width=0.3, form="square", cap=0.5))
    start = predicted((0.65, 0.25, SURE, 0.5))
    parts = (slice(0, 470), slice(470, 940))

    def measure(pairs):
        return [np.tile(cost.residual(shape), 2) for _, shape in pairs]

    with Workers(post, 1) as crew:
        cuts = [budget.within(evaluations, 3) for evaluations in (5, 7, 9, 15, 100)]
        found = [refine(SearchStart(start), Criterion(measure, parts), crew, cut)[0] for cut in cuts]
    assert [cut.rounds for cut in cuts] == [2, 3, 4, 5, 6]
    assert [values["form"] for values in found] == ["square"] * 5


def counted(start, target, budget, known=None):
    """How many shapes are measured, and what is found."""
    measured = []

    def measure(pairs):
        measured.extend(pairs)
        return measure_against([target])(pairs)

    with Workers(post, 1) as crew:
        (found,) = refine(SearchStart(start, known), Criterion(measure), crew, budget)
    return len(measured), found


def test_a_search_ends_where_nothing_moves():
    truth = {"height": 1.0, "width": 0.5, "form": "square", "cap": 0.9}
    height, width, _, cap = post.space.encode(truth)
    there = predicted((height, width, SURE, cap))
    moves = (Scan(1), Probe(1), *(Step(1, 1, 2),) * 6)
    spent = [counted(there, post(**truth), Budget(moves, patience=patience))[0] for patience in (1, 2, None)]
    assert spent == [1 + 3 + 3, 1 + 3 + 3 * 2, 1 + 3 + 3 * 6]
    away = predicted((0.1, 0.9, SURE, 0.1))
    few, found = counted(away, post(**truth), Budget(moves, patience=1))
    assert few > spent[0] and found["height"] > 0.6


def test_only_rivals_of_the_best_combination_take_part():
    target = post(height=1.0, width=0.5, form="bare")
    start = predicted((0.44, 0.44, [0.4, 0.3, 0.3], 0.9))
    budgets = [Budget((Scan(3), Probe(3, rival=rival))) for rival in (np.inf, 1.5)]
    everyone, rivals = (counted(start, target, budget)[0] for budget in budgets)
    assert everyone == 3 + 3 + 3 + 2 and rivals == 3 + 2


def test_a_start_that_is_predicted_as_well_is_tried_once():
    known = {"height": 1.0, "width": 0.5, "form": "square", "cap": 0.5}
    height, width, _, cap = post.space.encode(known).astype(np.float32)
    start = predicted((height, width, SURE, cap))
    assert counted(start, post(), Budget((Scan(1),)), [known])[0] == 1


def test_a_search_starts_from_what_is_given_beside_the_prediction_too():
    truth = {"height": 1.8, "width": 0.9, "form": "round", "cap": 0.9}
    start = predicted((0.1, 0.1, SURE, 0.1))
    criterion = Criterion(measure_against([post(**truth)]))
    with Workers(post, 1) as crew:
        (found,) = refine(SearchStart(start, beside=[[truth]]), criterion, crew, Budget((Scan(2),)))
        (without,) = refine(SearchStart(start), criterion, crew, Budget((Scan(2),)))
    assert found == pytest.approx(truth) and without != pytest.approx(truth)
