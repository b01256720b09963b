"""tools/gallery.py: shapes on one ground, each with its shadow, in tints of their category."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from shapewright.modelling.solids import box

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="module")
def gallery():
    spec = importlib.util.spec_from_file_location("shapewright_gallery", ROOT / "tools" / "gallery.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_shape_shades_the_ground_beside_it_and_covers_its_own_shadow(gallery):
    shadow, colour, cover = gallery.tile(box((0.3, 1, 0.3)).mesh(), np.array([200.0, 100.0, 50.0]))
    assert ((shadow < 0.95) & (cover == 0)).any() and shadow.max() == 1
    inside = cover == 1
    assert np.allclose(colour[inside, 0] / colour[inside, 1], 2)
    assert not colour[cover == 0].any()


def test_shapes_stand_row_by_row_and_the_picture_is_the_same_again(gallery):
    shapes = [(box(1).mesh(), "table"), (box((1, 0.1, 1)).mesh(), "chair"), (box((0.1, 1, 0.1)).mesh(), "bed")]
    picture = gallery.draw(shapes, 2, seed=1)
    assert picture.tobytes() == gallery.draw(shapes, 2, seed=1).tobytes()
    colours = np.asarray(picture.convert("RGB")).astype(int)
    reds = [half.reshape(-1, 3) for half in np.array_split(colours[: gallery.STEP], 2, axis=1)]
    assert all(((half[:, 0] - half[:, 2]) > 20).any() for half in reds)  # wood, orange
    below = colours[-gallery.STEP :]
    assert (below[:, : gallery.STEP, 2] - below[:, : gallery.STEP, 0] > 20).any()  # blue
    assert np.abs(below[:, gallery.TILE :] - gallery.GROUND).max() < 4


def test_samples_are_of_different_tables(gallery):
    meshes = gallery.samples(ROOT / "examples" / "categories" / "table" / "v1.py", 5, seed=0)
    assert len(meshes) == 5 and len({mesh.vertices.tobytes() for mesh in meshes}) == 5
