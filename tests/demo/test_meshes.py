"""The demo collection: what it holds, that it is flawed as it says, and that it reads as a collection."""

import numpy as np
import pytest

from shapewright import Collection, Mesh
from shapewright.demo import flaws
from shapewright.demo.meshes import BROKEN, write
from shapewright.demo.models import tables
from shapewright.modelling.solids import box, cylinder
from shapewright.shapes.files import FORMATS


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("demo")


@pytest.fixture(scope="module")
def paths(folder):
    return write(folder / "tables")


@pytest.fixture(scope="module")
def collection(paths):
    return Collection.load(paths[0].parent, up="y")


def uses_of_edges(mesh: Mesh) -> np.ndarray:
    """How many faces each edge has, by the places of its ends."""
    _, places = np.unique(mesh.vertices, axis=0, return_inverse=True)
    edges = np.sort(places[mesh.faces][:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(edges, axis=0, return_counts=True)[1]


def signed_volume(mesh: Mesh) -> float:
    a, b, c = (mesh.triangles[:, i] for i in range(3))
    return float(np.einsum("fd,fd->", a, np.cross(b, c)) / 6)


def test_every_table_stands_on_the_floor_and_is_of_closed_parts():
    for name, solids in tables().items():
        meshes = [solid.mesh() for solid in solids]
        bounds = np.array([mesh.bounds for mesh in meshes])
        assert abs(bounds[:, 0, 1].min()) < 5, name
        assert all((uses_of_edges(mesh) % 2 == 0).all() for mesh in meshes), name
        low, high = bounds[:, 0].min(axis=0), bounds[:, 1].max(axis=0)
        np.testing.assert_allclose((low + high)[0], 0, atol=0.5, err_msg=name)


def test_about_forty_files_of_every_format(paths):
    assert 40 <= len(paths) <= 50
    assert {path.suffix.lstrip(".") for path in paths} == set(FORMATS)
    assert all(path.is_file() for path in paths)
    assert {path.stem for path in paths} == {*tables(), BROKEN.rpartition(".")[0]}


def test_the_files_are_the_same_every_time(paths, folder):
    again = write(folder / "again")
    assert [path.name for path in again] == [path.name for path in paths]
    assert all(a.read_bytes() == b.read_bytes() for a, b in zip(paths, again, strict=True))


def test_all_but_the_broken_file_can_be_read(collection, paths):
    assert len(collection) == len(paths) - 1
    assert [path.name for path in collection.skipped] == [BROKEN]


def test_units_and_places_differ_but_the_proportions_are_the_models(collection):
    scales = [reference.transform.scale for reference in collection]
    assert max(scales) / min(scales) > 100
    for reference in collection:
        bounds = np.array([solid.bounds for solid in tables()[reference.name]])
        extent = bounds[:, 1].max(axis=0) - bounds[:, 0].min(axis=0)
        np.testing.assert_allclose(reference.shape.extent, extent / extent.max(), atol=0.06, err_msg=reference.name)


def test_many_are_open_and_some_have_faces_twice(collection):
    uses = {reference.name: uses_of_edges(reference.shape) for reference in collection}
    assert sum((count == 1).any() for count in uses.values()) >= 10
    assert sum((count > 2).any() for count in uses.values()) >= 5


@pytest.fixture
def parts():
    return [box((10, 0.3, 6), at=(0, 7, 0)).mesh(), cylinder((1, 7, 1), at=(0, 3.5, 0)).mesh()]


def test_flaws_do_what_they_are_called(parts):
    rng = np.random.default_rng(0)
    top, leg = parts
    assert [len(part.faces) for part in flaws.without_bottoms(parts, rng)] == [10, len(leg.faces) - 30]

    sheet, kept = flaws.one_sheet(parts, rng)
    assert sheet.extent[1] == 0 and sheet.extent[0] == 10
    assert kept is leg

    assert len(flaws.part_twice(parts, rng)) == 3

    turned = [part for _ in range(8) for part in flaws.parts_inside_out([top], rng)]
    assert {round(signed_volume(part), 6) for part in turned} == {18.0, -18.0}

    (mixed,) = flaws.faces_inside_out([leg], rng)
    assert 0 < (mixed.faces != leg.faces).any(axis=1).sum() < len(leg.faces) / 2
    np.testing.assert_array_equal(np.sort(mixed.faces), np.sort(leg.faces))

    loose = flaws.unwelded(parts, rng)[0]
    assert len(loose.vertices) == 36
    np.testing.assert_array_equal(loose.triangles, top.triangles)
    assert all(flaw(parts, rng) for flaw in flaws.FLAWS)
