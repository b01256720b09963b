"""A fit says where lengths could be found, and its author lets proportions alone count."""

from typing import Annotated

import pytest

import shapewright as sw
from shapewright import Range
from shapewright.building import Build
from shapewright.fitting.start import as_large
from shapewright.modelling.solids import box
from shapewright.shapes.conversion import as_shape

QUICK = sw.Settings(samples=40, epochs=1, image_size=32, refine="off", workers=1)


def slab(
    width: Annotated[float, Range(20.0, 90.0)] = 50.0, height: Annotated[float, Range(5.0, 30.0)] = 10.0
) -> object:
    return box((width, height, 30.0))


BARE, MILLIMETRES, GIVEN = (
    sw.procedure(**facts)(slab) for facts in ({}, {"unit": "mm"}, {"unit": "mm", "size": "given"})
)


def collection(*widths):
    return sw.Collection.of({f"slab {k}": as_shape(box((width, 9.0, 30.0))) for k, width in enumerate(widths)})


def builds(procedure):
    return [Build(values, procedure(**values)) for values in ({"width": w, "height": 9.0} for w in (25.0, 85.0))]


@pytest.mark.parametrize(
    ("procedure", "widths", "told"),
    [
        (MILLIMETRES, (40, 50, 60), True),
        (BARE, (40, 50, 60), False),  # its lengths mean nothing
        (GIVEN, (40, 50, 60), False),
        (MILLIMETRES, (40, 50), False),  # too few to tell
        (MILLIMETRES, (50, 50, 51), False),  # normalised
        (MILLIMETRES, (40, 50, 600), False),  # not what it makes
        (MILLIMETRES, (400, 500, 600), False),
    ],
)
def test_references_of_a_size_that_the_procedure_makes_are_told(procedure, widths, told):
    notice = as_large(collection(*widths), builds(procedure), procedure)
    assert (notice is not None) == told


def test_a_fit_tells_it_with_what_to_write():
    heard = []
    sw.fit(MILLIMETRES, collection(40, 50, 60), QUICK, heard.append)
    assert [str(event) for event in heard if event.notice and event.notice.kind == "size"] == [
        'the references are as large as what the procedure builds, 40 to 60 mm: write size="given" beside unit= in '
        "@procedure to find lengths too"
    ]
