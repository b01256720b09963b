"""Pictures of references in the cache."""

import os

import pytest

from broken_disk import full_after, hidden, shown
from shapewright.modelling.solids import box
from shapewright.references.reading import Readers
from shapewright.shapes.files import encode
from shapewright.studio.bench.gallery import Gallery
from shapewright.studio.project.listing import Listing, Origin, listing


def test_a_picture_is_kept_whole_or_not_at_all(tmp_path):
    (tmp_path / "references").mkdir()
    (tmp_path / "references" / "cube.ply").write_bytes(encode(box(1).mesh(), "ply"))
    cache = tmp_path / "cache"
    gallery = Gallery(listing(Origin(str(tmp_path / "references"))), cache, Readers())
    with pytest.raises(OSError, match="File too large"), full_after(100):
        gallery.picture("cube")
    assert not shown(cache) and not hidden(cache)
    drawn = gallery.picture("cube")
    assert list(shown(cache).values()) == [drawn] and not hidden(cache)


def test_a_gallery_removes_what_killed_writers_left_long_ago(tmp_path):
    pictures = tmp_path / "cache" / "thumbnails"
    pictures.mkdir(parents=True)
    leftover, young = pictures / ".a.png.1234.partial", pictures / ".b.png.5678.partial"
    leftover.touch()
    young.touch()
    os.utime(leftover, (0, 0))
    Gallery(Listing({}, {}), tmp_path / "cache", Readers())
    assert not leftover.exists() and young.exists()


def test_the_shape_of_a_file_that_was_written_anew_is_not_kept_as_that_of_the_new_one(tmp_path):
    file = tmp_path / "references" / "cube.ply"
    file.parent.mkdir()
    file.write_bytes(encode(box(1).mesh(), "ply"))
    gallery = Gallery(listing(Origin(str(file.parent))), tmp_path / "cache", Readers())
    assert gallery["cube"].shape and (before := gallery.kept_shape("cube"))
    file.write_bytes(encode(box((1, 2, 30)).mesh(), "ply"))
    os.utime(file, (0, 0))
    assert gallery["cube"].shape.extent.min() == 1.0 and gallery.kept_shape("cube") is None
    anew = Gallery(gallery.listed, tmp_path / "cache", Readers())
    assert anew["cube"].shape.extent.min() < 0.1 and anew.kept_shape("cube") not in (None, before)
