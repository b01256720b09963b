"""Which files are masks of others."""

from pathlib import Path

from shapewright.references.readers.views.masks import masks_of


def test_a_mask_goes_by_the_name_of_its_picture():
    paths = [Path("a/chair.jpg"), Path("a/chair.mask.png"), Path("a/table.png"), Path("b/chair.png")]
    assert masks_of(paths) == {paths[0]: paths[1]}


def test_a_mask_without_a_picture_is_a_picture():
    assert masks_of([Path("chair.mask.png"), Path("table.png")]) == {}
