from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range
from shapewright.axes.agreement import Z_UP
from shapewright.axes.turns import TURNS
from shapewright.fitting.standing import lying, stand
from shapewright.modelling.solids import box
from shapewright.prediction.dataset import make_dataset
from shapewright.references import Orientation
from shapewright.rendering.cameras import starting_views
from shapewright.report import write_report
from shapewright.report.axes_sheet import SHEET


@sw.procedure
def seat(
    width: Annotated[float, Range(0.5, 1.5)] = 1.0,
    back: Annotated[float, Range(0.3, 1.0)] = 0.6,
):
    return box((width, 0.4, 1)) | box((width, back, 0.15), at=(0, 0.2 + back / 2, -0.4))


GIVEN = {"a": 7, "b": 0, "c": 19}  # of TURNS
QUICK = sw.Settings(samples=60, epochs=1, image_size=32, refine="off")


@pytest.fixture
def turned():
    shapes = {name: seat(width=0.7 + 0.1 * turn / 24).transformed(TURNS[turn]) for name, turn in GIVEN.items()}
    return sw.Collection.of(shapes, up="auto")


def test_each_reference_stands_as_the_procedures_shapes_do(turned):
    found = stand(seat, turned, QUICK)
    for reference, turn in zip(found, GIVEN.values(), strict=True):
        assert reference.orientation == Orientation().then(TURNS[turn].T)


def test_axes_that_are_told_are_left_alone():
    told = sw.Collection.of({"a": seat()}, up="z")
    assert stand(seat, told, QUICK) is told


def test_a_fit_records_them_and_its_report_shows_them(turned, tmp_path):
    iteration = sw.fit(seat, turned, QUICK)
    axes = iteration.collection["axes"]
    assert {name: axes[name]["by"] for name in axes} == {"a": "found", "b": "default", "c": "found"}
    assert axes["a"]["up"] == Orientation().then(TURNS[7].T).up
    run = iteration.save(tmp_path / "run", write_report)
    assert (run / SHEET).read_bytes().startswith(b"\x89PNG")
    assert f'href="{SHEET}"' in (run / "report.html").read_text()


def test_what_an_earlier_iteration_found_stays_so(turned):
    first = sw.fit(seat, turned, QUICK)
    axes = first.collection["axes"]
    axes["a"] |= {"up": "-y", "front": "z"}
    heard = []
    again = sw.fit(seat, turned, QUICK, heard.append, previous=first)
    assert again.collection["axes"] == axes
    assert "axes" not in {event.stage for event in heard}  # no shape was built to find them
    more = sw.Collection.of(
        {name: seat().transformed(TURNS[turn]) for name, turn in [*GIVEN.items(), ("d", 9)]}, up="auto"
    )
    found = stand(seat, more, QUICK, previous=again)
    assert found["d"].orientation == Orientation().then(TURNS[9].T)
    assert found["a"].orientation == Orientation("-y", "z")


def test_the_axes_of_a_file_are_those_of_its_objects():
    two = seat().transformed(TURNS[7])
    apart = sw.Mesh(
        np.concatenate([two.vertices, two.vertices + np.array([4, 0, 0])]),
        np.concatenate([two.faces, two.faces + len(two.vertices)]),
    )
    axes = sw.fit(
        seat, sw.Collection.of({"pair": apart}, up="auto"), sw.Settings(**vars(QUICK) | {"split": "apart"})
    ).collection["axes"]
    assert set(axes) == {"pair", "pair/1", "pair/2"} and len({str(each) for each in axes.values()}) == 1


def test_an_explanation_takes_the_references_as_the_fit_did(turned):
    iteration = sw.fit(seat, turned, QUICK)
    given = {name: seat(width=0.7 + 0.1 * turn / 24).transformed(TURNS[turn]) for name, turn in GIVEN.items()}
    explained = sw.explain(iteration, seat, sw.Collection.of(given), suggest=False)
    assert set(explained.references) == set(GIVEN)
    for name, case in explained.references.items():
        np.testing.assert_allclose(case.reference.vertices, iteration[name].reference.vertices, atol=1e-12)


def table(
    w: Annotated[float, Range(600, 1600)] = 1000,
    d: Annotated[float, Range(400, 900)] = 600,
    h: Annotated[float, Range(400, 1000)] = 700,
):
    """Z up, as CAD programs have it."""
    legs = [((50, 50, h), (x * (w / 2 - 40), y * (d / 2 - 40), h / 2)) for x in (-1, 1) for y in (-1, 1)]
    made = box((w, d, 30), at=(0, 0, h))
    for size, at in legs:
        made |= box(size, at=at)
    return made


SILENT, SAYING = sw.procedure(table), sw.procedure(up="z")(table)
TO_Y = TURNS[Z_UP]


def drawn(procedure, count=60, seed=0):
    vectors = procedure.space.sample(count, seed=seed)
    shapes = [procedure(**vector).normalised() for vector in vectors]
    return make_dataset(procedure.space, vectors, shapes, starting_views(3), 32, 1)


def collection(procedure, turn=None, **told):
    shapes = [procedure(**vector) for vector in procedure.space.sample(6, seed=7)]
    turned = {str(i): shape if turn is None else shape.transformed(turn) for i, shape in enumerate(shapes)}
    return sw.Collection.of(turned, **told)


@pytest.mark.parametrize(
    ("procedure", "references", "remedies"),
    [
        (SILENT, collection(SILENT), None),
        (SILENT, collection(SILENT, up="z"), ("procedure up z",)),
        (SILENT, collection(SAYING), ("procedure up z", "references up z")),  # Y up; a table tells not which of the two
        (SAYING, collection(SILENT), None),  # taken for files of CAD
        (SAYING, collection(SAYING), ("references up y",)),
        (SAYING, collection(SAYING, up="y", front="z"), None),
        (seat, collection(seat), None),
        (seat, collection(seat, up="z"), ("procedure up z",)),
        (seat, collection(seat, TO_Y.T), ("procedure up z", "references up z")),
        (seat, collection(seat, TO_Y.T, up="z"), None),
    ],
)
def test_up_of_another_axis_is_told_with_what_an_author_can_say(procedure, references, remedies):
    standing = references.standing(procedure.facts.up)
    found = lying(standing, drawn(procedure), procedure.facts.up)
    assert (found and found.remedies) == remedies


def test_references_whose_up_was_looked_for_tell_nothing(turned):
    assert lying(turned, drawn(seat), "y") is None


def test_a_fit_tells_it_once(tmp_path):
    heard = []
    sw.fit(SILENT, collection(SAYING), QUICK, heard.append)
    told = [str(event) for event in heard if event.notice and event.notice.kind == "lying"]
    assert told == [
        'of 6 references 6 fit clearly better when another axis is up: write @procedure(up="z") if z is up in what the '
        "procedure builds, or say --up z if z is up in the files of the references"
    ]
