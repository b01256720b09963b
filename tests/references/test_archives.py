import io
import os
import struct
import tarfile
import zipfile
from pathlib import Path

import pytest

import boxes
from shapewright.processes import Limits
from shapewright.references import Collection, CollectionError, archives
from shapewright.references.archives import cache_of, is_archive, stem, unpacked
from shapewright.references.errors import UnreadableError
from shapewright.references.sources import find


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("SHAPEWRIGHT_CACHE", str(tmp_path / "cache"))
    cache_of.cache_clear()
    yield tmp_path / "cache"
    cache_of.cache_clear()


BOX = boxes.obj().encode()
FILES = {
    "chairs/a.obj": BOX,
    "chairs/b.off": boxes.off().encode(),
    "chairs/a.mtl": b"",
    "c.blend": b"BLENDER",
    "wood.png": b"",
}


def packed(path: Path, files: dict[str, bytes] = FILES) -> Path:
    if path.suffix == ".zip":
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                archive.writestr(name, content)
        return path
    mode = {".tar": "w", ".gz": "w:gz", ".tgz": "w:gz", ".bz2": "w:bz2", ".xz": "w:xz"}[path.suffix]
    with tarfile.open(path, mode) as archive:
        for name, content in files.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    return path


@pytest.mark.parametrize("name", ["refs.zip", "refs.tar", "refs.tar.gz", "refs.tgz", "refs.tar.bz2", "refs.tar.xz"])
def test_an_archive_is_read_as_a_folder(tmp_path, name):
    archive = packed(tmp_path / name)
    references = Collection.load(archive)
    assert references.names == ("a", "b") and all(len(one.shape.faces) == 12 for one in references)
    assert references["a"].path == archive / "chairs" / "a.obj"
    assert references.skipped == {
        archive / "c.blend": "a Blender file, which is not read: open it in Blender and export it as GLB or OBJ"
    }
    assert is_archive(archive) and stem(archive) == "refs"


def test_an_archive_in_a_folder_of_shapes_and_names_that_clash(tmp_path):
    (tmp_path / "refs").mkdir()
    (tmp_path / "refs" / "a.obj").write_bytes(BOX)
    packed(tmp_path / "refs" / "more.zip")
    assert Collection.load(tmp_path / "refs").names == ("a", "b", "more.zip/chairs/a")


def test_an_archive_beside_its_own_folder_is_left_out(tmp_path):
    (tmp_path / "refs" / "more").mkdir(parents=True)
    (tmp_path / "refs" / "more" / "a.obj").write_bytes(BOX)
    packed(tmp_path / "refs" / "more.zip")
    references = Collection.load(tmp_path / "refs")
    assert references.names == ("a",) and "which is read in its place" in references.skipped[tmp_path / "refs/more.zip"]


def test_it_is_unpacked_once_and_again_when_it_has_changed(tmp_path, cache):
    archive = packed(tmp_path / "refs.zip")
    first = unpacked(archive)
    (first / "chairs" / "a.obj").unlink()
    assert unpacked(archive) == first and not (first / "chairs" / "a.obj").exists()
    packed(archive, {"z.obj": BOX})
    os.utime(archive, ns=(1, 1))
    assert [one.name for one in find([archive])] == ["z"]
    assert len(list((cache / "archives").iterdir())) == 1


def test_an_archive_inside_is_refused_by_its_name(tmp_path):
    archive = packed(tmp_path / "refs.zip", {"a.obj": BOX, "more.zip": b"PK"})
    assert Collection.load(archive).skipped == {archive / "more.zip": "an archive, which is not read: unpack it"}


@pytest.mark.parametrize("name", ["../a.obj", "/tmp/a.obj", "x/../../a.obj", "..\\a.obj", "C:\\a.obj"])
@pytest.mark.parametrize("kind", ["refs.zip", "refs.tar"])
def test_a_path_that_leads_out_of_it_is_refused(tmp_path, kind, name):
    with pytest.raises(UnreadableError, match="a path that leads out of it"):
        unpacked(packed(tmp_path / kind, {"b.obj": BOX, name: BOX}))
    assert not (tmp_path / "a.obj").exists()


def test_links_in_it_are_passed_over(tmp_path):
    with tarfile.open(tmp_path / "refs.tar", "w") as archive:
        link = tarfile.TarInfo("a.obj")
        link.type, link.linkname = tarfile.SYMTYPE, "/etc/passwd"
        archive.addfile(link)
    with pytest.raises(CollectionError, match="holds no shapes"):
        Collection.load(tmp_path / "refs.tar")


@pytest.mark.parametrize("kind", ["refs.zip", "refs.tar.gz"])
def test_one_that_grows_beyond_measure_is_refused(tmp_path, kind):
    with pytest.raises(UnreadableError, match="unpacks to more than 64 MiB"):
        unpacked(packed(tmp_path / kind, {"a.obj": bytes(65 * 2**20)}))


def test_one_that_lies_about_its_sizes_writes_no_more_than_it_says(tmp_path):
    path = packed(tmp_path / "refs.zip", {"a.obj": BOX * 100})
    data = path.read_bytes().replace(struct.pack("<I", len(BOX) * 100), struct.pack("<I", 10))
    path.write_bytes(data)
    with pytest.raises(UnreadableError, match="archive"):
        unpacked(path)


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"PK\5\6" + bytes(18), "an archive that holds no shapes"),
        (b"", "a broken archive"),
        (b"<html>", "a broken archive"),
    ],
)
def test_an_empty_and_a_broken_one_have_their_reason(tmp_path, content, why):
    (tmp_path / "refs.zip").write_bytes(content)
    with pytest.raises(CollectionError, match=why):
        Collection.load(tmp_path / "refs.zip")
    (tmp_path / "a.obj").write_bytes(BOX)
    assert why in Collection.load(tmp_path).skipped[tmp_path / "refs.zip"]


@pytest.mark.parametrize("share", [0.3, 0.6, 0.9])
@pytest.mark.parametrize("kind", ["refs.zip", "refs.tar.gz", "refs.tar.xz"])
def test_one_that_is_cut_is_broken(tmp_path, kind, share):
    path = packed(tmp_path / kind, {f"{i}.obj": BOX + os.urandom(200) for i in range(9)})
    path.write_bytes(path.read_bytes()[: int(share * path.stat().st_size)])
    with pytest.raises(UnreadableError, match="archive"):
        unpacked(path)


def test_one_with_a_password_says_so(tmp_path):
    path = packed(tmp_path / "refs.zip")
    data = bytearray(path.read_bytes())
    at = data.index(b"PK\1\2")
    data[at + 8] |= 1
    path.write_bytes(bytes(data))
    with pytest.raises(UnreadableError, match="with a password"):
        unpacked(path)


def test_a_tar_whose_header_asks_for_all_memory_is_refused_and_nothing_else_is_lost(tmp_path, monkeypatch):
    """A header of the tar format may be of any length, and is read whole."""
    monkeypatch.setattr(archives, "_LIMITS", Limits(seconds=30.0, memory_mb=64))
    header = tarfile.TarInfo("pax")
    header.type, header.size = tarfile.XHDTYPE, 512 * 2**20
    with tarfile.open(tmp_path / "bomb.tar.gz", "w:gz", compresslevel=1) as archive:
        archive.fileobj.write(header.tobuf(tarfile.USTAR_FORMAT))
        for _ in range(512):
            archive.fileobj.write(bytes(2**20))
    (tmp_path / "a.obj").write_bytes(BOX)
    refs = Collection.load(tmp_path)
    assert refs.names == ("a",)
    assert list(refs.skipped.values()) == ["unpacking it needed more than 64 MB of memory"]
