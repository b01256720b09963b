from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest
import torch

import shapewright as sw
from shapewright import Range
from shapewright.modelling.solids import box
from shapewright.prediction.camera_learning import LearnedCameras, camera_gradient
from shapewright.prediction.dataset import make_dataset
from shapewright.prediction.network import CompactNetwork, loss
from shapewright.prediction.training import Schedule, train_network
from shapewright.rendering.cameras import THREE_VIEWS, Camera, placed, positions, starting_views, within_reach
from shapewright.rendering.raster import render

MOVING = Schedule(epochs=10, batch=16, camera_rate=0.05)


@sw.procedure
def block(depth: Annotated[float, Range(0.2, 1.0)] = 0.6, step: Annotated[float, Range(0.1, 0.9)] = 0.4):
    return box((1, 0.5, depth)) | box((0.3, 0.2, step * depth), at=(0.3, 0.35, 0))


@sw.procedure
def sandwich(filling: Annotated[float, Range(0.1, 0.9)] = 0.6):
    bread = box((1, 1, 0.1), at=(0, 0, 0.45)) | box((1, 1, 0.1), at=(0, 0, -0.45))
    return bread | box((filling, filling, 0.9))


def dataset(procedure, count, cameras=THREE_VIEWS, seed=0):
    rows = procedure.space.sample(count, seed=seed)
    meshes = [procedure(**values).normalised() for values in rows]
    return make_dataset(procedure.space, rows, meshes, cameras, 32, threads=1)


def test_the_gradient_is_that_of_the_whole_loss():
    data, fine, step = dataset(block, 8), 6, 0.01
    torch.manual_seed(2)
    network = CompactNetwork(block.space, views=3, size=32).eval()
    targets, active = torch.from_numpy(data.targets), torch.from_numpy(data.active)

    def pictures(cameras):
        return torch.from_numpy(render(data.shapes, cameras, 32, fine, threads=1)).float() / 255.0

    def whole(cameras):
        with torch.no_grad():
            return loss(block.space, network(pictures(cameras)), targets, active).item()

    images = pictures(THREE_VIEWS).requires_grad_()
    loss(block.space, network(images), targets, active).backward()
    ours = camera_gradient(data.shapes, THREE_VIEWS, images.grad.numpy(), step, fine)
    numerical, start = np.zeros((3, 3)), positions(THREE_VIEWS)
    for i in np.ndindex(3, 3):
        offset = np.zeros((3, 3))
        offset[i] = step
        ahead, behind = (whole(placed(THREE_VIEWS, start + sign * offset)) for sign in (1, -1))
        numerical[i] = (ahead - behind) / (2 * step)
    assert np.linalg.norm(numerical) > 0
    assert np.linalg.norm(ours - numerical) < 0.1 * np.linalg.norm(numerical)


def test_a_camera_that_hardly_sees_the_parameter_moves_to_where_it_does():
    almost_front = (Camera(20.0, 5.0),)
    training, validation = dataset(sandwich, 160, almost_front), dataset(sandwich, 40, almost_front, seed=9)
    fixed, learned, again = (
        train_network(sandwich.space, training, validation, schedule, threads=2)
        for schedule in (Schedule(epochs=10, batch=16), MOVING, MOVING)
    )
    assert fixed.cameras == almost_front and learned.cameras != almost_front
    assert learned.curve[-1].validation < 0.5 * fixed.curve[-1].validation
    assert learned.cameras == again.cameras and learned.curve == again.curve


def test_cameras_descend_and_stay_in_reach():
    cameras = LearnedCameras([Camera(0.0, 0.0, 2.6), Camera(10.0, 80.0, 1.9)], rate=0.05, steps=60)
    goal = np.array([[0.4, 0.2, 3.0], [0.0, 2.0, 1.0]])
    for _ in range(60):
        cameras.step(positions(cameras.cameras) - goal)
    first, second = cameras.cameras
    assert positions([first])[0] == pytest.approx(goal[0], abs=0.05)
    assert second.elevation == pytest.approx(85.0) and second.distance == pytest.approx(1.8)


def test_positions_are_numbers_and_back():
    cameras = starting_views(8, 3.0)
    assert positions(placed(starting_views(8), positions(cameras))) == pytest.approx(positions(cameras))
    assert np.array_equal(within_reach(positions(cameras)), positions(cameras))
    assert starting_views(3) == THREE_VIEWS and starting_views(2) == THREE_VIEWS[:2]
    places = np.array([camera.frame()[2] for camera in starting_views(12)])
    assert (places @ places.T - 2 * np.eye(12)).max() < np.cos(np.radians(15))


def test_training_gives_the_predictor_its_learned_cameras():
    settings = sw.Settings(seed=1, samples=60, epochs=2, batch=16, image_size=32, workers=2, cameras="learned")
    it = sw.fit(block, sw.Collection.of({"one": block(), "two": block(depth=0.9)}), settings)
    before, after = it.metrics["cameras"]["before"], it.metrics["cameras"]["after"]
    assert before == [[c.azimuth, c.elevation, c.distance] for c in THREE_VIEWS]
    assert np.abs(np.array(after) - before).min() > 1e-6
    again = [[c.azimuth, c.elevation, c.distance] for c in sw.train(block, settings).cameras]
    assert again == after
    fixed = sw.train(block, replace(settings, cameras="fixed", views=4, camera_distance=3.0))
    assert fixed.cameras == starting_views(4, 3.0)
