"""Shapes on disk are those in memory, to the bit."""

from dataclasses import dataclass

import numpy as np
import pytest
import shapely

from broken_disk import full_after
from shapewright.shapes import Drawing, Mesh, Points, shelf
from shapewright.shapes.packed import pack, size_of, unpack


def mesh(seed, faces=40):
    rng = np.random.default_rng(seed)
    corners = rng.integers(0, 20, (faces, 3))
    labels = rng.integers(-1, 2, faces)
    colours = rng.integers(0, 256, (faces, 4), dtype=np.uint8)
    return Mesh(rng.standard_normal((20, 3)), corners, labels, ("leg", "top"), labels, ("a", "b"), colours)


def points(seed):
    rng = np.random.default_rng(seed)
    return Points(*(rng.standard_normal((7, 3)) for _ in range(3)))


def arrays(shape):
    return {name: value for name, value in vars(shape).items() if isinstance(value, np.ndarray)}


def same(one, other):
    assert type(one) is type(other) and arrays(one).keys() == arrays(other).keys()
    assert all(np.array_equal(value, arrays(other)[name]) for name, value in arrays(one).items())
    if isinstance(one, Mesh):
        assert one.labels == other.labels and one.rules == other.rules


@pytest.mark.parametrize("shape", [mesh(1), points(2), Mesh(np.eye(3), [[0, 1, 2]])], ids=["mesh", "points", "plain"])
def test_a_shape_is_packed_to_the_bit(shape):
    head, content = pack(shape)
    assert head["bytes"] == len(content) and len(content) % 8 == 0
    same(unpack(head, content), shape)
    same(shelf.on_disk([mesh(5), shape])[1], shape)


def test_a_drawing_is_packed_to_the_bit():
    drawing = Drawing(shapely.box(0.1, 0.2, 1 / 3, 0.7))
    head, content = pack(drawing)
    assert unpack(head, content + b"the next").geometry.equals_exact(drawing.geometry, 0.0)


def test_a_fresh_copy_is_in_memory():
    (there,) = shelf.on_disk([mesh(1)])
    assert shelf.is_shelved(there) and not shelf.is_shelved(mesh(1))
    copy = shelf.fresh(there)
    assert not shelf.is_shelved(copy)
    same(copy, there)
    assert shelf.fresh(copy) is copy


@dataclass(frozen=True)
class Held:
    shape: object
    number: int = 0


def test_all_but_the_first_go_to_disk(monkeypatch):
    monkeypatch.setattr(shelf, "IN_MEMORY", 3 * size_of(mesh(0)))
    holders = [Held(mesh(number), number) for number in range(10)]
    holders.insert(5, Held(Drawing(shapely.box(0, 0, 1, 1)), 10))
    kept = shelf.shelved(iter(holders))
    assert [each.number for each in kept] == [each.number for each in holders]
    assert [shelf.is_shelved(each.shape) for each in kept] == [False] * 3 + [True, True, False] + [True] * 5
    for one, other in zip(kept, holders, strict=True):
        same(one.shape, other.shape)
    assert all(one is other for one, other in zip(shelf.shelved(kept), kept, strict=True))


def test_few_stay_where_they_are():
    holders = [Held(mesh(number)) for number in range(3)]
    assert all(one is other for one, other in zip(shelf.shelved(holders), holders, strict=True))


def test_a_full_disk_is_told():
    with full_after(1000), pytest.raises(OSError, match="free some space, or name another folder in TMPDIR"):
        shelf.on_disk([mesh(1)])
