import numpy as np

from shapewright.modelling.solids import box
from shapewright.survey.likeness import pictures
from shapewright.survey.outliers import isolation, outliers


def tables(count: int):
    for height in np.linspace(0.5, 0.9, count):
        legs = box((0.05, height, 0.05), at=(0.45, height / 2, 0.25)).mirror("x", keep=True).mirror("z", keep=True)
        yield (box((1, 0.05, 0.6), at=(0, height, 0)) | legs).mesh().normalised()


def test_a_shape_of_another_kind_is_told_with_how_far_it_is():
    shapes = [*tables(12), box((0.1, 1, 0.1)).mesh().normalised()]
    names = [str(i) for i in range(12)] + ["pole"]
    seen = pictures(shapes)
    (found,) = outliers(names, seen)
    assert (found.name, found.apart) == ("pole", isolation(seen)[12])
    assert found.apart > 0.25 > found.usual


def test_a_collection_of_one_kind_or_of_few_shapes_has_none():
    assert outliers([str(i) for i in range(12)], pictures(list(tables(12)))) == ()
    few = [*tables(3), box((0.1, 1, 0.1)).mesh().normalised()]
    assert outliers(list("abcd"), pictures(few)) == ()
