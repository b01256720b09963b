import struct

import numpy as np
import pytest

import boxes
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.ply_tables import TYPES

POINTS = ["0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 2 0"]
VERTEX = "property float x\nproperty float y\nproperty float z\n"


def shape(tmp_path, content: str | bytes):
    path = tmp_path / "a.ply"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(path)


def reason(tmp_path, content: str | bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        shape(tmp_path, content)
    return str(error.value)


def strips(faces: list[str], lists: list[str]) -> str:
    header = f"ply\nformat ascii 1.0\nelement vertex 5\n{VERTEX}element face {len(faces)}\n"
    header += f"property list uchar int vertex_indices\nelement tristrips {len(lists)}\n"
    return "\n".join([header + "property list int int vertex_indices\nend_header", *POINTS, *faces, *lists, ""])


def area(mesh) -> float:
    edges = np.diff(mesh.triangles, axis=1)
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum() / 2)


@pytest.mark.parametrize("after", [" 0 0 0", " 6 0.1 0.2 0.3 0.4 0.5 0.6"])
def test_values_behind_those_that_are_declared_are_left_out_with_a_note(tmp_path, after):
    text = boxes.ply()
    head, _, faces = text.partition("3 0 1 3\n")
    rows = [f"{row}{after}" for row in ["3 0 1 3", *faces.splitlines()]]
    mesh, notes = shape(tmp_path, head + "\n".join(rows))
    assert boxes.is_box(mesh) and notes == ("12 rows 'face' hold more values than the header declares: left out",)


def test_a_row_with_too_few_values_is_refused(tmp_path):
    assert "row 1 of 'vertex' holds fewer values" in reason(tmp_path, boxes.ply().replace("\n0 0 3\n", "\n0 0\n"))
    assert "row 0 of 'face' holds fewer values" in reason(tmp_path, boxes.ply().replace("\n3 0 1 3\n", "\n3 0 1\n"))


def test_text_without_lines_is_read_as_long_as_it_is_used_up(tmp_path):
    header, _, body = boxes.ply().partition("end_header\n")
    assert boxes.is_box(shape(tmp_path, header + "end_header\n" + body.replace("\n", " "))[0])
    assert "cut short: it has 1 rows" in reason(tmp_path, header + "end_header\n" + body.replace("\n", " ")[:-3])
    assert "broken: it has 21 rows, and its header declares 20" in reason(tmp_path, boxes.ply() + "3 0 1 2\n")


def test_strips_beside_faces_and_alone(tmp_path):
    both, _ = shape(tmp_path, strips(["3 0 1 2"], ["5 0 1 2 3 4"]))
    assert both.bounds[1].tolist() == [1, 2, 0] and len(both.faces) == 4 and area(both) == pytest.approx(2.0)
    alone, _ = shape(tmp_path, strips([], ["5 0 1 2 3 4"]))
    assert area(alone) == pytest.approx(1.5)
    normals = np.cross(alone.triangles[:, 1] - alone.triangles[:, 0], alone.triangles[:, 2] - alone.triangles[:, 0])
    assert (normals[:, 2] > 0).all()


def test_strips_restart_and_lead_on_without_area(tmp_path):
    one, _ = shape(tmp_path, strips([], ["7 0 1 2 -1 1 3 2"]))
    two, _ = shape(tmp_path, strips([], ["3 0 1 2", "3 1 3 2"]))
    led, _ = shape(tmp_path, strips([], ["4 0 1 2 2", "3 1 3 2"]))
    assert one.triangles.tolist() == two.triangles.tolist() == led.triangles.tolist()


@pytest.mark.parametrize("name", ["vertex_index", "vertex_indexes", "VertexIndices"])
def test_the_list_of_corners_has_several_names(tmp_path, name):
    assert boxes.is_box(shape(tmp_path, boxes.ply(name))[0])


def test_a_list_of_another_name_or_an_element_of_another_kind_is_named(tmp_path):
    assert "only corner_list" in reason(tmp_path, boxes.ply("corner_list"))
    assert "no faces but elements 'patch'" in reason(tmp_path, boxes.ply().replace("element face", "element patch"))
    assert "no property 'z', only x, y, w" in reason(tmp_path, boxes.ply().replace("float z", "float w"))


def test_other_elements_with_lists_are_noted(tmp_path):
    text = boxes.ply().replace("end_header", "element patch 1\nproperty list int int corners\nend_header") + "2 0 1\n"
    mesh, notes = shape(tmp_path, text)
    assert boxes.is_box(mesh) and notes == ("1 elements 'patch' left out",)


@pytest.mark.parametrize("line", ["property quad x", "element face many", "propriety float x", "element"])
def test_a_header_line_that_is_not_understood_is_refused(tmp_path, line):
    assert f"cannot understand the line '{line}'" in reason(tmp_path, boxes.ply().replace("end_h", f"{line}\nend_h"))


def test_an_element_that_is_declared_twice_is_refused(tmp_path):
    assert "declares 'face' twice" in reason(tmp_path, boxes.ply().replace("end_h", "element face 0\nend_h"))


def header(word: str, kind: str, length: str, index: str, end: str = "\n") -> bytes:
    axes = "".join(f"property {kind} {axis}\n" for axis in "xyz")
    return (
        f"ply\nformat {word} 1.0\nelement vertex 4\nproperty list uchar short tags\n{axes}element face 2\n"
        f"property uchar flag\nproperty list {length} {index} vertex_indices\nproperty double weight\nend_header\n"
    ).replace("\n", end).encode()  # fmt: skip


def body(order: str, kind: str, length: str, index: str, loops=((0, 1, 2), (0, 2, 3, 1))) -> bytes:
    def pack(letter: str, *values) -> bytes:
        return np.array(values).astype(order + letter).tobytes()

    points = [(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0)]
    rows = [pack("u1", n % 3) + pack("i2", *range(n % 3)) + pack(TYPES[kind], *points[n]) for n in range(4)]
    faces = [pack("u1", 1) + pack(TYPES[length], len(f)) + pack(TYPES[index], *f) + pack("f8", 0.5) for f in loops]
    return b"".join(rows + faces)


@pytest.mark.parametrize(("word", "order"), [("binary_little_endian", "<"), ("binary_big_endian", ">")])
@pytest.mark.parametrize("kind", sorted(TYPES))
def test_every_type_and_lists_anywhere_in_both_orders(tmp_path, word, order, kind):
    whole = kind if "float" not in kind and "double" not in kind else "int"
    for loops in (((0, 1, 2), (0, 2, 3, 1)), ((0, 1, 2), (0, 2, 3))):
        data = header(word, kind, whole, kind) + body(order, kind, whole, kind, loops)
        mesh, notes = shape(tmp_path, data)
        assert mesh.triangles[0].tolist() == [[0, 0, 0], [4, 0, 0], [4, 4, 0]] and notes == ()
        assert len(mesh.faces) == sum(len(loop) - 2 for loop in loops)


def test_lines_that_end_in_one_sign_leave_the_first_byte_of_the_body(tmp_path):
    points = struct.pack("<9f", *struct.unpack("<f", b"\n\0\0?"), 0, 0, 2, 0, 0, 0, 2, 0)
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex 3\n{VERTEX}element face 1\n"
    head += "property list uchar int vertex_indices\nend_header\n"
    data = head.replace("\n", "\r").encode() + points + struct.pack("<B3i", 3, 0, 1, 2)
    assert shape(tmp_path, data)[0].vertices[0, 0] == struct.unpack("<f", b"\n\0\0?")[0]


def test_bytes_that_are_left_over_are_refused_but_for_padding(tmp_path):
    data = header("binary_little_endian", "float", "uchar", "int") + body("<", "float", "uchar", "int")
    assert len(shape(tmp_path, data + b"\n\0")[0].faces) == 3
    assert "4 bytes follow what its header declares" in reason(tmp_path, data + b"abcd")


@pytest.mark.parametrize("count", [-1, 100])
def test_a_list_whose_length_cannot_be_is_refused(tmp_path, count):
    data = header("binary_little_endian", "float", "char", "int") + body("<", "float", "char", "int")
    at = len(data) - (1 + 1 + 16 + 8) + 1
    assert reason(tmp_path, data[:at] + struct.pack("<b", count) + data[at + 1 :]).startswith(("broken", "cut short"))
    text = boxes.ply().replace("\n3 0 1 3\n", f"\n{count} 0 1 3\n")
    assert "row 0 of 'face' holds fewer values" in reason(tmp_path, text)


def test_a_corner_that_is_no_whole_number_is_refused(tmp_path):
    assert "no whole number" in reason(tmp_path, boxes.ply().replace("\n3 0 1 3\n", "\n3 0 1.5 3\n"))
