import os
import time
from pathlib import Path

import pytest

from broken_disk import full_after, hidden, killed, shown
from shapewright.storage import (
    cache_folder,
    cell,
    file_names,
    printable,
    remove_leftovers,
    whole_file,
    whole_folder,
    write_file,
)

OLD, NEW = b"old" * 100, b"new" * 100


def by_a_path(path, data):
    with whole_file(path) as partial, partial.open("wb") as file:
        file.write(data)


def as_a_folder(path, data):
    with whole_folder(path) as partial:
        (partial / "first").write_bytes(b"1")
        (partial / "second").write_bytes(data)


WRITERS = pytest.mark.parametrize("write", [write_file, by_a_path, as_a_folder])


@WRITERS
def test_what_is_written_is_there_and_nothing_beside_it(tmp_path, write):
    write(tmp_path / "it", NEW)
    assert NEW in shown(tmp_path).values() and not hidden(tmp_path)


@WRITERS
def test_a_full_disk_leaves_nothing(tmp_path, write):
    with pytest.raises(OSError, match="File too large"), full_after(200):
        write(tmp_path / "it", NEW)
    assert not list(tmp_path.iterdir())


@WRITERS
def test_a_stop_leaves_nothing(tmp_path, write, monkeypatch):
    def stop(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("pathlib.Path.replace", stop)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "it", NEW)
    assert not list(tmp_path.iterdir())


@WRITERS
def test_a_kill_leaves_nothing_to_see_and_the_next_writer_cleans_up(tmp_path, write):
    killed(lambda: write(tmp_path / "it", NEW))
    (leftover,) = tmp_path.iterdir()
    assert not shown(tmp_path) and leftover.name.endswith(".partial")
    remove_leftovers(tmp_path)
    assert leftover.exists()  # perhaps its writer is still at work
    hours_ago = time.time() - 7200
    os.utime(leftover, (hours_ago, hours_ago))
    if write is by_a_path:
        remove_leftovers(tmp_path)
    write(tmp_path / "it", NEW)
    assert [path.name for path in tmp_path.iterdir()] == ["it"]


@pytest.mark.parametrize("write", [write_file, by_a_path])
def test_the_old_file_stays_until_the_new_one_is_whole(tmp_path, write):
    path = tmp_path / "it"
    path.write_bytes(OLD)
    path.chmod(0o640)
    with pytest.raises(OSError), full_after(200):
        write(path, NEW)
    killed(lambda: write(path, NEW))
    assert shown(tmp_path) == {"it": OLD}
    write(path, NEW)
    assert shown(tmp_path) == {"it": NEW} and path.stat().st_mode & 0o777 == 0o640


def test_text_is_written_as_it_stands(tmp_path):
    write_file(tmp_path / "it", "é\r\nx\n")
    assert (tmp_path / "it").read_bytes() == b"\xc3\xa9\r\nx\n"


def test_a_folder_is_never_overwritten(tmp_path):
    as_a_folder(tmp_path / "it", OLD)
    before = shown(tmp_path)
    with pytest.raises(FileExistsError, match="something here already"):
        as_a_folder(tmp_path / "it", NEW)
    assert shown(tmp_path) == before
    (tmp_path / "empty").mkdir()
    as_a_folder(tmp_path / "empty", NEW)
    assert (tmp_path / "empty" / "second").read_bytes() == NEW


def test_leftovers_of_other_paths_and_hidden_files_of_others_stay(tmp_path):
    for name in (".it.1.partial", ".other.1.partial", ".it", "it.partial"):
        (tmp_path / name).write_bytes(b"")
    remove_leftovers(tmp_path, "it", age=0.0)
    assert {path.name for path in tmp_path.iterdir()} == {".other.1.partial", ".it", "it.partial"}


def test_the_cache_is_where_the_environment_says(tmp_path, monkeypatch):
    monkeypatch.setenv("SHAPEWRIGHT_CACHE", str(tmp_path / "cache"))
    assert cache_folder() == tmp_path / "cache" and (tmp_path / "cache").is_dir()
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("SHAPEWRIGHT_CACHE", str(tmp_path / "file" / "cache"))
    assert cache_folder() is None


@pytest.mark.skipif(os.uname().sysname != "Linux", reason="the places on Linux")
def test_the_usual_cache_is_the_users(tmp_path, monkeypatch):
    monkeypatch.delenv("SHAPEWRIGHT_CACHE", raising=False)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    assert cache_folder() == tmp_path / ".cache" / "shapewright"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_folder() == tmp_path / "xdg" / "shapewright"


def test_file_names_are_safe_and_all_different():
    assert file_names(("a b", "a/b", "A-B", "???", "x")) == {
        "a b": "a-b",
        "a/b": "a-b-2",
        "A-B": "A-B-3",
        "???": "reference",
        "x": "x",
    }


def test_names_that_are_not_utf_8_are_printable_and_written():
    odd = os.fsdecode("chairs/st\xfchl".encode("latin-1") + b"\x81.obj")
    assert printable(odd) == printable(Path(odd)) == "chairs/st\xfchl\N{REPLACEMENT CHARACTER}.obj"
    assert printable("st\xfchl") == "st\xfchl"


def test_a_text_with_a_part_of_such_a_name_is_written_all_the_same(tmp_path):
    write_file(tmp_path / "report.html", "st\udcfchl")
    assert (tmp_path / "report.html").read_text() == "st?hl"


@pytest.mark.parametrize("text", ["=1+1", "+a", "-a", "@SUM(A1)", "\t=1", "\r=1"])
def test_no_cell_of_a_table_is_run_as_a_formula(text):
    assert cell(text) == f"'{text}"


@pytest.mark.parametrize("text", ["", "chair", "a=b", "1-2"])
def test_other_cells_stay(text):
    assert cell(text) == text
