from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from shapewright.modelling.solids import box, cylinder
from shapewright.rendering.cameras import THREE_VIEWS, Camera
from shapewright.rendering.raster import render
from shapewright.shapes import Mesh

GOLDEN = Path(__file__).parents[1] / "golden"


def table():
    leg = box((0.08, 0.7, 0.08), at=(0.44, 0, 0.24))
    legs = leg.mirror("x", keep=True).mirror("z", keep=True)
    return (cylinder((1, 0.07, 0.6), at=(0, 0.32, 0)) | legs).mesh().normalised()


@pytest.mark.parametrize(
    ("name", "mesh", "cameras", "size"),
    [
        ("table", table(), THREE_VIEWS, 64),
        ("box", box((1, 0.5, 0.25)).mesh(), (Camera(30, 40), Camera(180, 0), Camera(0, 90)), 48),
    ],
)
def test_golden_images(name, mesh, cameras, size):
    images = render([mesh], cameras, size)
    picture = np.concatenate([np.concatenate(list(images[0, :, channel]), axis=1) for channel in (0, 1)])
    path = GOLDEN / f"{name}.png"
    if not path.exists():
        GOLDEN.mkdir(exist_ok=True)
        Image.fromarray(picture).save(path)
        pytest.fail(f"{path} was missing and has been drawn: look at it, and commit it if it is right")
    expected = np.asarray(Image.open(path)).astype(int)
    assert expected.shape == picture.shape
    assert np.abs(expected - picture).max() <= 2


def test_a_front_view_shows_the_size_that_perspective_gives():
    camera = Camera(0.0, 0.0, distance=4.0, field_of_view=30.0)
    image = render([box((1, 0.5, 1e-6)).mesh()], [camera], size=256, supersample=1)[0, 0, 0] > 0
    rows, columns = np.flatnonzero(image.any(axis=1)), np.flatnonzero(image.any(axis=0))
    assert len(columns) == pytest.approx(256 * camera.focal_length / 4.0 / 2, abs=1)
    assert len(rows) == pytest.approx(len(columns) / 2, abs=1)


def test_depth_is_brighter_nearer_and_the_nearest_surface_wins():
    camera = Camera(0.0, 0.0)
    near, far = box((0.5, 0.5, 0.01), at=(0, 0, 0.4)).mesh(), box((1, 1, 0.01), at=(0, 0, -0.4)).mesh()
    both = Mesh(
        np.concatenate([near.vertices, far.vertices]), np.concatenate([near.faces, far.faces + len(near.vertices)])
    )
    depth = render([both], [camera])[0, 0, 1].astype(int)
    assert depth[32, 32] > depth[32, 18] > depth[0, 0] == 0
    expected = [255 * (0.5 + 0.5 * z / 0.87) for z in (0.405, -0.395)]
    assert [depth[32, 32], depth[32, 18]] == pytest.approx(expected, abs=2)


def test_inverted_faces_look_the_same():
    mesh = table()
    flipped = Mesh(mesh.vertices, mesh.faces[:, ::-1])
    assert np.abs(render([mesh]).astype(int) - render([flipped])).max() <= 1


def test_results_do_not_depend_on_threads():
    meshes = [table(), box((1, 0.5, 0.25)).mesh()] * 10
    assert np.array_equal(render(meshes, threads=1), render(meshes, threads=3))


def test_azimuth_turns_towards_the_right_and_elevation_rises():
    right, up, backward = Camera(90.0, 0.0).frame()
    assert backward == pytest.approx([1, 0, 0], abs=1e-12) and right == pytest.approx([0, 0, -1], abs=1e-12)
    assert up == pytest.approx([0, 1, 0], abs=1e-12)
    for camera in THREE_VIEWS:
        frame = camera.frame()
        assert frame @ frame.T == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(frame) == pytest.approx(1.0)
    assert Camera(0.0, 30.0).frame()[2][1] == pytest.approx(0.5)


def test_a_roll_turns_the_picture_clockwise():
    high = render([box((0.2, 0.2, 0.2), at=(0, 0.35, 0)).mesh()], [Camera(0, 0, roll=90.0)], 64)[0, 0, 1]
    rows, columns = np.nonzero(high)
    assert 40 < columns.mean() < 64 and 28 < rows.mean() < 36  # up has become right
    camera = Camera(30, 20, roll=25.0)
    column, row, _ = camera.project(np.array([[0.0, 0.4, 0.0]]), 64)
    assert column[0] > 32.0 and row[0] < 32.0


def test_what_is_behind_or_too_near_the_camera_is_left_out():
    huge = Mesh(np.eye(3) * 100.0, np.array([[0, 1, 2]]))
    assert render([huge]).shape == (1, 3, 2, 64, 64)


def test_a_mesh_without_area_is_an_empty_picture():
    line = Mesh(np.array([[0.0, 0, 0], [0.5, 0, 0], [0.25, 0, 0]]), np.array([[0, 1, 2]]))
    assert render([line]).max() == 0
    assert render([]).shape == (0, 3, 2, 64, 64)
