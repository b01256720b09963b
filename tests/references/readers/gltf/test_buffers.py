import json
import os
import unicodedata

import pytest

from gltf_files import CUBE_FACES, Gltf
from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from shapewright.references.readers.gltf.buffers import views
from shapewright.references.readers.gltf.document import parse


@pytest.fixture
def cube():
    gltf = Gltf()
    return gltf.shown(gltf.cube())


def faces(folder, gltf: Gltf, uri: str, name: str | None = None) -> int:
    if name is not None:
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(gltf.binary)
    (folder / "a.gltf").write_bytes(gltf.text(uri=uri))
    return len(read(folder / "a.gltf")[0].faces)


def reason(folder, gltf: Gltf, uri: str) -> str:
    with pytest.raises(UnreadableError) as error:
        faces(folder, gltf, uri)
    return str(error.value)


@pytest.mark.parametrize(
    ("uri", "name"),
    [
        ("oak%20desk%20(%C3%BC).bin", "oak desk (ü).bin"),
        ("oak desk (ü).bin", "oak desk (ü).bin"),
        ("100%25%20oak.bin", "100% oak.bin"),
        ("100% oak.bin", "100% oak.bin"),
        ("a%20b.bin", "a%20b.bin"),
        ("./parts/desk.bin", "parts/desk.bin"),
        ("parts\\desk.bin", "parts/desk.bin"),
        ("Desk.BIN", "desk.bin"),
        ("desk.bin?version=3", "desk.bin"),
        ("%C3%BC.bin", unicodedata.normalize("NFD", "ü.bin")),
        ("u%CC%88.bin", unicodedata.normalize("NFC", "ü.bin")),
    ],
)
def test_the_file_beside_it_is_found_by_its_uri(tmp_path, cube, uri, name):
    assert faces(tmp_path, cube, uri, name) == len(CUBE_FACES)


@pytest.mark.parametrize(
    "uri",
    [
        "../secret.bin",
        "parts/../../secret.bin",
        "%2e%2e/secret.bin",
        "..%2Fsecret.bin",
        "..\\secret.bin",
        "/etc/passwd",
        "%2Fetc/passwd",
        "\\\\server\\share.bin",
        "C:\\secret.bin",
        "C%3A/secret.bin",
        "file:///etc/passwd",
        "https://example.org/a.bin",
        "..",
    ],
)
def test_a_uri_that_leads_out_of_the_folder_is_refused(tmp_path, cube, uri):
    folder = tmp_path / "inside"
    folder.mkdir()
    (tmp_path / "secret.bin").write_bytes(cube.binary)
    assert "which lies outside its folder" in reason(folder, cube, uri)


def test_a_file_that_is_missing_is_named(tmp_path, cube):
    assert reason(tmp_path, cube, "oak%20desk.bin") == "it needs oak desk.bin, which is missing"
    for length in (300, 5000):
        assert "which is missing" in reason(tmp_path, cube, "a" * length)
    assert "which is missing" in reason(tmp_path, cube, "none/a.bin")
    assert "which is missing" in reason(tmp_path, cube, "a%00.bin")
    assert "which is missing" in reason(tmp_path, cube, "")


def test_only_files_are_read(tmp_path, cube):
    os.mkfifo(tmp_path / "pipe.bin")
    assert reason(tmp_path, cube, "pipe.bin") == "it needs pipe.bin, which is missing"


def test_a_length_beyond_the_file_is_refused(tmp_path, cube):
    (tmp_path / "a.bin").write_bytes(cube.binary)
    (tmp_path / "a.gltf").write_bytes(cube.text(uri="a.bin", byteLength=2**40))
    with pytest.raises(UnreadableError, match=f"cut short, buffer 0 has {len(cube.binary)} of {2**40} bytes"):
        read(tmp_path / "a.gltf")


@pytest.mark.parametrize(
    ("uri", "data"),
    [
        ("data:application/octet-stream;base64,AAECAw==", b"\0\1\2\3"),
        ("data:;base64,AAECAw", b"\0\1\2\3"),
        ("DATA:application/gltf-buffer;charset=x;BASE64,AAEC%0A Aw%3D%3D", b"\0\1\2\3"),
        ("data:;base64,-_8A", b"\xfb\xff\0"),
        ("data:,a%20%00b", b"a \0b"),
    ],
)
def test_data_uris(tmp_path, uri, data):
    text = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data), "uri": uri}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}]}  # fmt: skip
    assert bytes(views(parse(json.dumps(text).encode())[0], tmp_path, None)(0)) == data


@pytest.mark.parametrize(("uri", "why"), [("data:;base64,A*=", "not base64"), ("data:;base64", "without data")])
def test_data_uris_that_are_broken_are_refused(tmp_path, cube, uri, why):
    assert why in reason(tmp_path, cube, uri)


@pytest.mark.parametrize(
    ("view", "why"),
    [
        ({"buffer": 0, "byteOffset": 2, "byteLength": 3}, "buffer view 0 ends at byte 5 of a buffer of 4"),
        ({"buffer": 1, "byteLength": 1}, "refers to buffer 1, but has 1"),
    ],
)
def test_views_beyond_a_buffer_are_refused(tmp_path, view, why):
    text = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4}], "bufferViews": [view]}
    with pytest.raises(UnreadableError, match=why):
        views(parse(json.dumps(text).encode())[0], tmp_path, memoryview(b"1234"))(0)


def test_a_view_without_data_names_what_compresses_it(tmp_path, cube):
    cube.document["bufferViews"][0]["extensions"] = {"EXT_squeezed": {}}
    cube.document["bufferViews"][0]["buffer"] = 1
    cube.document["buffers"] = [{"byteLength": 1000}]
    (tmp_path / "a.glb").write_bytes(cube.glb())
    with pytest.raises(UnreadableError, match="buffer 1 has no data: compressed by EXT_squeezed"):
        read(tmp_path / "a.glb")


def test_a_buffer_without_data_is_refused(tmp_path, cube):
    text = json.loads(cube.text())
    del text["buffers"][0]["uri"]
    (tmp_path / "a.gltf").write_text(json.dumps(text))
    with pytest.raises(UnreadableError, match="buffer 0 has no data"):
        read(tmp_path / "a.gltf")
