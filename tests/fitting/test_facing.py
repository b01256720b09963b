from typing import Annotated

import numpy as np

import shapewright as sw
from shapewright import Range
from shapewright.modelling.solids import box

TURNS = {"a": 0, "b": 1, "c": 2, "d": 3}


@sw.procedure
def seat(
    width: Annotated[float, Range(0.5, 1.5)] = 1.0,
    back: Annotated[float, Range(0.3, 1.0)] = 0.6,
):
    return box((width, 0.4, 1)) | box((width, back, 0.15), at=(0, 0.2 + back / 2, -0.4))


def test_references_are_turned_to_face_as_the_procedure_does():
    shape = seat(width=0.8, back=0.7)
    upright = sw.Collection.of(dict.fromkeys(TURNS, shape))
    references = upright.turned([-quarters for quarters in TURNS.values()])
    settings = sw.Settings(samples=300, epochs=10, image_size=32, refine="off", facing="found")
    iteration = sw.fit(seat, references, settings)
    assert iteration.metrics["turned"] == {"b": 90, "c": 180, "d": 270}
    assert len(iteration.compatible) == 4
    for result in iteration:
        np.testing.assert_allclose(result.reference.bounds, upright["a"].shape.bounds, atol=1e-12)


def test_a_turned_reference_still_knows_its_own_units():
    (reference,) = sw.Collection.of({"seat": box((2, 3, 1), at=(5, 1, 2))}, up="z", front="x")
    turned = reference.turned(1)
    np.testing.assert_allclose(
        turned.to_original(turned.shape.vertices), reference.to_original(reference.shape.vertices)
    )
