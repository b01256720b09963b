"""References at addresses."""

import functools
import io
import threading
import zipfile
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest

import shapewright as sw
from shapewright.modelling.solids import box
from shapewright.references.errors import CollectionError
from shapewright.references.origins import fetching
from shapewright.shapes import files

fsspec = pytest.importorskip("fsspec", reason="comes with torch")


@pytest.fixture
def memory():
    system = fsspec.filesystem("memory")
    system.store.clear()
    yield system
    system.store.clear()


@pytest.fixture(autouse=True)
def cache(tmp_path, monkeypatch):
    folder = tmp_path / "cache"
    folder.mkdir()

    def cache_of(name):
        (folder / name).mkdir(exist_ok=True)
        return folder / name

    monkeypatch.setattr("shapewright.references.origins.fetching.cache_of", cache_of)
    monkeypatch.setattr("shapewright.references.archives.cache_of", cache_of)
    return folder


@pytest.fixture
def obj():
    return files.obj(box((1, 2, 3)).mesh())


def zipped(**files):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name, content in files.items():
            archive.writestr(name.replace("__", "/") + ".obj", content)
    return data.getvalue()


def test_all_shapes_below_an_address_are_read(memory, obj):
    for path in ("/refs/a.obj", "/refs/deep/b.obj", "/refs/.hidden/c.obj", "/refs/notes.txt", "/other/d.obj"):
        memory.pipe(path, obj)
    references = sw.Collection.load("memory://refs")
    assert references.names == ("a", "b") and references.origins == ("memory://refs",)
    assert sw.Collection.load(["memory://refs/deep/b.obj", "memory://other/*.obj"]).names == ("b", "d")


def test_what_has_not_changed_is_fetched_once(memory, obj, monkeypatch):
    memory.pipe("/refs/a.obj", obj)
    opened = []
    whole = fetching.whole_file
    monkeypatch.setattr(fetching, "whole_file", lambda path: opened.append(path) or whole(path))
    for _ in range(2):
        assert sw.Collection.load("memory://refs").names == ("a",)
    assert len(opened) == 1
    memory.pipe("/refs/b.obj", obj)
    assert sw.Collection.load("memory://refs").names == ("a", "b") and len(opened) == 2
    memory.rm("/refs/a.obj")
    assert sw.Collection.load("memory://refs").names == ("b",)


def test_archives_are_read_as_on_disk(memory, obj):
    memory.pipe("/all.zip", zipped(chairs__a=obj, tables__b=obj))
    assert sw.Collection.load("memory://all.zip").names == ("a", "b")
    assert sw.Collection.load("zip://chairs/*.obj::memory://all.zip").names == ("a",)
    memory.pipe("/bad.zip", zipped(**{"..__..__evil": obj}))
    with pytest.raises(CollectionError, match="a path that leads out of it"):
        sw.Collection.load("zip://::memory://bad.zip")


def test_a_server_of_files(obj, tmp_path):
    pytest.importorskip("aiohttp", reason="needs the extra remote; run `make test-adapters`")
    folder = tmp_path / "served"
    folder.mkdir()
    (folder / "box.obj").write_bytes(obj)
    (folder / "all.zip").write_bytes(zipped(a=obj))
    handler = functools.partial(SimpleHTTPRequestHandler, directory=str(folder))
    handler.log_message = None
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        base = f"http://127.0.0.1:{server.server_port}"
        assert sw.Collection.load(f"{base}/box.obj").names == ("box",)
        assert sw.Collection.load([f"{base}/all.zip", f"{base}/box.obj?version=2"]).names == ("a", "box")
        assert sw.Collection.load(f"{base}/").names == ("a", "box")
        with pytest.raises(CollectionError, match="there is nothing at this address"):
            sw.Collection.load(f"{base}/none.obj")
        server.shutdown()


@pytest.mark.parametrize(
    ("address", "why"),
    [
        ("ssh://host/a.obj", "references are read from paths and from s3://, gs://"),
        ("file:///etc/passwd", "references are read from paths and from"),
        ("memory://none/a.obj", "there is nothing at this address"),
        ("memory://texts", "there are no shapes at this address"),
        ("zip://a.obj::memory://texts/a.txt", "is no archive of a kind that is read"),
        ("zip://../a.obj::memory://all.zip", "the path leads out of the archive"),
        ("simplecache::memory://all.zip", "before :: there may be zip"),
        ("zip://a::tar://b::memory://all.zip", "before :: there may be zip"),
    ],
)
def test_what_cannot_be_fetched_is_told(memory, obj, address, why):
    memory.pipe("/texts/a.txt", b"words")
    memory.pipe("/all.zip", zipped(a=obj))
    with pytest.raises(CollectionError, match=why):
        sw.Collection.load(address)


def test_a_file_beyond_all_measure_is_refused(memory, obj, monkeypatch):
    memory.pipe("/refs/a.obj", obj)
    monkeypatch.setattr(fetching, "MOST", len(obj) - 1)
    with pytest.raises(CollectionError, match="a file of more than"):
        sw.Collection.load("memory://refs")


def test_a_name_that_leads_out_is_refused(memory, obj, monkeypatch):
    memory.pipe("/refs/a.obj", obj)
    names = {"/refs/../b.obj": {"type": "file"}}
    monkeypatch.setattr(type(memory), "find", lambda *_, **__: names)
    with pytest.raises(CollectionError, match="it names a file that is not below it"):
        sw.Collection.load("memory://refs")
