import pytest

import shapewright as sw
from shapewright.fitting.pacing.division import Work, divided

SLOW = Work(samples=3000, references=15, fixed=60, search=60)


def building_seconds(settings, work, seconds, workers):
    """Of samples, of what is fixed, and of the search."""
    shapes = settings.samples + work.fixed + work.references * (settings.refine_shapes or 0)
    return shapes * seconds / workers


@pytest.mark.parametrize("within", [120.0, 600.0, 3600.0])
@pytest.mark.parametrize("seconds", [0.1, 1.0, 5.0])
def test_what_is_built_fits_in_the_time(within, seconds):
    settings = divided(sw.Settings(within=within), SLOW, seconds, 2, within)
    assert building_seconds(settings, SLOW, seconds, 2) <= max(within, (60 + 20 + 15) * seconds / 2)


def test_samples_and_search_share_the_time_and_what_one_leaves_goes_to_the_other():
    settings = divided(sw.Settings(), SLOW, 1.0, 2, 600.0)
    assert 300 < settings.samples < 800 and 5 < settings.refine_shapes < 30
    few = divided(sw.Settings(), Work(100, 15, 60, 60), 1.0, 2, 600.0)
    assert few.samples == 100 and few.refine_shapes > settings.refine_shapes
    short = divided(sw.Settings(), Work(3000, 15, 60, 2), 1.0, 2, 600.0)
    assert short.refine_shapes == 2 and short.samples > settings.samples


def test_a_long_limit_changes_nothing_but_the_bound_of_the_search():
    settings = divided(sw.Settings(within=1e6), SLOW, 0.1, 2, 1e6)
    assert settings == sw.Settings(refine_shapes=60)


def test_a_limit_that_is_too_short_leaves_the_least_there_is():
    settings = divided(sw.Settings(within=1.0), SLOW, 1.0, 2, -3.0)
    assert (settings.samples, settings.refine_shapes) == (20, 1)


def test_a_fit_without_a_search_gives_all_to_samples():
    none = divided(sw.Settings(refine="off"), Work(3000, 15, 60, 0), 1.0, 2, 600.0)
    assert none.refine_shapes is None and none.samples > divided(sw.Settings(), SLOW, 1.0, 2, 600.0).samples


def test_the_same_numbers_give_the_same_settings_which_have_no_limit_any_more():
    one, other = (divided(sw.Settings(within=600.0), SLOW, 0.7, 2, 590.0) for _ in range(2))
    assert one == other and one.within is None
