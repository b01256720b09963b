from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range
from shapewright.building import Workers
from shapewright.fitting.learning import learn
from shapewright.fitting.start import Start
from shapewright.modelling.solids import box
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.progress import Stages
from shapewright.rendering.raster import render
from shapewright.shapes import Points

SETTINGS = sw.Settings(samples=60, epochs=1, workers=1)


@sw.procedure
def block(height: Annotated[float, Range(0.2, 1.0)] = 0.5, depth: Annotated[float, Range(0.2, 1.0)] = 0.5):
    return box((1.0, height, depth))


def scan(mesh):
    cameras = side_cameras((-75.0, 0.0, 75.0), (20.0, 30.0, 20.0))
    return Points(Scanner(cameras, count=3000).scan(mesh, np.random.default_rng(0)).positions)


def lesson(**shapes):
    start = Start.of(sw.Collection.of(shapes), block.space, None)
    with Workers.of(block, SETTINGS) as crew:
        return learn(crew, SETTINGS, Stages(None), start)


@pytest.fixture(scope="module")
def of_meshes():
    return lesson(one=block())


def test_a_predictor_of_meshes_learns_from_meshes_alone(of_meshes):
    for part in (of_meshes.training, of_meshes.validation, of_meshes.held_out):
        assert not any(isinstance(shape, Points) for shape in part.shapes)
        assert (part.images == render(part.shapes, part.cameras, part.size, threads=1)).all()


def test_where_references_are_points_a_share_of_the_samples_is_scanned(of_meshes):
    of_points = lesson(one=block(), two=scan(block()))
    scans = [isinstance(shape, Points) for shape in of_points.training.shapes]
    assert 0.5 < np.mean(scans) < 0.95
    assert of_points.training.parameters == of_meshes.training.parameters
    assert any(isinstance(shape, Points) for shape in of_points.held_out.shapes)
    scalars = len(block.space)
    assert of_points.budget(SETTINGS, 1).evaluations(scalars) > of_meshes.budget(SETTINGS, 1).evaluations(scalars)


def test_few_references_of_a_slow_procedure_may_cost_as_many_shapes_as_the_samples(of_meshes):
    slow, scalars = replace(of_meshes, facts={**of_meshes.facts, "build_seconds": 3.0}), len(block.space)
    few, some, many = (slow.budget(SETTINGS, count).evaluations(scalars) for count in (1, 4, 1000))
    assert many == 1 < some <= len(slow.training) / 4 < few <= len(slow.training)
    assert of_meshes.budget(SETTINGS, 1000).evaluations(scalars) > few  # where a shape costs little, all moves


def test_a_predictor_of_points_predicts_scans():
    predictor = lesson(one=scan(block())).predictor
    assert len(predictor.predict([scan(block(height=0.3)), block(height=0.3)])) == 2
