import numpy as np
import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.clouds.columns import read_pts, read_xyz

ROWS = "0 0 0\n1.5 0 -2e1\n0 2 3\n"
PLACES = [[0, 0, 0], [1.5, 0, -20], [0, 2, 3]]


@pytest.mark.parametrize(
    "text",
    [
        ROWS,
        ROWS.replace("\n", "\r\n"),
        ROWS.replace("\n", "\r"),
        ROWS.replace(" ", "\t"),
        ROWS.replace(" ", ","),
        ROWS.replace(" ", ", "),
        ROWS.replace(" ", ";"),
        "X Y Z\n" + ROWS,
        '"x","y","z"\n' + ROWS.replace(" ", ","),
        "# made by hand\n" + ROWS + "# the end\n",
        "//X,Y,Z\n" + ROWS,
        "\ufeff" + ROWS,
        ROWS.rstrip() + "\0\x1a",
        "\n\n" + ROWS.replace("\n", "\n\n"),
    ],
    ids=repr,
)
def test_points_are_lines_of_numbers_however_they_are_set_apart(text):
    cloud = read_xyz(text.encode())
    assert (cloud.positions == PLACES).all()
    assert cloud.normals is None and cloud.notes == ()


def test_whole_numbers_may_be_set_apart_by_commas_alone():
    assert (read_xyz(b"0,0,0\n1,2,3\n").positions == [[0, 0, 0], [1, 2, 3]]).all()


def test_three_columns_of_length_one_are_normals_wherever_they_stand():
    normals = np.array([[0, 0, 1], [0.6, 0.8, 0], [-0.577, 0.577, 0.577]])
    places = np.array(PLACES)
    for colours in (np.empty((3, 0)), np.array([[255, 0, 3]] * 3)):
        for parts in ((places, normals, colours), (places, colours, normals)):
            table = "\n".join(" ".join(f"{x:g}" for x in row) for row in np.hstack(parts))
            cloud = read_xyz(table.encode())
            assert (cloud.normals == normals).all()
            assert cloud.notes == (("3 more columns left out, such as colours",) if colours.size else ())


def test_colours_are_no_normals_and_are_told():
    cloud = read_xyz(b"0 0 0 0 0 255\n1 0 0 255 0 0\n")
    assert cloud.normals is None
    assert cloud.notes == ("3 more columns left out, such as colours",)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("0 0 0\n1 1\n2 2 2\n", r"row 2 has 2 numbers, others have 3: '1 1'"),
        ("0 0 0\n1 1 1 1\n2 2 2\n", "row 2 has 4 numbers, others have 3"),
        ("1 2\n3 4\n", "2 numbers, fewer than a point's three"),
        ("0 0 0\n1 a 1\n", "'a' is no number"),
        ("1,5 2,5 3,5\n", "decimals need a point"),
        ("1,5;2,5;3,5\n", "decimals need a point"),
        ("3\nwater\nO 0.0 0.0 0.1\nH 0.0 0.7 -0.4\nH 0.0 -0.7 -0.4\n", "a molecule"),
        ("# nothing\n", "it holds no points"),
    ],
)
def test_rows_that_are_not_understood_are_refused(text, why):
    with pytest.raises(UnreadableError, match=why):
        read_xyz(text.encode())


def test_pts_begin_with_their_number_and_may_be_several_clouds():
    assert (read_pts(b"3\n" + ROWS.encode()).positions == PLACES).all()
    assert (read_pts(b"2\n0 0 0\n1.5 0 -20\n1\n0 2 3\n").positions == PLACES).all()
    assert (read_pts(ROWS.encode()).positions == PLACES).all()
    cloud = read_pts(b"2\n0 0 0 -1400 200 100 3\n1 1 1 12 0 0 0\n")
    assert (cloud.positions == [[0, 0, 0], [1, 1, 1]]).all()
    assert cloud.notes == ("4 more columns left out, such as colours",)


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("4\n" + ROWS, "cut short: it declares 4 points and holds 3"),
        ("2\n" + ROWS, "broken: it declares 2 points and holds 3"),
        ("-1\n" + ROWS, "it declares -1 points and holds 3"),
        ("1000000000000\n" + ROWS, "cut short: it declares 1e"),
        ("0 0 0\n2\n1 1 1\n", "line 2 holds one number"),
        ("version: 1\nn_points: 68\n{\n1 2\n}\n", "no number"),
    ],
)
def test_pts_have_as_many_points_as_they_declare(text, why):
    with pytest.raises(UnreadableError, match=why):
        read_pts(text.encode())
