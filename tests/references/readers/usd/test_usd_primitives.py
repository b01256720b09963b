import sys

import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.usd import primitives


def volume(piece) -> float:
    corners = piece[0][piece[1]]
    return float((corners[:, 0] * np.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def is_closed(piece) -> bool:
    points = np.round(piece[0], 9)
    _, number = np.unique(points, axis=0, return_inverse=True)
    faces = number.reshape(-1)[piece[1]]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return sorted(map(tuple, edges.tolist())) == sorted(map(tuple, edges[:, ::-1].tolist()))


@pytest.mark.parametrize(
    ("piece", "wanted"),
    [
        (primitives.cuboid(np.array([1.0, 2.0, 3.0])), 6.0),
        (primitives.sphere(1.0), 4 / 3 * np.pi),
        (primitives.frustum(1.0, 1.0, 2.0), 2 * np.pi),
        (primitives.frustum(1.0, 0.0, 3.0), np.pi),
        (primitives.capsule(1.0, 1.0, 2.0), 2 * np.pi + 4 / 3 * np.pi),
    ],
    ids=["cube", "sphere", "cylinder", "cone", "capsule"],
)
def test_a_shape_is_closed_turned_outward_and_of_its_volume(piece, wanted):
    assert is_closed(piece)
    assert volume(piece) == pytest.approx(wanted, rel=5e-3)


@pytest.mark.parametrize(("axis", "extent"), [("X", [4, 2, 2]), ("Y", [2, 4, 2]), ("Z", [2, 2, 4])])
def test_a_shape_lies_along_its_axis(axis, extent):
    piece = primitives.along(axis, primitives.frustum(1.0, 1.0, 4.0))
    assert np.ptp(piece[0], axis=0).tolist() == pytest.approx(extent)
    assert volume(piece) > 0


def test_without_the_library_the_way_to_it_is_told(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pxr", None)
    (tmp_path / "a.usda").write_text("#usda 1.0\n")
    with pytest.raises(UnreadableError, match=r"pip install 'shapewright\[usd\]'"):
        read(tmp_path / "a.usda")
