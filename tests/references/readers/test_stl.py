import struct

import numpy as np
import pytest

import boxes
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.stl import read_stl

CORNERS = np.array(boxes.CORNERS, "<f4")[np.array(boxes.TRIANGLES)]


def binary(name: bytes = b"box", declared: int = 12, colour: int = 0) -> bytes:
    facets = b"".join(struct.pack("<3f9fH", 0, 0, 0, *corners.reshape(-1), colour) for corners in CORNERS)
    return name.ljust(80, b" ") + struct.pack("<I", declared) + facets


def shape(tmp_path, content: str | bytes):
    path = tmp_path / "a.stl"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read(path)


@pytest.mark.parametrize(
    "content",
    [
        boxes.stl(),
        boxes.stl().replace("\n", "\r"),
        boxes.stl().replace("\n", " "),
        boxes.stl().upper(),
        boxes.stl("vertex 1 2 3 of facet"),
        boxes.stl("Möbel").encode("latin-1"),
        boxes.stl("椅子"),
        boxes.stl(""),
        boxes.stl().replace(" normal 0 0 0", ""),
        boxes.stl().replace(" 0 0 0\n outer", "\n outer"),
        boxes.stl().replace("normal 0 0 0", "normal -1.#IND nan 0"),
        boxes.stl().replace("endfacet\n", "endfacet\nendsolid box\nsolid lid\n", 5),
        boxes.stl().replace("endfacet\n", "endfacet endsolid box solid lid ", 5),
        binary(),
        binary(b"solid box"),
        binary(b"solid\nfacet normal"),
        binary(b"COLOR=\xff\0\0\xff", colour=0x8FFF),
        binary() + b"\0\0\n",
    ],
    ids=[
        "text", "old Mac", "one line", "capitals", "keywords in the name", "Latin-1", "UTF-8", "no name", "no normals",
        "empty normals", "odd normals", "several solids", "several solids in one line", "binary", "binary solid",
        "binary facet", "colours", "padding",
    ],
)  # fmt: skip
def test_every_form_of_the_box(tmp_path, content):
    mesh, notes = shape(tmp_path, content)
    assert boxes.is_box(mesh) and notes == ()


def test_binary_solids_one_behind_the_other_are_all_read(tmp_path):
    assert len(shape(tmp_path, binary() + binary(b"lid"))[0].faces) == 24


def test_a_facet_of_four_corners_is_two_triangles(tmp_path):
    loop = "".join(f"vertex {x} {y} {{z}}\n" for x, y in ((0, 0), (2, 0), (2, 1), (0, 1)))
    plates = "".join(f"facet normal 0 0 0\nouter loop\n{loop.format(z=z)}endloop\nendfacet\n" for z in range(3))
    mesh, _ = shape(tmp_path, f"solid plates\n{plates}endsolid\n")
    assert len(mesh.faces) == 6 and np.ptp(mesh.triangles[:, :, 2], axis=1).max() == 0


def test_a_solid_without_an_end_is_read_with_a_note(tmp_path):
    mesh, notes = shape(tmp_path, boxes.stl().replace("endsolid box\n", ""))
    assert boxes.is_box(mesh) and "endsolid" in notes[0]


def test_a_binary_file_that_declares_no_triangles_is_read_by_its_size_with_a_note(tmp_path):
    mesh, notes = shape(tmp_path, binary(declared=0))
    assert boxes.is_box(mesh) and "its size says 12" in notes[0]


def test_bytes_behind_the_last_triangle_are_left_out_with_a_note(tmp_path):
    mesh, notes = shape(tmp_path, binary(declared=11))
    assert len(mesh.faces) == 11 and notes == ("50 bytes behind its last triangle left out",)


TWO = boxes.stl() + boxes.stl("lid")


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (TWO[: len(boxes.stl()) + 150], "cut short: it ends in facet 14"),
        (boxes.stl()[:-40], "cut short: it ends in facet 12"),
        (binary()[:-1], "cut short: it declares 12 triangles and has bytes for 11"),
        (binary(declared=2**32 - 1), "cut short: it declares 4294967295 triangles"),
        (boxes.stl().replace("vertex 0 0 3", "vertex 0 3", 1), "broken: facet 1 cannot be understood: 'facet normal"),
        (boxes.stl().replace("vertex 0 0 3", "vertex 0 0 x3", 1), "'x3' is no number"),
        (boxes.stl().replace("  vertex 0 0 3\n", "", 1), "fewer than three corners"),
        (boxes.stl() + "<html>", "broken: facet 13 cannot be understood: '<html>'|cut short"),
        ("<html></html>", "neither text that begins with 'solid' nor binary: it has 13 bytes"),
        ("solid nothing\nendsolid nothing\n", "it holds no triangles"),
    ],
)  # fmt: skip
def test_what_is_cut_or_cannot_be_understood_has_a_reason(tmp_path, content, why):
    with pytest.raises(UnreadableError, match=why):
        shape(tmp_path, content)


def test_long_files_are_read_in_pieces():
    facets = boxes.stl().removeprefix("solid box\n").removesuffix("endsolid box\n")
    text = ("solid\n" + facets * 5000).encode()
    assert len(read_stl(text).counts) == 60_000
