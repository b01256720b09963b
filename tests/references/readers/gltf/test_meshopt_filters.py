import numpy as np
import pytest

from shapewright.references.readers.gltf.meshopt_filters import FILTERS


def applied(name: str, values, kind: str) -> np.ndarray:
    stored = np.array(values, "<" + kind)
    return FILTERS[name].apply(stored.view(np.uint8)).view("<" + kind)


@pytest.mark.parametrize(("kind", "one", "scale"), [("i1", 127, 127), ("i2", 1023, 32767)])
def test_octahedral_gives_unit_vectors_of_either_side(kind, one, scale):
    corner = [round(one * x) for x in (0.25, -0.25)]
    values = [[0, 0, one, 7], [one, 0, one, -7], [0, -one, one, 0], [*corner, one, 0], [one, one, one, 0]]
    found = applied("OCTAHEDRAL", values, kind)
    assert found[:, 3].tolist() == [7, -7, 0, 0, 0]
    side = 6**-0.5
    expected = np.array([[0, 0, 1], [1, 0, 0], [0, -1, 0], [side, -side, 2 * side], [0, 0, -1]])
    np.testing.assert_allclose(found[:, :3] / scale, expected, atol=1.5 / one)


def test_octahedral_survives_vectors_that_are_not_valid():
    assert applied("OCTAHEDRAL", [[1, 2, 0, 0], [0, 0, 0, 0]], "i2").shape == (2, 4)


def test_quaternions_have_their_largest_component_put_back():
    half = 0.5**0.5
    quaternion = np.array([0.1, -0.2, 0.3, (1 - 0.01 - 0.04 - 0.09) ** 0.5])
    one = 2047
    for largest in range(4):
        # The others follow on the largest one, which is left out.
        others = np.rint(np.array([0.1, -0.2, 0.3]) / half * one).astype(int)
        found = applied("QUATERNION", [[*others, one & ~3 | largest]], "i2")[0] / 32767
        np.testing.assert_allclose(np.roll(found, 3 - largest), quaternion, atol=1e-3)


def test_exponents_and_mantissas_make_floats():
    values = [3 | 0 << 24, (-3 & 0xFFFFFF) | 2 << 24, 5 | (-1 & 0xFF) << 24, 0]
    stored = np.array([values], dtype="<u4")
    found = FILTERS["EXPONENTIAL"].apply(stored.view(np.uint8)).view("<f4")
    assert found.tolist() == [[3.0, -12.0, 2.5, 0.0]]
