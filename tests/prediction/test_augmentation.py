"""Augmentation: shapes change a little, parameters not."""

import numpy as np
import pytest
import shapely

from shapewright import Drawing, Mesh, ParameterSpace, Scalar
from shapewright.modelling.solids import box
from shapewright.prediction.augmentation import augmented, worn
from shapewright.prediction.dataset import Dataset, make_dataset
from shapewright.rendering.cameras import PAGE


@pytest.fixture
def data() -> Dataset:
    space = ParameterSpace([Scalar("height", 0.0, 1.0, 0.5)])
    heights = np.linspace(0.2, 0.8, 12)
    shapes = [box((1, height, 0.5)).mesh().normalised() for height in heights]
    return make_dataset(space, [{"height": float(height)} for height in heights], shapes, size=32)


def test_shapes_change_a_little_and_stay_normalised() -> None:
    mesh, rng = box((1, 0.6, 0.5)).mesh().normalised(), np.random.default_rng(0)
    moved = [worn(mesh, rng).vertices - mesh.vertices for _ in range(40)]
    assert 0.01 < np.mean([np.abs(move).max() for move in moved]) < 0.15
    assert any(not move.any() for move in moved)  # each change is made or not
    assert all(np.isclose(worn(mesh, rng).extent.max(), 1.0) for _ in range(10))


def test_pictures_follow_the_shapes_and_parameters_stay(data: Dataset) -> None:
    changed = augmented(data, seed=1)
    assert changed.parameters == data.parameters
    assert np.array_equal(changed.targets, data.targets)
    differ = [not np.array_equal(a, b) for a, b in zip(changed.images, data.images, strict=True)]
    moved = [not np.allclose(_vertices(a), _vertices(b)) for a, b in zip(changed.shapes, data.shapes, strict=True)]
    assert differ == moved
    assert any(moved)


def test_the_seed_decides(data: Dataset) -> None:
    assert np.array_equal(augmented(data, seed=1).images, augmented(data, seed=1).images)
    assert not np.array_equal(augmented(data, seed=1).images, augmented(data, seed=2).images)


def test_drawings_stay_as_they_are() -> None:
    space = ParameterSpace([Scalar("size", 0.0, 1.0, 0.5)])
    drawings = make_dataset(space, [{"size": 0.5}], [Drawing(shapely.box(0, 0, 1, 2)).normalised()], (PAGE,), 32)
    assert augmented(drawings, seed=0) is drawings


def _vertices(shape: object) -> np.ndarray:
    assert isinstance(shape, Mesh)
    return shape.vertices
