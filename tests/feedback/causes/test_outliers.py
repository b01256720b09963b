import numpy as np

from shapewright.comparison import light_field
from shapewright.feedback.causes.outliers import isolation, outliers
from shapewright.modelling.solids import box, cylinder


def table(height, breadth):
    top = box((1, 0.05, breadth), at=(0, height, 0))
    leg = box((0.06, height, 0.06), at=(0.45, height / 2, breadth / 2 - 0.05))
    return (top | leg.mirror("x", keep=True).mirror("z", keep=True)).mesh()


def test_a_lamp_among_tables_is_an_outlier():
    shapes = [table(h, b) for h in (0.5, 0.6, 0.7, 0.8) for b in (0.5, 0.7, 0.9)]
    lamp = cylinder((0.05, 2, 0.05)) | cylinder((0.5, 0.4, 0.5), at=(0, 0.9, 0))
    described = [*light_field.descriptors(shapes), None, light_field.descriptor(lamp.mesh())]
    alone = isolation(described, threads=1)
    assert np.isnan(alone[-2]) and alone[-1] == np.nanmax(alone)
    assert outliers(alone).tolist() == [False] * 13 + [True]


def test_a_collection_without_outliers_and_one_too_small_to_tell():
    rng = np.random.default_rng(0)
    assert not outliers(rng.uniform(0.1, 0.3, 50)).any()
    assert not outliers(np.array([0.1, 0.1, 0.9])).any()
    assert not outliers(np.full(20, 0.05)).any()


def test_some_stand_for_many(monkeypatch):
    monkeypatch.setattr("shapewright.feedback.causes.outliers._MOST", 20)
    rng = np.random.default_rng(1)
    few = light_field.descriptors([table(*rng.uniform(0.5, 0.9, 2)) for _ in range(6)])
    alone = isolation([few[i] for i in rng.integers(6, size=60)], threads=1)
    assert np.isfinite(alone).all() and alone.max() < 0.3
