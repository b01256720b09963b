import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from shapewright.modelling.grammar.divisions import repeat, share, split


def lengths(pieces):
    return pytest.approx([end - start for start, end in pieces])


def test_lengths_are_kept_and_shares_divide_the_rest():
    assert lengths(split(1, (0.2, ..., 0.3))) == [0.2, 0.5, 0.3]
    assert lengths(split(1, (0.1, share(1), share(2)))) == [0.1, 0.3, 0.6]
    assert lengths(split(1, (share(0.5), share(1.5)))) == [0.25, 0.75]
    assert lengths(split(1, (0.4, 0.5))) == [0.4, 0.5]
    assert lengths(split(1, (0.4, ..., 0.6))) == [0.4, 0, 0.6]
    assert split(1, ()) == []


@settings(deadline=None)
@given(st.floats(0.1, 1e3), st.lists(st.just(0.0) | st.floats(0.01, 5), min_size=1, max_size=8))
def test_shares_fill_the_whole_without_gaps(whole, weights):
    pieces = split(whole, tuple(share(weight) for weight in weights))
    assert pieces[0][0] == 0 and (pieces[-1][1] == whole or not any(weights))
    assert all(a[1] == b[0] and a[0] <= a[1] for a, b in itertools.pairwise(pieces))


@pytest.mark.parametrize("sizes", [(0.6, 0.5), (-0.1, ...), (share(-1),), (float("nan"),), (float("inf"),)])
def test_what_does_not_fit_is_refused(sizes):
    with pytest.raises(ValueError, match="the sizes"):
        split(1, sizes)


def test_equal_parts():
    assert lengths(repeat(1, 4, None, None)) == [0.25] * 4
    assert lengths(repeat(1.1, 4, None, 0.1)) == [0.2] * 4
    assert repeat(1, 3, 0.2, None) == [pytest.approx(piece) for piece in [(0, 0.2), (0.4, 0.6), (0.8, 1)]]
    assert lengths(repeat(1, 1, 0.2, None)) == [0.2]
    assert lengths(repeat(1, None, 0.27, None)) == [0.25] * 4
    assert lengths(repeat(1, None, 0.21, 0.2)) == [0.2] * 3
    assert lengths(repeat(0.1, None, 3, 5)) == [0.1]


@settings(deadline=None)
@given(st.floats(0.1, 100), st.floats(0.05, 5), st.floats(0, 5))
def test_fitted_parts_fill_the_whole_at_about_their_size(whole, size, gap):
    pieces = repeat(whole, None, size, gap)
    width = pieces[0][1]
    assert pieces[0][0] == 0 and pieces[-1][1] == whole
    assert all(end - start == pytest.approx(width) for start, end in pieces)
    assert all(b[0] - a[1] == pytest.approx(gap, abs=1e-9 * whole) for a, b in itertools.pairwise(pieces))
    if len(pieces) > 1 and gap < size:  # one more or one fewer would be further from the size, gap included
        assert abs(whole + gap - len(pieces) * (size + gap)) <= 0.5 * (size + gap) * (1 + 1e-9)


@pytest.mark.parametrize(
    ("count", "size", "gap"), [(None, None, None), (None, None, 0.1), (2, 0.1, 0.1), (4, 0.3, None), (0, None, None),
                               (20, None, 0.1), (None, 0, 0), (3, None, -0.1), (None, -1, 0.1)]
)  # fmt: skip
def test_parts_that_cannot_be_are_refused(count, size, gap):
    with pytest.raises(ValueError, match=r"of count, size and gap|would divide"):
        repeat(1, count, size, gap)
