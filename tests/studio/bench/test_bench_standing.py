"""Up and front as the bench finds them: by the same function as a fit, in steps, for a file once."""

import numpy as np
import pytest
import trimesh

from shapewright.axes.turns import TURNS
from shapewright.modelling.solids import box
from shapewright.references import Collection, Orientation
from shapewright.references.reading import Readers
from shapewright.references.standing import axes_record
from shapewright.shapes.files import encode
from shapewright.studio.bench import shape_messages
from shapewright.studio.bench.gallery import Gallery
from shapewright.studio.bench.standing import Standing
from shapewright.studio.bench.workshop import Workshop
from shapewright.studio.project.listing import Origin, kept_picture, listing


def seat(width):
    return (box((width, 0.4, 1)) | box((width, 0.6, 0.15), at=(0, 0.5, -0.4))).mesh()


@pytest.fixture
def folder(tmp_path):
    for number, width in enumerate((0.7, 0.8, 1.0, 1.2)):
        (tmp_path / f"{number}.obj").write_bytes(encode(seat(width).transformed(TURNS[7]), "obj"))
    return tmp_path


def ended(steps):
    """What a generator returns, and in how many steps."""
    count = 0
    while True:
        try:
            next(steps)
        except StopIteration as end:
            return end.value, count
        count += 1


@pytest.mark.parametrize("front", [None, "x"])
def test_they_are_those_that_a_collection_finds(folder, front):
    gallery = Gallery(listing(Origin(str(folder), "auto", front)), None, Readers())
    stances, steps = ended(Standing().find(gallery, Workshop(), 0))
    shown = Gallery(gallery.listed, None, Readers(), None, stances)
    for reference in Collection.load(folder, up="auto", front=front):
        assert shown[reference.name].orientation == reference.orientation
        assert (shown.axes(reference.name).up, shown.axes(reference.name).by) == (reference.orientation.up, "found")
        np.testing.assert_allclose(shown[reference.name].shape.vertices, reference.shape.vertices, atol=1e-12)
    assert steps == len(stances) == 4


def test_a_file_is_looked_at_once_and_what_a_run_recorded_stays(folder, monkeypatch):
    standing, listed = Standing(), listing(Origin(str(folder), "auto"))
    gallery = Gallery(listed, None, Readers())
    ended(standing.find(gallery, Workshop(), 0))
    monkeypatch.setattr(Gallery, "given", lambda *_: pytest.fail("a file was read again"))
    record = axes_record(Collection.load(folder, up="auto")["2"]) | {"up": "y", "front": "x"}
    stances, _ = ended(standing.find(Gallery(listed, None, Readers(), None, {"2": record}), Workshop(), 0))
    assert stances["2"] == record and len(stances) == 4


def test_pictures_are_kept_by_how_their_shapes_stand(folder, tmp_path):
    listed = listing(Origin(str(folder), "auto"))
    plain = Gallery(listed, tmp_path / "cache", Readers())
    stances, _ = ended(Standing().find(plain, Workshop(), 0))
    turned = Gallery(listed, tmp_path / "cache", Readers(), None, stances)
    source = listed.sources["0"]
    for gallery, found in ((plain, None), (turned, Orientation().then(TURNS[7].T))):
        drawn = gallery.picture("0")
        assert kept_picture(tmp_path / "cache", source, found).read_bytes() == drawn
    assert plain.picture("0") != turned.picture("0")
    assert plain.unsettled == {*"0123"} and turned.uncertain == {*"0123"}


def test_points_are_found_to_stand_too_and_are_measured_along_the_axes_of_their_file(tmp_path):
    for number, width in enumerate((0.7, 0.8, 1.0, 1.2)):
        mesh = trimesh.Trimesh(*(seat(width).vertices, seat(width).faces), process=False)
        np.savetxt(tmp_path / f"{number}.xyz", mesh.sample(3000, seed=0) @ TURNS[7].T)
    gallery = Gallery(listing(Origin(str(tmp_path), "auto")), None, Readers())
    stances, _ = ended(Standing().find(gallery, Workshop(), 0))
    shown = Gallery(gallery.listed, None, Readers(), None, stances)
    for reference in Collection.load(tmp_path, up="auto"):
        assert shown[reference.name].orientation == reference.orientation
    about = shape_messages.about(shown["2"])
    assert about.units.axes == shown["2"].orientation.matrix.tolist()
    np.testing.assert_allclose(about.units.size, np.ptp(seat(1.0).vertices @ TURNS[7].T, axis=0), atol=0.02)
