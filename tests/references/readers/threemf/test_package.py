import io
import struct
import zipfile

import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read
from threemf_files import archive, mesh, model, object_, relations, single, written

CUBE = model(object_(1, mesh()), 'objectid="1"')


def reason(tmp_path, data: bytes) -> str:
    with pytest.raises(UnreadableError) as error:
        read(written(tmp_path, data))
    return str(error.value)


@pytest.mark.parametrize(
    ("target", "name"),
    [
        ("/3D/part.model", "3D/part.model"),
        ("3D/part.model", "3D/part.model"),
        ("/3d/PART.model", "3D/part.model"),
        ("/my%20model/part.xml", "my model/part.xml"),
        ("/my%20model/part.xml", "my%20model/part.xml"),
        ("/3D/part.model", "/3D/part.model"),
        ("/3D/part.model", "3D\\part.model"),
    ],
)
def test_the_relationships_say_which_part_is_the_model(tmp_path, target, name):
    data = archive({"_rels/.rels": relations(target), name: CUBE})
    assert len(read(written(tmp_path, data))[0].faces) == 12


ELSEWHERE = relations("http://example.org/a.model", more='TargetMode="External"')


@pytest.mark.parametrize("rels", [{}, {"_rels/.rels": relations()}, {"_rels/.rels": ELSEWHERE}])
@pytest.mark.parametrize("name", ["3D/3dmodel.model", "3D/3DModel.model", "part.model"])
def test_without_relationships_the_only_model_is_it(tmp_path, rels, name):
    data = archive({**rels, name: CUBE, "thumbnail.png": b"x"})
    assert len(read(written(tmp_path, data))[0].faces) == 12


def test_the_usual_name_comes_first_among_models_without_relationships(tmp_path):
    data = archive({"3D/Objects/a.model": "<x/>", "3D/3dmodel.model": CUBE})
    assert len(read(written(tmp_path, data))[0].faces) == 12


def test_more_models_are_noted(tmp_path):
    data = archive({"_rels/.rels": relations("/3D/a.model", "/3D/b.model"), "3D/a.model": CUBE, "3D/b.model": CUBE})
    mesh, notes = read(written(tmp_path, data))
    assert len(mesh.faces) == 12
    assert notes == ("1 x model beside the first left out",)


def test_a_model_that_is_missing_is_named(tmp_path):
    data = archive({"_rels/.rels": relations("/3D/a.model"), "3D/b.model": CUBE})
    assert "needs its part /3d/a.model, which is missing" in reason(tmp_path, data)


def test_another_kind_of_archive_is_refused(tmp_path):
    assert "without a 3D model in it, so no 3MF" in reason(tmp_path, archive({"word/document.xml": "<x/>"}))
    assert "no ZIP archive, or cut short" in reason(tmp_path, b"solid cube")
    assert "no ZIP archive, or cut short" in reason(tmp_path, single(CUBE)[:-30])


def test_a_part_that_is_damaged_is_refused(tmp_path):
    data = bytearray(single(CUBE))
    at = data.index(b"3D/3dmodel.model") + 40
    data[at : at + 8] = bytes(8)
    assert "part /3d/3dmodel.model cannot be unpacked" in reason(tmp_path, bytes(data))


def test_an_encrypted_archive_is_refused(tmp_path):
    data = bytearray(single(CUBE))
    for at in (i for i in range(len(data)) if data[i : i + 4] == b"PK\1\2"):
        data[at + 8] |= 1
    assert "cannot be unpacked" in reason(tmp_path, bytes(data))


def test_an_archive_that_unpacks_to_a_thousand_times_its_size_is_refused(tmp_path):
    assert "a ZIP bomb" in reason(tmp_path, single(b" " * 100_000_000))


def test_sizes_that_are_announced_too_large_are_refused(tmp_path):
    data = bytearray(single(CUBE))
    for at in (i for i in range(len(data)) if data[i : i + 4] == b"PK\1\2"):
        struct.pack_into("<I", data, at + 24, 0xFFFFFF00)
    assert "a ZIP bomb" in reason(tmp_path, bytes(data))


def test_entries_that_share_their_bytes_count_each(tmp_path):
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as file:
        file.writestr("3D/3dmodel.model", b" " * 10_000_000)
        first = file.infolist()[0]
        for i in range(20):
            copy = zipfile.ZipInfo(f"3D/{i}.model")
            for field in ("header_offset", "file_size", "compress_size", "CRC", "compress_type"):
                setattr(copy, field, getattr(first, field))
            file.filelist.append(copy)
            file.NameToInfo[copy.filename] = copy
    assert "a ZIP bomb" in reason(tmp_path, stream.getvalue())
