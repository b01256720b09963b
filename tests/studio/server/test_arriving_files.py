"""Attacks with files that are sent to a project: none leaves it, none is written over, nothing half is left."""

from __future__ import annotations

import http.client
import json
import socket
import time
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import quote

import pytest

from shapewright.studio.project.arrivals import MOST_BYTES
from studio_client import PROCEDURE, Studio, ready, studio

CUBE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("around") / "project"
    folder.mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    with studio(folder, "--no-auto-fit") as started:
        started.wait_for(ready)
        yield started


def everything(running: Studio) -> dict[str, bytes]:
    """All files around the project but for caches."""
    root = running.folder.parent
    files = {path.relative_to(root): path for path in root.rglob("*") if path.is_file()}
    return {str(name): path.read_bytes() for name, path in files.items() if "cache" not in name.parts}


def send(running: Studio, name: str, data: bytes = CUBE, beside: str = "false") -> tuple[int, dict[str, object]]:
    path = f"/api/arrivals?name={quote(name, safe='')}&beside={beside}"
    status, answer, _ = running.request("POST", path, raw=data)
    return status, json.loads(answer)


def test_a_new_project_has_no_alarm_and_a_file_that_arrives_is_shown(running: Studio) -> None:
    state = running.get("/api/state")
    assert state["problems"] == [] and state["collection"]["count"] == 0 and state["project"]["takes_files"]
    assert send(running, "first.obj") == (200, {"path": "first.obj", "bytes": len(CUBE), "there": False})
    running.wait_for(lambda s: [tile["slug"] for tile in s["collection"]["tiles"]] == ["first"])


NAMES = {
    "up": "../evil.obj",
    "up and up": "../../evil.obj",
    "up and back": "x/../../evil.obj",
    "root": "/evil.obj",
    "a folder": "folder/evil.obj",
    "up on Windows": "..\\evil.obj",
    "a drive": "C:\\evil.obj",
    "a drive alone": "C:evil.obj",
    "a stream": "evil.obj:hidden.obj",
    "encoded twice": "%2e%2e%2fevil.obj/..",
    "zero": "evil.obj\0.py",
    "zero before": "\0evil.obj",
    "line": "evil\n.obj",
    "return": "evil\r.obj",
    "escape": "\x1b[2Jevil.obj",
    "turned around": "evil\u202ejbo.obj",
    "separator": "evil\u2028.obj",
    "hidden": ".evil.obj",
    "hidden alone": ".obj",
    "dots": "..",
    "dot": ".",
    "nothing": "",
    "space before": " evil.obj",
    "space behind": "evil.obj ",
    "dot behind": "evil.obj.",
    "device": "con.obj",
    "device in capitals": "NUL.OBJ",
    "numbered device": "com1.stl",
    "too long": "x" * 300 + ".obj",
    "too long in bytes": "椅" * 80 + ".obj",
    "much too long": "x" * 30_000 + ".obj",
    "a star": "*.obj",
    "a question": "?.obj",
    "a pipe": "a|b.obj",
    "Python": "evil.py",
    "Python without": "evil",
    "a table": "shapewright.csv",
    "a page": "evil.html",
    "a program": "evil.exe",
    "a library": "evil.so",
    "a path file": "evil.pth",
    "settings": "settings.json",
    "two suffixes": "evil.obj.py",
}


@pytest.mark.parametrize("name", NAMES.values(), ids=NAMES)
def test_names_that_cannot_be_are_refused_and_nothing_is_left(running: Studio, name: str) -> None:
    before = everything(running)
    status, answer = send(running, name)
    assert status in (422, 400, 414, 431) and answer.get("error")
    assert everything(running) == before


def test_a_name_that_is_no_unicode_is_refused(running: Studio) -> None:
    before = everything(running)
    for name in ("%ff.obj", "%ed%a0%80.obj"):
        assert running.request("POST", f"/api/arrivals?name={name}", raw=CUBE)[0] in (200, 422)
    assert all("\udcff" not in name for name in everything(running))
    assert everything(running).keys() >= before.keys()


def test_another_file_of_the_name_stays(running: Studio) -> None:
    send(running, "kept.obj")
    status, answer = send(running, "kept.obj", CUBE + b"# other\n")
    assert status == 409 and answer["taken"] is True
    assert (running.folder / "references" / "kept.obj").read_bytes() == CUBE
    assert send(running, "kept.obj")[1]["there"] is True
    assert send(running, "kept.obj", CUBE + b"# other\n", "true")[1]["path"] == "kept-2.obj"
    assert send(running, "kept.obj", CUBE, "perhaps")[0] == 422


def test_links_in_the_folder_lead_nothing_out(running: Studio, tmp_path: Path) -> None:
    (tmp_path / "secret.obj").write_bytes(b"secret")
    home = running.folder / "references"
    for name, target in (("out.obj", tmp_path / "secret.obj"), ("dangling.obj", tmp_path / "new.obj")):
        (home / name).symlink_to(target)
        assert send(running, name)[0] == 409
        (home / name).unlink()
    assert [path.name for path in tmp_path.iterdir()] == ["secret.obj"]
    assert (tmp_path / "secret.obj").read_bytes() == b"secret"


def test_a_folder_that_becomes_a_link_takes_nothing(running: Studio, tmp_path: Path) -> None:
    home, moved = running.folder / "references", running.folder / "moved"
    home.rename(moved)
    home.symlink_to(tmp_path)
    status, answer = send(running, "a.obj")
    assert status == 409 and "leads out" in str(answer["error"]) and not list(tmp_path.iterdir())
    home.unlink()
    moved.rename(home)


def test_a_folder_of_the_name_stays(running: Studio) -> None:
    (running.folder / "references" / "folder.obj").mkdir()
    assert send(running, "folder.obj")[0] == 409
    (running.folder / "references" / "folder.obj").rmdir()


def test_an_empty_file_is_refused(running: Studio) -> None:
    before = everything(running)
    assert send(running, "empty.obj", b"")[0] == 422
    assert everything(running) == before


@pytest.mark.parametrize("declared", [True, False])
def test_a_file_that_is_too_large_is_refused(running: Studio, declared: bool) -> None:
    before = everything(running)
    connection = http.client.HTTPConnection("127.0.0.1", running.port, timeout=60)
    if declared:
        headers = {**running.headers, "Content-Length": str(MOST_BYTES + 1)}
        connection.request("POST", "/api/arrivals?name=large.obj", headers=headers)
        assert connection.getresponse().status == 413
    else:
        # It is refused on the way; the server may hang up while it is still sent.
        piece = b"x" * 2**22
        pieces = (piece for _ in range(MOST_BYTES // len(piece) + 4))
        try:
            connection.request("POST", "/api/arrivals?name=large.obj", pieces, running.headers, encode_chunked=True)
            assert connection.getresponse().status == 413
        except (BrokenPipeError, ConnectionResetError):
            pass
    connection.close()
    running.wait_for(lambda _: everything(running) == before, 20)


def test_other_requests_stay_small(running: Studio) -> None:
    for method, path in (
        ("PUT", "/api/arrivals?name=a.obj"),
        ("POST", "/api/arrivals/?name=a.obj"),
        ("POST", "/api/fit"),
    ):
        assert running.request(method, path, raw=b"x" * (2**20 + 1))[0] in (404, 405, 413)


def test_a_file_that_breaks_off_leaves_nothing(running: Studio) -> None:
    before = everything(running)
    head = f"POST /api/arrivals?name=half.obj HTTP/1.1\r\nHost: 127.0.0.1:{running.port}\r\n"
    head += f"Authorization: Bearer {running.token}\r\nContent-Length: 1000\r\n\r\nv 0 0 0\n"
    with socket.create_connection(("127.0.0.1", running.port)) as connection:
        connection.sendall(head.encode())
        time.sleep(0.3)
    running.wait_for(lambda _: everything(running) == before, 20)


def test_a_file_that_never_ends_is_given_up(running: Studio) -> None:
    before = everything(running)
    head = f"POST /api/arrivals?name=slow.obj HTTP/1.1\r\nHost: 127.0.0.1:{running.port}\r\n"
    head += f"Authorization: Bearer {running.token}\r\nContent-Length: 1000\r\n\r\nv 0 0 0\n"
    with socket.create_connection(("127.0.0.1", running.port), timeout=40) as connection:
        connection.sendall(head.encode())
        assert b"408" in connection.recv(4096)
    running.wait_for(lambda _: everything(running) == before, 20)


@pytest.mark.parametrize("headers", [{}, {"Authorization": "Bearer guess"}])
def test_strangers_send_nothing(running: Studio, headers: dict[str, str]) -> None:
    before = everything(running)
    assert running.request("POST", "/api/arrivals?name=a.obj", headers=headers, raw=CUBE)[0] == 401
    assert everything(running) == before


def test_what_is_no_mesh_is_told_and_harms_nothing(running: Studio) -> None:
    assert send(running, "lie.glb", b"#!/bin/sh\nrm -rf /\n")[0] == 200
    state = running.wait_for(lambda s: any("lie.glb" in one["path"] for one in s["collection"]["skipped"]))
    assert state["procedure"]["state"] == "good"
