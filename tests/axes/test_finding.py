import numpy as np
import pytest

from shapewright.axes.finding import find
from shapewright.axes.turns import AFTER, AS_IT_IS, INVERSE, TURNS, UPRIGHT
from shapewright.modelling.solids import box, cylinder
from shapewright.prediction.scanning import Scanner, side_cameras
from shapewright.references.scans.cleaning import cleaned
from shapewright.shapes import Mesh


def chair(width=0.9, seat=0.45, back=0.6, left_arm=False):
    """Four legs, a seat, a back behind it; and if wanted one arm."""
    shape = box((width, 0.08, 0.9), at=(0, seat, 0)) | box((width, back, 0.08), at=(0, seat + back / 2, -0.41))
    for x in (1, -1):
        for z in (1, -1):
            shape = shape | box((0.08, seat, 0.08), at=(x * (width / 2 - 0.04), seat / 2, z * 0.41))
    arm = box((0.08, 0.25, 0.8), at=(-width / 2 + 0.04, seat + 0.12, 0))
    return (shape | arm if left_arm else shape).mesh()


CHAIRS = [
    chair(width, seat, back) for width in (0.7, 0.9, 1.1) for seat in (0.35, 0.45, 0.55) for back in (0.4, 0.6, 0.8)
]


def turned(shape, number):
    return shape.transformed(TURNS[number])


@pytest.mark.parametrize("number", [AS_IT_IS, 5, 13, 22])
def test_a_collection_that_was_turned_as_one_is_turned_back(number):
    found = find([turned(shape, number) for shape in CHAIRS[::4]])
    assert {each.turn for each in found} == {INVERSE[number]}
    assert all(each.has_up and each.fronts == 1 for each in found)


def test_beside_a_procedures_shapes_each_is_told_by_its_own():
    turns = np.random.default_rng(0).integers(0, 24, 8)
    given = [turned(shape, number) for shape, number in zip(CHAIRS[::3], turns, strict=False)]
    assert [each.turn for each in find(given, taught=CHAIRS)] == INVERSE[turns].tolist()


def test_a_procedure_decides_what_is_the_front():
    sideways = [turned(shape, UPRIGHT[1]) for shape in CHAIRS]
    assert {each.turn for each in find(CHAIRS[::4], taught=sideways)} == {UPRIGHT[1]}


def test_a_mirror_image_stands_as_what_it_mirrors():
    taught = [chair(0.7 + 0.01 * i, 0.4, 0.6, left_arm=True) for i in range(25)]
    mirrored = Mesh(taught[12].vertices * [-1, 1, 1], taught[12].faces[:, ::-1])
    assert [each.turn for each in find([mirrored], taught=taught)] == [AS_IT_IS]


def test_what_is_told_of_an_axis_is_kept():
    up_known = np.zeros((1, 24), dtype=bool)
    up_known[0, UPRIGHT] = True
    upside_down = turned(CHAIRS[4], AFTER[1, UPRIGHT[0]])
    (found,) = find([upside_down], allowed=up_known, taught=CHAIRS)
    assert found.turn in UPRIGHT


def scanned(mesh, seed):
    """What three sides a little from above see of it: nobody has seen its underside."""
    scanner = Scanner(side_cameras((30.0, 150.0, 270.0), (25.0, 20.0, 30.0)), 3000)
    return cleaned(scanner.scan(mesh, np.random.default_rng(seed)))[0].normalised()


def drawers(width, height):
    """A chest whose underside is closed; a scanner does not see that."""
    shape = box((width, height, 0.5), at=(0, height / 2, 0))
    for middle in (height / 6, height / 2, height * 5 / 6):
        shape = shape | box((0.9 * width, 0.28 * height, 0.03), at=(0, middle, 0.255))
        shape = shape | box((0.2 * width, 0.03, 0.04), at=(0, middle, 0.28))
    return shape.mesh()


def test_scans_are_told_by_what_scans_look_like():
    chests = [drawers(*size) for size in ((0.6, 0.8), (0.8, 0.7), (0.5, 1.0), (1.0, 0.6), (0.7, 0.9))]
    found = find([scanned(mesh, seed).transformed(TURNS[13]) for seed, mesh in enumerate(chests)])
    assert {each.turn for each in found} == {INVERSE[13]}


@pytest.mark.parametrize("taught", [(), CHAIRS])
def test_scans_and_meshes_agree(taught):
    scans = [scanned(mesh, seed).transformed(TURNS[13]) for seed, mesh in enumerate(CHAIRS[::4])]
    found = find([*scans, *(turned(mesh, 13) for mesh in CHAIRS[1::4])], taught=taught)
    assert {each.turn for each in found} == {INVERSE[13]}


def test_a_round_table_has_no_front_and_a_box_no_up():
    round_table = cylinder((1, 0.06, 1), at=(0, 0.7, 0), segments=64) | cylinder((0.1, 0.7, 0.1), at=(0, 0.35, 0))
    table, block = find([round_table.mesh(), box((1, 0.4, 0.6)).mesh()])
    assert (table.has_up, table.fronts) == (True, 4)
    assert (block.has_up, block.turn) == (False, AS_IT_IS)
