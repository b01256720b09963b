"""Forms of rules, and the file that keeps them."""

import numpy as np
import pytest

from shapewright.feedback.parts import gallery as module
from shapewright.feedback.parts.gallery import Gallery, form_of
from shapewright.modelling.solids import box
from shapewright.rules.library import bundled_rules
from shapewright.rules.rule import rule

TUBE = next(rule for rule in bundled_rules("forms") if rule.name == "tube")


def arrays(found):
    arguments, form = found
    return arguments, form.size, form.samples.points, form.samples.normals, form.samples.area


def same(one, other):
    return all(np.array_equal(a, b) for a, b in zip(arrays(one), arrays(other), strict=True))


def test_the_first_parameters_are_the_defaults_and_there_is_an_end():
    gallery = Gallery(None)
    assert gallery.form(TUBE, (0, 0), 0)[0] == TUBE.space.defaults
    assert gallery.form(TUBE, (0, 0), 1)[0] != TUBE.space.defaults and gallery.form(TUBE, (0, 0), 99) is None
    assert gallery.form(TUBE, (1, -1), 0)[1].size == pytest.approx((1.0, 2.5, 0.4))


def test_what_was_kept_is_found_again_and_not_made_again(tmp_path, monkeypatch):
    first = Gallery.opened(tmp_path / "cache")
    made = [first.form(TUBE, (0, 0), number) for number in range(2)]
    first.keep()
    monkeypatch.setattr(module, "form_of", None)
    again = Gallery.opened(tmp_path / "cache")
    assert all(same(one, again.form(TUBE, (0, 0), number)) for number, one in enumerate(made))


def test_an_authors_own_rules_are_not_kept(tmp_path):
    own = rule("on")(lambda size: box(size))
    gallery = Gallery.opened(tmp_path)
    assert gallery.form(own, (0, 0), 0)
    gallery.keep()
    assert not list(tmp_path.iterdir())


def test_a_damaged_file_counts_as_none_and_is_replaced(tmp_path):
    first = Gallery.opened(tmp_path)
    made = first.form(TUBE, (0, 0), 0)
    first.keep()
    (file,) = tmp_path.iterdir()
    file.write_bytes(file.read_bytes()[:300])
    damaged = Gallery.opened(tmp_path)
    assert same(damaged.form(TUBE, (0, 0), 0), made)
    damaged.keep()
    assert same(Gallery.opened(tmp_path).form(TUBE, (0, 0), 0), made)


def test_a_rule_that_makes_nothing_has_no_form(tmp_path, monkeypatch):
    def fails(size):
        raise ValueError("too small")

    broken = rule("on")(fails)
    assert form_of(broken, np.ones(3), {}) is None
    monkeypatch.setattr(fails, "__module__", TUBE.function.__module__)
    gallery = Gallery.opened(tmp_path)
    assert gallery.form(broken, (0, 0), 0) is None
    gallery.keep()
    assert Gallery.opened(tmp_path).form(broken, (0, 0), 0) is None


def test_a_folder_that_cannot_be_written_is_no_failure(tmp_path):
    (tmp_path / "file").write_text("")
    gallery = Gallery.opened(tmp_path / "file" / "below")
    assert gallery.form(TUBE, (0, 0), 0)
    gallery.keep()
