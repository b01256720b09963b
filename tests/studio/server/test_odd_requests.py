"""Odd JSON, numbers that are none, links that lead out, requests that never end: refused, and the server goes on."""

from __future__ import annotations

import json
import socket
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pytest
import trimesh

from shapewright.studio.project.workspace import SCRATCH
from studio_client import PROCEDURE, Studio, ready, studio

DEEP = 100_000


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("project")
    (folder / "references").mkdir()
    trimesh.creation.box((1, 0.7, 0.6)).export(folder / "references" / "block.stl")
    (folder / "procedure.py").write_text(PROCEDURE)
    with studio(folder, "--no-auto-fit") as started:
        started.wait_for(ready)
        yield started


def files(running: Studio) -> dict[str, bytes]:
    """All that is in the project but for caches."""
    found = {path.relative_to(running.folder): path for path in running.folder.rglob("*") if path.is_file()}
    return {str(name): path.read_bytes() for name, path in found.items() if name.parts[0] not in ("cache", "runs")}


ODD = {
    "infinite": b'{"threshold": 1e999}',
    "NaN": b'{"threshold": NaN}',
    "infinity by name": b'{"threshold": Infinity}',
    "negative": b'{"threshold": -0.1}',
    "twice": b'{"threshold": 0.2, "threshold": 1e999}',
    "whole number beyond all": b'{"seed": 1' + b"0" * 400 + b"}",
    "fraction of a whole number": b'{"seed": 0.5}',
    "negative zero samples": b'{"samples": -0}',
    "text for a number": b'{"epochs": "7"}',
    "null": b'{"epochs": null}',
    "list for a number": b'{"epochs": [7]}',
    "lone surrogate": b'{"leave_out": "\\ud800"}',
    "unknown": b'{"__class__": 1}',
    "deep list": b"[" * DEEP,
    "deep object": b'{"a":' * DEEP,
    "deep value": b'{"threshold": ' + b"[" * DEEP + b"]" * DEEP + b"}",
    "a list": b"[]",
    "a text": b'"settings"',
    "a number": b"7",
    "cut short": b'{"threshold": 0.',
    "two": b"{} {}",
    "no UTF-8": b'{"leave_out": "\xff"}',
    "UTF-16": '{"threshold": 0.2}'.encode("utf-16"),
    "zeros": b"\0" * 100,
    "comment": b'{"threshold": 0.2} // mine',
    "single quotes": b"{'threshold': 0.2}",
}


@pytest.mark.parametrize("body", ODD.values(), ids=ODD)
def test_settings_that_cannot_be_are_refused_and_nothing_is_left(running: Studio, body: bytes) -> None:
    before, kept = running.get("/api/state")["settings"], files(running)
    status, answer, _ = running.request("PATCH", "/api/settings", raw=body)
    assert status == 422 and json.loads(answer)["error"]
    assert running.get("/api/state")["settings"] == before and files(running) == kept


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("PUT", "/api/source", b'{"text": "\\ud800", "digest": null}'),
        ("PUT", "/api/source", b'{"text": 1}'),
        ("PUT", "/api/source?file=helpers.py", b'{"text": 1}'),
        ("PUT", "/api/source?file=new.py", b'{"text": "\\ud800", "digest": null}'),
        ("PATCH", "/api/settings", b'{"scale": "rainbow"}'),
        ("PATCH", "/api/settings", b'{"scale": null}'),
        ("PUT", "/api/source", b'{"text": null}'),
        ("PUT", "/api/source", b'{"text": "x", "digest": 7}'),
        ("PUT", "/api/source", b'{"digest": null}'),
        ("POST", "/api/source/copy", b'{"text": "\\udfff"}'),
        ("POST", "/api/source/copy", b'{"text": ["x"]}'),
        ("PATCH", "/api/marks", b'{"a": "block", "b": "block"}'),
        ("PATCH", "/api/marks", b'{"a": "block", "b": "block", "same": 1}'),
        ("PATCH", "/api/marks", b'{"a": "block", "b": "../../x", "same": true}'),
        ("PATCH", "/api/marks", b'[{"a": "block", "b": "block", "same": true}]'),
        ("POST", "/api/export", b'{"what": []}'),
        ("POST", "/api/export", b'{"what": ["samples"], "count": 1e999}'),
        ("POST", "/api/export", b'{"what": ["samples"], "count": 1000000000}'),
        ("POST", "/api/export", b'{"what": ["samples"], "seed": -1}'),
        ("POST", "/api/export", b'{"what": ["samples"], "format": "exe"}'),
        ("POST", "/api/export", b'{"what": ["replicas"], "frame": "../x"}'),
        ("PATCH", "/api/references", b'{"slugs": ["block"], "told": {"up": "w"}}'),
        ("PATCH", "/api/references", b'{"slugs": ["nobody"], "told": {}}'),
        ("PATCH", "/api/references", b'{"slugs": [], "told": {}}'),
        ("POST", "/api/fit", b'{"fresh": "yes"}'),
        ("POST", "/api/cancel", b'{"kind": "all"}'),
        ("POST", "/api/revisions/1/undo", b'{"digest": 3}'),
        ("POST", "/api/suggestions/0/apply", b'{"to": "procedure", "hunks": 1}'),
        ("POST", "/api/suggestions/0/apply", b'{"to": "procedure", "hunks": ["0"]}'),
        ("POST", "/api/suggestions/0/apply", b'{"to": "procedure", "hunks": [0.5]}'),
        ("POST", "/api/suggestions/0/apply", b'{"to": "../x", "hunks": [0]}'),
    ],
)
def test_orders_that_make_no_sense_are_refused_and_nothing_is_left(
    running: Studio, method: str, path: str, body: bytes
) -> None:
    kept = files(running)
    status, answer, _ = running.request(method, path, raw=body)
    assert status == 422 and json.loads(answer)["error"]
    assert files(running) == kept and running.get("/api/state")["procedure"]["state"] == "good"


@pytest.mark.parametrize(
    "path",
    [
        "/api/revisions/0",
        "/api/revisions/999999",
        "/api/revisions/-1",
        "/api/revisions/1e3",
        "/api/revisions/" + "9" * 400,
        "/api/references/%00",
        "/api/references/..%2f..%2fprocedure.py",
        "/api/pictures/..%2f..%2fx.png",
        "/api/runs/..%2f..",
        "/api/runs/..",
        "/api/runs/001/files/..%2f..%2f..%2fprocedure.py",
        "/api/exports/..%2f..%2fprocedure.zip",
        "/api/suggestions/0/merge",
        "/api/suggestions/-1/merge",
        "/api/suggestions/" + "9" * 400 + "/merge",
    ],
)
def test_what_is_not_there_is_not_found(running: Studio, path: str) -> None:
    assert running.request("GET", path)[0] == 404


@pytest.mark.parametrize(
    "of",
    [
        "x",
        "[]",
        '{"parameters": 1}',
        '{"parameters": {"height": [1]}}',
        '{"parameters": {"height": 1e999}}',
        '{"parameters": {"height": NaN}}',
        '{"parameters": {}, "beyond": "height"}',
        '{"parameters": ' + "[" * 5000,
        "\udcff",
    ],
)
@pytest.mark.parametrize("path", ["references/block", "procedure"])
def test_pictures_of_parameters_that_are_none_are_refused(running: Studio, path: str, of: str) -> None:
    query = quote(of, errors="surrogateescape")
    assert running.request("GET", f"/api/{path}/render?of={query}")[0] in (404, 422)
    assert running.request("GET", "/api/procedure/render")[1].startswith(b"\x89PNG")


@pytest.mark.parametrize("query", ["azimuth=nan", "azimuth=1e999", "elevation=x", "size=1e9", "size=-1", "shape=all"])
def test_pictures_from_nowhere_are_refused(running: Studio, query: str) -> None:
    assert running.request("GET", f"/api/references/block/render?shape=reference&{query}")[0] == 422


@pytest.mark.parametrize(
    "parameters",
    [
        '{"height": 1e999}',
        '{"height": NaN}',
        '{"height": 1' + "0" * 400 + "}",
        '{"height": "\\ud800"}',
        '{"height": ' + "[" * 50_000,
        '{"height": [0.5]}',
        '{"height": {"a": 1}}',
        '{"shelf": 7, "leg": "thick"}',
        '{"": 1, "__init__": 2}',
    ],
)
@pytest.mark.parametrize("beyond", ["[]", '["height", "leg", "nobody"]'])
def test_parameters_that_are_none_leave_live_evaluation_as_it_was(
    running: Studio, parameters: str, beyond: str
) -> None:
    running.listen()
    assert running.socket is not None
    odd = f'{{"type": "evaluate", "id": 1, "slug": "block", "parameters": {parameters}, "beyond": {beyond}}}'
    running.socket.send(odd)
    running.next(lambda m: m["type"] == "wrong" or (m["type"] in ("mesh", "failed") and m["id"] == 1), 30)
    running.say(type="evaluate", id=2, slug="block", parameters={"height": 0.7})
    answer = running.next(lambda m: m["type"] in ("mesh", "failed") and m["id"] == 2, 30)
    assert answer["type"] == "mesh" and answer["parameters"]["height"] == pytest.approx(0.7)
    assert running.get("/api/state")["bench"] == "ready"


def test_a_number_beyond_its_range_is_built_where_that_is_asked_for(running: Studio) -> None:
    running.listen()
    for i, (beyond, height) in enumerate(((["height"], 2.5), ([], 1.2), (["leg"], 1.2)), start=10):
        running.say(type="evaluate", id=i, slug="block", parameters={"height": 2.5}, beyond=beyond)
        answer = running.next(lambda m, i=i: m["type"] in ("mesh", "failed") and m["id"] == i, 30)  # type: ignore[misc]
        assert answer["parameters"]["height"] == pytest.approx(height)


@pytest.mark.parametrize("name", ["exports", "revisions"])
def test_links_in_the_studios_folder_lead_nothing_out(running: Studio, name: str, tmp_path: Path) -> None:
    (tmp_path / "mine.zip").write_text("mine")
    (tmp_path / "000001.json").write_text("mine")
    home = running.folder / SCRATCH / name
    home.parent.mkdir(exist_ok=True)
    moved = home.with_name(f"{name}-before")
    if home.exists():
        home.rename(moved)
    home.symlink_to(tmp_path)
    text = running.get("/api/source")["text"]
    order: Any = {"what": ["samples"], "count": 1} if name == "exports" else {"text": text + "#\n", "digest": None}
    method, path = ("POST", "/api/export") if name == "exports" else ("PUT", "/api/source")
    refused = running.send(method, path, order, 409)
    assert "a link; remove it" in refused["error"]
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"mine.zip": "mine", "000001.json": "mine"}
    assert running.get("/api/source")["text"] == text
    home.unlink()
    if moved.exists():
        moved.rename(home)


def test_no_run_is_written_through_a_link(running: Studio, tmp_path: Path) -> None:
    (running.folder / "runs").symlink_to(tmp_path)
    refused = running.send("POST", "/api/fit", {}, 409)
    assert "a link" in refused["error"] and not list(tmp_path.iterdir())
    (running.folder / "runs").unlink()


def test_the_studios_folder_may_be_no_link(running: Studio, tmp_path: Path) -> None:
    home = running.folder / SCRATCH
    home.mkdir(exist_ok=True)
    home.rename(running.folder / "kept")
    home.symlink_to(tmp_path)
    for method, path, order in (
        ("PATCH", "/api/settings", {"epochs": 9}),
        ("PUT", "/api/source", {"text": "x = 1\n", "digest": None}),
        ("POST", "/api/export", {"what": ["samples"], "count": 1}),
    ):
        assert "a link; remove it" in running.send(method, path, order, 409)["error"]
    assert not list(tmp_path.iterdir()) and running.get("/api/source")["text"] == PROCEDURE
    assert running.get("/api/state")["settings"]["epochs"] != 9
    home.unlink()
    (running.folder / "kept").rename(home)


@pytest.mark.parametrize(
    "sent",
    [
        b"GET /api/state HTTP/1.1\r\nHost: 127.0.0.1",
        b"PUT /api/source HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer {token}\r\n"
        b'Content-Length: 100\r\n\r\n{"text": "',
        b"",
    ],
    ids=["half a head", "half a body", "nothing"],
)
def test_requests_that_never_end_are_ended(running: Studio, sent: bytes) -> None:
    with socket.create_connection(("127.0.0.1", running.port), timeout=40) as connection:
        connection.sendall(
            sent.replace(b"{port}", str(running.port).encode()).replace(b"{token}", running.token.encode())
        )
        begun = time.monotonic()
        while connection.recv(4096):
            pass
        assert time.monotonic() - begun < 30
    assert running.get("/api/source")["text"] == PROCEDURE


@pytest.mark.parametrize(
    "odd",
    [
        '"count": 0',
        '"count": 1000000000',
        '"count": 2.5',
        '"seed": -1',
        '"seed": 1e999',
        '"seed": 1' + "0" * 40,
        '"vary": ["height", "leg", "shelf"]',
        '"vary": [["height"]]',
        '"vary": null',
        '"locked": []',
        '"locked": {"height": ' + "[" * 50_000,
        '"base": "all"',
    ],
)
def test_shapes_that_cannot_be_are_not_explored(running: Studio, odd: str) -> None:
    running.listen()
    assert running.socket is not None
    running.socket.send(f'{{"type": "explore", "id": 1, {odd}}}')
    assert running.next(lambda m: m["type"] in ("wrong", "exploring"), 30)["type"] == "wrong"
    running.say(type="explore", id=2, count=1)
    assert running.next(lambda m: m["type"] == "explored", 30)["problem"] is None


@pytest.mark.parametrize(
    "order",
    [
        {"locked": {"height": "\x00", "leg": [1], "nobody": 1, "__class__": 2, "shelf": 7}},
        {"locked": {"height": 1e308, "leg": -1e308}},
        {"vary": ["nobody", "__init__"], "base": {"nobody": "x" * 10_000}},
        {"vary": ["height", "height"], "base": {"leg": True}},
    ],
)
def test_odd_values_are_explored_as_the_nearest_that_can_be(running: Studio, order: dict[str, Any]) -> None:
    running.listen()
    running.say(type="explore", id=3, count=2, **order)
    answer = running.next(lambda m: m["type"] in ("wrong", "explored") and m.get("id", 3) == 3, 30)
    if answer["type"] == "explored":
        assert answer["problem"] is None and set(answer["parameters"]) == {"height", "leg", "shelf", "shelf_height"}
        assert 0.3 <= answer["parameters"]["height"] <= 1.2
    assert running.get("/api/state")["bench"] == "ready"


@pytest.mark.parametrize(
    ("method", "path", "body"),
    [
        ("PATCH", "/api/notes", b'{"slugs": []}'),
        ("PATCH", "/api/notes", b'{"slugs": ["nobody"], "add": ["x"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["../../x"], "not_mine": true}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": [""]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": [" x"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": ["a,b"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": ["a\\u0000b"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": ["' + b"x" * 41 + b'"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": "x"}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "add": ["\\ud800"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "note": "' + b"x" * 4001 + b'"}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "note": ["x"]}'),
        ("PATCH", "/api/notes", b'{"slugs": ["block"], "not_mine": "yes"}'),
        ("PATCH", "/api/notes", b'{"slugs": ' + b"[" * DEEP),
        ("POST", "/api/references/turn", b'{"slugs": ["block"], "turn": "back"}'),
        ("POST", "/api/references/turn", b'{"slugs": ["nobody"], "turn": "tip"}'),
        ("POST", "/api/references/turn", b'{"slugs": [], "turn": "tip"}'),
        ("POST", "/api/references/unit", b'{"slugs": ["block"], "unit": "mile"}'),
        ("POST", "/api/references/unit", b'{"slugs": ["block"]}'),
        ("GET", "/api/map?seed=-1", b""),
        ("GET", "/api/map?seed=1e999", b""),
        ("GET", "/api/map?seed=nan", b""),
    ],
)
def test_what_is_said_of_many_and_makes_no_sense_is_refused_and_nothing_is_left(
    running: Studio, method: str, path: str, body: bytes
) -> None:
    kept = files(running)
    status, answer, _ = running.request(method, path, raw=body)
    assert status == 422 and json.loads(answer)["error"]
    assert files(running) == kept and running.get("/api/state")["bench"] == "ready"


@pytest.mark.parametrize(
    ("method", "path"),
    [
        ("POST", "/api/told/0/undo"),
        ("POST", "/api/told/999999/undo"),
        ("POST", "/api/told/" + "9" * 400 + "/undo"),
        ("POST", "/api/told/..%2f1/undo"),
        ("GET", "/api/references/..%2f..%2fprocedure.py/steps"),
        ("GET", "/api/references/nobody/alike"),
        ("GET", "/api/references/%00/steps"),
    ],
)
def test_changes_and_references_that_are_not_there_are_not_found(running: Studio, method: str, path: str) -> None:
    assert running.request(method, path, {} if method == "POST" else None)[0] == 404


def test_notes_are_written_over_no_link_and_texts_stay_texts(running: Studio, tmp_path: Path) -> None:
    (tmp_path / "mine.json").write_text("[]")
    (running.folder / "notes.json").symlink_to(tmp_path / "mine.json")
    (running.folder / SCRATCH).mkdir(exist_ok=True)
    told = running.folder / SCRATCH / "told"
    told.symlink_to(tmp_path)
    odd = '<img src=x onerror=alert(1)>"\n=1+1'
    running.send("PATCH", "/api/notes", {"slugs": ["block"], "add": ["<b>"], "note": odd})
    assert running.get("/api/state")["noted"]["block"] == {"tags": ["<b>"], "note": odd, "not_mine": False}
    assert {path.name: path.read_text() for path in tmp_path.iterdir()} == {"mine.json": "[]"}
    told.unlink()
    (running.folder / "notes.json").unlink()


@pytest.mark.parametrize(
    "text", ["{", "[1]", '{"a": 1}', '[{"name": 1}]', "[" * DEEP, '[{"name": "block", "tags": "x"}]']
)
def test_a_file_of_notes_of_a_stranger_is_told_and_stays(running: Studio, text: str) -> None:
    (running.folder / "notes.json").write_text(text)
    refused = running.send("PATCH", "/api/notes", {"slugs": ["block"], "add": ["x"]}, 409)
    assert "notes.json" in refused["error"] and (running.folder / "notes.json").read_text() == text
    (running.folder / "notes.json").unlink()
