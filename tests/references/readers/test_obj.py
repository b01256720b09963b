import numpy as np
import pytest

import boxes
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read

BOX = boxes.obj()


def shape(tmp_path, content: str | bytes):
    path = tmp_path / "a.obj"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(path)


def test_faces_of_the_older_keyword(tmp_path):
    mesh, notes = shape(tmp_path, BOX.replace("f 1 2 4", "fo 1 2 4"))
    assert boxes.is_box(mesh) and notes == ()


def test_surfaces_beside_faces_are_noted_and_alone_are_the_reason(tmp_path):
    surface = "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 3 4\nparm u 0 0 1 1\nparm v 0 0 1 1\nend\n"
    mesh, notes = shape(tmp_path, BOX + surface)
    assert boxes.is_box(mesh) and notes == ("1 free-form curves or surfaces left out; export them as polygons",)
    with pytest.raises(UnreadableError, match="free-form"):
        shape(tmp_path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n" + surface)


def test_lines_of_unknown_keywords_are_noted(tmp_path):
    mesh, notes = shape(tmp_path, BOX + "call part.obj\ncall lid.obj\n")
    assert boxes.is_box(mesh) and notes == ("2 lines left out, the first of them begins with 'call'",)


def test_a_line_that_begins_with_a_number_is_broken(tmp_path):
    with pytest.raises(UnreadableError, match="a line begins with '2', where a keyword is expected"):
        shape(tmp_path, BOX.replace("f 1 2 4", "f 1\n2 4"))


@pytest.mark.parametrize("path", ["# C:\\models\\", "usemtl wood\\", "mtllib C:\\", "g a\\b\\"])
def test_a_name_or_comment_that_ends_in_a_backslash_does_not_take_the_next_line(tmp_path, path):
    assert boxes.is_box(shape(tmp_path, f"{path}\n{BOX}")[0])


@pytest.mark.parametrize("end", ["\n", "\r", "\r\n"])
def test_lines_continue_behind_a_backslash(tmp_path, end):
    assert boxes.is_box(shape(tmp_path, BOX.replace("f 1 2 4", "f 1 \\\n2 \\ \n4").replace("\n", end))[0])


@pytest.mark.parametrize("word", ["1.#IND", "-1.#QNAN", "nan", "1.#INF"])
def test_corners_that_are_not_finite_are_left_out_with_a_note(tmp_path, word):
    _, notes = shape(tmp_path, BOX.replace("v 1 2 3", f"v 1 2 {word}"))
    assert notes == ("6 of 12 triangles left out: a corner is not finite",)


@pytest.mark.parametrize("line", ["v 1_0 2 3", "f 1 2 2.5", "v", "f", "f 1 2 x/3", "v 1 2 0x3"])
def test_a_line_that_is_not_understood_is_broken(tmp_path, line):
    with pytest.raises(UnreadableError, match="broken"):
        shape(tmp_path, f"{BOX}{line}\n")


def test_relative_indices_and_attributes_in_long_files(tmp_path):
    triangle = "v {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf -3/1/1 -2//7 -1/2\n"
    mesh, _ = shape(tmp_path, "".join(triangle.format(i) for i in range(12_000)))
    assert (range(12_000) == mesh.triangles[:, :, 0].T).all()


def test_polygons_of_a_long_file_behind_all_its_vertices(tmp_path):
    squares = [f"v {i} 0 0\nv {i} 1 0\nv {i} 1 1\nv {i} 0 1\n" for i in range(6000)]
    faces = "".join(f"f {4 * i + 1} {4 * i + 2} {4 * i + 3} {4 * i + 4}\n" for i in range(6000))
    mesh, _ = shape(tmp_path, "".join(squares) + faces)
    assert len(mesh.faces) == 12_000
    assert (mesh.triangles[::2, 2, 0] == np.arange(6000)).all()
