import os
import tracemalloc
from pathlib import Path

import numpy as np
import pytest

import broken_reader
from shapewright.modelling.solids import box
from shapewright.references import Collection, CollectionError, reading
from shapewright.references.errors import UnreadableError
from shapewright.references.reading import Readers
from shapewright.references.sources import find
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode


@pytest.fixture
def breakable(monkeypatch):
    """Readers that go wrong where a file's name says so, with small limits."""
    helpers = str(Path(broken_reader.__file__).parent)
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join([helpers, os.environ.get("PYTHONPATH", "")]))
    monkeypatch.setattr(reading, "attempt", broken_reader.attempt)
    monkeypatch.setattr(reading, "_SECONDS", 4.0)
    monkeypatch.setattr(reading, "_MEMORY", 512)


def write(folder, *names):
    folder.mkdir(exist_ok=True)
    for i, name in enumerate(names):
        mesh = box((1, 1 + i, 2)).mesh()
        (folder / name).write_bytes(encode(mesh, name.partition(".")[2]))
    return folder


def test_a_file_that_ends_hangs_or_fills_its_process_is_lost_alone_and_told(tmp_path, breakable):
    refs = Collection.load(write(tmp_path / "refs", "a.glb", "dies.glb", "b.obj", "eats.glb", "hangs.glb", "z.glb"))
    assert refs.names == ("a", "b", "z")
    assert {path.stem: reason for path, reason in refs.skipped.items()} == {
        "dies": "reading it killed its process (signal 11); export it again, or in another format",
        "eats": "reading it needs more than 0.5 GB of memory",
        "hangs": "reading it took more than 4 s",
    }


def test_a_single_file_that_ends_its_process_is_refused_with_the_reason(tmp_path, breakable):
    write(tmp_path, "dies.glb")
    with pytest.raises(CollectionError, match=r"dies\.glb: reading it killed its process \(signal 11\)"):
        Collection.load(tmp_path / "dies.glb")


def test_references_do_not_depend_on_how_many_processes_read_them(tmp_path, monkeypatch):
    sources = find([write(tmp_path, "a.glb", "b.stl", "c.glb", "d.ply", "e.glb")])
    monkeypatch.setattr(reading, "_FILES", 1)
    read = []
    for count in (1, 3):
        with Readers(count) as readers:
            read.append(readers.read(sources))
    here = [reading.attempt(source) for source in sources]
    assert [r.digest for r in read[0]] == [r.digest for r in read[1]] == [r.digest for r in here]
    assert [r.name for r in read[0]] == list("abcde")


def test_small_files_of_plain_formats_are_read_here_and_no_others(tmp_path, breakable, monkeypatch):
    formats = ("where.obj", "where.stl", "where.glb")
    where = {}
    for number, name in enumerate(formats):
        write(tmp_path / str(number), name)
        with Readers(1) as readers:
            (found,) = readers.read(find([tmp_path / str(number)]))
        where[name] = found.notes[0] == str(os.getpid())
    assert where == {"where.obj": True, "where.stl": True, "where.glb": False}
    monkeypatch.setattr(reading, "_SMALL", 100)
    with Readers(1) as readers:
        (found,) = readers.read(find([tmp_path / "0"]))
    assert found.notes[0] != str(os.getpid())


def test_what_is_not_there_has_its_reason_without_a_process(tmp_path):
    sources = find([tmp_path / "gone.glb", write(tmp_path / "refs", "a.obj")])
    with Readers(1) as readers:
        (kept, gone) = readers.read(sources)
        assert readers._calls._pool.idle == []
    assert isinstance(kept.shape, Mesh)
    assert isinstance(gone, UnreadableError) and "no such file" in str(gone)


def test_a_large_file_may_take_longer_than_a_small_one_and_none_more_than_a_minute():
    assert [reading._limits(size).seconds for size in (1000, 4 * 2**20, 2**30)] == [20.0, 40.0, 60.0]


def test_a_large_file_may_take_more_memory_than_a_small_one(tmp_path, monkeypatch):
    monkeypatch.setattr(reading, "_MEMORY", 64)
    corners = np.random.default_rng(0).random((600_000, 3))
    mesh = Mesh(corners, np.arange(len(corners)).reshape(-1, 3))
    (tmp_path / "large.ply").write_bytes(encode(mesh, "ply"))
    (found,) = Collection.load(tmp_path / "large.ply")
    assert len(found.shape.faces) == 200_000


def test_what_fails_behind_the_reader_has_a_reason_too(tmp_path, monkeypatch):
    def fail(*_):
        raise IndexError("behind")

    monkeypatch.setattr(reading, "read_reference", fail)
    with pytest.raises(CollectionError, match="broken: IndexError: behind"):
        Collection.load(write(tmp_path / "refs", "a.obj"))


MANY = "1000000000"
PLY = "ply\nformat {} 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
LIST = "property list uint uint vertex_indices\nend_header\n"


@pytest.mark.parametrize(
    ("name", "content", "why"),
    [
        ("a.ply", PLY.format("ascii", MANY) + "end_header\n0 0 0\n", "cut short"),
        ("a.ply", PLY.format("binary_little_endian", MANY) + "end_header\n" + "\0" * 12, "cut short"),
        ("a.ply", PLY.format("ascii", 1) + f"element face {MANY}\n{LIST}0 0 0\n3 0 0 0\n", "cut short"),
        (
            "a.ply",
            PLY.format("binary_little_endian", 1) + f"element face 1\n{LIST}" + "\0" * 12 + "\x7f" * 4,
            "cut short",
        ),
        ("a.ply", f"ply\nformat ascii 1.0\nelement vertex {MANY}\nend_header\n", "no property 'x'"),
        ("a.off", f"OFF\n{MANY} {MANY} 0\n0 0 0\n", "cut short"),
        ("a.stl", "binary".ljust(80) + "\x7f" * 4 + "\0" * 50, "cut short"),
        ("a.obj", f"v 0 0 0\nf 1 1 {MANY}\n", "outside its 1 vertices"),
        ("a.pts", f"{MANY}\n0 0 0\n", "cut short"),
        ("a.obj", "v 0 0 0\nv nan 0 0\nv 0 inf 0\nf 1 2 3\n", "finite"),
    ],
)
def test_what_a_small_file_announces_takes_no_memory(tmp_path, name, content, why):
    (tmp_path / name).write_bytes(content.encode("latin-1"))
    (source,) = find([tmp_path / name])
    tracemalloc.start()
    try:
        found = reading.attempt(source)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert isinstance(found, UnreadableError) and why in str(found)
    assert peak < 2**24
