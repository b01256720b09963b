import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.lzf import MOST_GROWTH, unpacked


def literals(data: bytes) -> bytes:
    return b"".join(bytes([len(data[i : i + 32]) - 1]) + data[i : i + 32] for i in range(0, len(data), 32))


def copy(length: int, back: int) -> bytes:
    high, low = divmod(back - 1, 256)
    if length < 9:
        return bytes([(length - 2) << 5 | high, low])
    return bytes([7 << 5 | high, length - 9, low])


def test_literals_stand_as_they_are():
    data = np.random.default_rng(0).bytes(1000)
    assert unpacked(literals(data), 1000) == data


@pytest.mark.parametrize(("length", "back"), [(3, 4), (8, 4), (9, 1), (264, 1), (264, 3), (5, 300), (20, 8192)])
def test_copies_reach_back_and_may_overlap_themselves(length, back):
    before = np.random.default_rng(1).bytes(8192)
    whole = before
    for _ in range(length):
        whole += whole[-back : len(whole) - back + 1]
    assert unpacked(literals(before) + copy(length, back), len(whole)) == whole


def test_the_least_that_data_can_be_packed_to():
    data = literals(b"a") + copy(264, 1) * 10
    assert unpacked(data, 2641) == b"a" * 2641
    assert 264 / len(copy(264, 1)) == MOST_GROWTH


@pytest.mark.parametrize(
    ("data", "size"),
    [
        (literals(b"abc"), 4),
        (literals(b"abc"), 2),
        (literals(b"abc")[:-1], 3),
        (literals(b"abc") + copy(4, 4), 7),
        (literals(b"abc") + copy(4, 2), 6),
        (literals(b"abc") + copy(4, 2)[:1], 7),
        (literals(b"abc") + copy(40, 2)[:1], 43),
        (literals(b"abc") + copy(40, 2)[:2], 43),
        (b"", 1),
    ],
)
def test_data_that_end_early_late_or_copy_from_nowhere_are_refused(data, size):
    with pytest.raises(UnreadableError, match="cannot be unpacked"):
        unpacked(data, size)
