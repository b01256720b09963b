import pytest

import boxes
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read


def shape(tmp_path, content: str | bytes):
    path = tmp_path / "a.off"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(path)


def wide(header: str, *more: int) -> str:
    corners = "".join(f"{boxes.spaced((*corner, *more))}\n" for corner in boxes.CORNERS)
    return header + corners + "".join(f"3 {boxes.spaced(face)}\n" for face in boxes.TRIANGLES)


COLOURED = boxes.off().replace("\n3 ", " \n3 ").replace("\n3 0 1 3 ", "\n3 0 1 3 255 0 0 ")


@pytest.mark.parametrize(
    "content",
    [
        boxes.off(),
        boxes.off("off\n8 12 0\n"),
        boxes.off("8 12 0\n"),
        boxes.off("OFF8 12 0\n"),
        boxes.off("OFF 8\n12 0\n"),
        boxes.off("OFF\n8 12\n0\n"),
        boxes.off().replace("\n", " "),
        boxes.off("OFF # a box\n# its size: 8 12 0\n8 12 0 # so\n"),
        boxes.off("nOFF\n3\n8 12 0\n"),
        boxes.off("nOFF 3 8 12 0\n"),
        COLOURED,
        COLOURED.replace("0 0 3\n", "0\n0 3\n", 1),
        wide("COFF\n8 12 0\n", 255, 0, 0, 255),
        wide("OFF\n8 12 0\n", 255, 0, 0),
        wide("NOFF\n8 12 0\n", 0, 0, 1),
        wide("STOFF\n8 12 0\n", 0, 0),
        wide("NCSTOFF\n8 12 0\n", 0, 0, 1, 9, 9, 9, 9, 0, 0),
        wide("NCSTOFF\n8 12 0\n", 0, 0, 1, 9, 9, 9, 9, 0, 0).replace("\n", " "),
        wide("4OFF\n8 12 0\n", 1),
        wide("C4OFF\n8 12 0\n", 1, 9, 9, 9, 9).replace("\n", "\n\n"),
    ],
)  # fmt: skip
def test_every_form_of_the_box(tmp_path, content):
    assert boxes.is_box(shape(tmp_path, content)[0])


def test_the_fourth_coordinate_divides(tmp_path):
    mesh, _ = shape(tmp_path, "4OFF\n3 1 0\n0 0 0 2\n2 0 0 2\n0 1 0 .5\n3 0 1 2\n")
    assert mesh.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [0, 2, 0]]


def test_a_face_on_several_lines(tmp_path):
    mesh, _ = shape(tmp_path, "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0\n1\n2\n3\n")
    assert len(mesh.faces) == 2


@pytest.mark.parametrize(
    ("content", "why"),
    [
        ("OFF BINARY\n\0\0", "binary OFF, which is not read; save it as text"),
        ("COFF BINARY\n\0\0", "binary OFF"),
        ("<html>", "does not begin with OFF, but with '<html>'"),
        ("nOFF\n4\n1 1 0\n", "more or fewer than 3 dimensions"),
        ("OFF\nmany\n", "'many' is no number"),
        ("OFF\n-1 2 0\n", "no numbers of vertices and faces"),
        (boxes.off() + "3 0 1 2\n", "8 vertices and 12 faces announced, and it holds more"),
        (boxes.off("OFF\n9 12 0\n"), "cut short"),
        (boxes.off("OFF\n999999999999 12 0\n"), "cut short"),
        (boxes.off().replace("3 0 1 3", "3 0 1 x"), "'x' is no number"),
        (boxes.off().replace("3 0 1 3", "3 0 1.5 3"), "no whole number"),
        (boxes.off().replace("3 0 1 3", "-1 0 1 3"), "number of corners is no whole number"),
        (boxes.off().replace("3 0 1 3", "nan 0 1 3"), "number of corners is no whole number"),
        (boxes.off().replace("3 0 1 3", "9 0 1 3"), "the line of face 0 has too few numbers"),
        (boxes.off().replace("0 0 3\n", "0 3\n", 1), "the line of vertex 1 has too few numbers"),
    ],
)  # fmt: skip
def test_what_is_cut_or_cannot_be_understood_has_a_reason(tmp_path, content, why):
    with pytest.raises(UnreadableError, match=why):
        shape(tmp_path, content)
