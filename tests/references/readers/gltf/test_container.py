import json
import struct

import pytest

from gltf_files import CUBE_FACES, Gltf, glb, written
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.container import unpack


@pytest.fixture
def cube():
    gltf = Gltf()
    return gltf.shown(gltf.cube())


def reason(data: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        unpack(data)
    return str(error.value)


def test_the_content_says_what_a_file_is_and_not_its_name(tmp_path, cube):
    (tmp_path / "binary.gltf").write_bytes(cube.glb())
    (tmp_path / "text.glb").write_bytes(cube.text())
    for name in ("binary.gltf", "text.glb"):
        mesh, notes = read(tmp_path / name)
        assert len(mesh.faces) == len(CUBE_FACES)
        assert notes == ()


def test_a_byte_order_mark_and_space_before_the_text_are_no_part_of_it(tmp_path, cube):
    (tmp_path / "a.gltf").write_bytes(b"\xef\xbb\xbf\r\n" + cube.text())
    assert len(read(tmp_path / "a.gltf")[0].faces) == len(CUBE_FACES)


@pytest.mark.parametrize("encoding", ["latin-1", "utf-8", "utf-16"])
def test_names_in_another_encoding_do_not_lose_the_file(tmp_path, cube, encoding):
    cube.document["nodes"][0]["name"] = "NAME"
    (tmp_path / "st\xfchl.bin").write_bytes(cube.binary)
    text = cube.text(uri="URI").decode().replace("NAME", "Stühlchen").replace("URI", "stühl.bin")
    (tmp_path / "a.gltf").write_bytes(text.encode(encoding))
    assert len(read(tmp_path / "a.gltf")[0].faces) == len(CUBE_FACES)


def test_chunks_of_other_kinds_are_passed_over_and_null_bytes_may_pad_the_text():
    text = b'{"asset": {"version": "2.0"}}\0\0\0'
    chunks = b"".join(
        struct.pack("<II", len(data), kind) + data
        for data, kind in ((text, 0x4E4F534A), (b"note", 0x12345678), (b"data", 0x004E4942), (b"more", 0x004E4942))
    )
    found = unpack(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    assert json.loads(found.text) == {"asset": {"version": "2.0"}}
    assert bytes(found.binary) == b"data"
    assert found.notes == ()


def test_bytes_behind_the_end_are_noted_and_padding_is_not(tmp_path, cube):
    path = written(tmp_path, cube)
    data = path.read_bytes()
    path.write_bytes(data + b"trailing")
    assert read(path)[1] == ("8 bytes behind the end of the GLB left out",)
    path.write_bytes(data + b"\0\0\0\n")
    assert read(path)[1] == ()


@pytest.mark.parametrize(
    ("data", "why"),
    [
        (b"<!DOCTYPE html>", "neither the JSON text of a glTF file nor a binary one"),
        (b"glTF\2\0", "cut short in the header"),
        (glb(b"{}", version=1), "GLB of version 1, which is not read; save it as glTF 2.0"),
        (glb(b"{}")[:-2], "cut short, 22 of 24 bytes"),
        (struct.pack("<4sIIII", b"glTF", 2, 20, 0xFFFFFFF0, 0x4E4F534A), "a chunk of the GLB ends at byte"),
        (struct.pack("<4sIIII", b"glTF", 2, 20, 0, 0x004E4942), "does not begin with its JSON"),
        (struct.pack("<4sII", b"glTF", 2, 12), "does not begin with its JSON"),
    ],
)
def test_what_is_framed_in_another_way_is_refused(data, why):
    assert why in reason(data)


def test_every_cut_of_a_file_is_a_reason(tmp_path, cube):
    data = cube.glb()
    for length in range(1, len(data), 37):
        with pytest.raises(UnreadableError):
            path = tmp_path / "a.glb"
            path.write_bytes(data[:length])
            read(path)
