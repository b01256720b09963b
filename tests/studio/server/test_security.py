"""Attacks on the studio, each of which must be refused."""

from __future__ import annotations

import http.client
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.server.launch import opening_page, serve
from shapewright.studio.server.security import KEY, MOST_BYTES, PROTOCOL, Access
from studio_client import PROCEDURE, Studio, studio


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("project")
    (folder / "procedure.py").write_text(PROCEDURE)
    (folder.parent / "secret.py").write_text("secret")
    with studio(folder) as started:
        yield started


def status(running: Studio, method: str, path: str, headers: dict[str, str], body: bytes | None = None) -> int:
    return running.request(method, path, headers=headers, raw=body)[0]


def arrived(running: Studio) -> tuple[str, str]:
    """The cookie and the key of a browser that opened the printed address."""
    found, body, headers = running.request("GET", f"/?token={running.token}", headers={})
    key = re.search(r"url=/#key=([\w-]+)", body.decode())
    assert found == 200 and key
    return headers["set-cookie"].split(";")[0], key[1]


def own(running: Studio, **more: str) -> dict[str, str]:
    """What the page itself sends."""
    cookie, key = arrived(running)
    return {"Cookie": cookie, KEY: key, "Origin": f"http://127.0.0.1:{running.port}", **more}


def test_the_page_itself_is_let_in(running: Studio) -> None:
    assert status(running, "GET", "/api/source", own(running)) == 200
    assert status(running, "PATCH", "/api/settings", own(running), b"{}") == 200


def test_the_token_of_the_address_brings_a_cookie_and_a_key_that_differ_from_it(running: Studio) -> None:
    cookie, key = arrived(running)
    _, _, headers = running.request("GET", f"/?token={running.token}", headers={})
    assert "HttpOnly" in headers["set-cookie"] and "SameSite=Strict" in headers["set-cookie"]
    name, _, secret = cookie.partition("=")
    assert name == f"shapewright_{running.port}" and len({secret, key, running.token}) == 3
    for wrong in (secret, key):
        assert status(running, "GET", "/api/state", {"Authorization": f"Bearer {wrong}"}) == 401
        assert status(running, "GET", f"/?token={wrong}", {}) == 401
    assert status(running, "GET", f"/api/state?token={running.token}", {}) == 401
    assert status(running, "GET", "/api/state", own(running, Cookie=f"{name}={running.token}")) == 401


@pytest.mark.parametrize(
    ("method", "path"),
    [
        *(("GET", path) for path in ("/api/state", "/api/source", "/api/revisions", "/api/revisions/1")),
        *(
            ("GET", path)
            for path in ("/api/explanation", "/api/runs/001", "/api/references/a", "/api/references/a/shape")
        ),
        *(("GET", path) for path in ("/api/compare?before=001&after=002", "/nothing", "/api/next")),
        *(("GET", path) for path in ("/api/suggestions/0/merge", "/api/arrivals?name=a.obj")),
        ("POST", "/api/arrivals?name=a.obj"),
        *(("POST", path) for path in ("/api/fit", "/api/explain", "/api/export", "/api/cancel", "/api/source/copy")),
        *(("POST", path) for path in ("/api/pictures/0.png", "/", "/api/suggestions/0/apply", "/api/revisions/1/undo")),
        *(("PATCH", path) for path in ("/api/settings", "/api/marks", "/api/references")),
        ("PUT", "/api/source"),
    ],
)
def test_a_server_that_was_sent_the_cookie_can_do_nothing_with_it(running: Studio, method: str, path: str) -> None:
    """Browsers send cookies to all ports of a host; what other servers there do with them has the right headers."""
    headers = own(running)
    del headers[KEY]
    for key in ("", "guess", running.token, headers["Cookie"].partition("=")[2]):
        assert status(running, method, path, {**headers, KEY: key}, b"{}" if method != "GET" else None) == 401


def test_the_cookie_alone_shows_the_page_and_its_pictures(running: Studio) -> None:
    cookie = {"Cookie": arrived(running)[0]}
    assert status(running, "GET", "/", cookie) == 200
    assert status(running, "GET", "/api/pictures/0.png", cookie) == 404


def test_the_token_is_in_no_argument_of_a_program(tmp_path: Path) -> None:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    access = Access("127.0.0.1", 8470)
    for _ in range(2):
        page = opening_page(Project.of(tmp_path), access.address)
        assert access.token not in page.as_uri() and access.address in page.read_text()
        assert page.stat().st_mode & 0o777 == 0o600
        page.chmod(0o644)  # left by another studio


@pytest.mark.parametrize("path", ["/", "/api/state", "/api/source", "/assets/x.js", "/api/pictures/0.png", "/nothing"])
@pytest.mark.parametrize(
    "headers", [{}, {"Authorization": "Bearer wrong"}, {"Authorization": "Bearer "}, {"Cookie": "shapewright=x; a"}]
)
def test_without_the_token_nothing_is_told(running: Studio, path: str, headers: dict[str, str]) -> None:
    assert status(running, "GET", path, headers) == 401


def test_a_wrong_token_in_the_address_is_refused(running: Studio) -> None:
    assert status(running, "GET", "/?token=guess", {}) == 401
    assert status(running, "GET", "/?token=", {}) == 401


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1", "127.0.0.1:1", "localhost.evil.example:{port}", ""]
)
def test_foreign_host_is_refused(running: Studio, host: str) -> None:
    """DNS rebinding: a name of the attacker's that resolves to this machine."""
    headers = {**running.headers, "Host": host.format(port=running.port)}
    assert status(running, "GET", "/api/state", headers) in (400, 403)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "https://127.0.0.1:{port}", "http://127.0.0.1:1"])
@pytest.mark.parametrize(("method", "path"), [("PUT", "/api/source"), ("POST", "/api/fit"), ("GET", "/api/source")])
def test_foreign_origin_is_refused(running: Studio, origin: str, method: str, path: str) -> None:
    """Cross-site requests that carry the cookie."""
    headers = own(running, Origin=origin.format(port=running.port))
    assert status(running, method, path, headers, b"{}" if method != "GET" else None) == 403


def test_a_change_without_origin_is_refused(running: Studio) -> None:
    headers = own(running)
    del headers["Origin"]
    for method, path in (("PUT", "/api/source"), ("POST", "/api/fit"), ("PATCH", "/api/settings")):
        assert status(running, method, path, headers, b"{}") == 403


def test_another_site_that_reads_is_refused(running: Studio) -> None:
    headers = own(running, **{"Sec-Fetch-Site": "cross-site"})
    del headers["Origin"]
    assert status(running, "GET", "/api/source", headers) == 403
    headers["Sec-Fetch-Site"] = "same-site"
    assert status(running, "GET", "/api/source", headers) == 403


@pytest.mark.parametrize(
    ("headers", "origin"),
    [
        ({}, "own"),
        ({"Cookie": "yes"}, "own"),
        ({"Cookie": "yes", "Sec-WebSocket-Protocol": "shapewright, guess"}, "own"),
        ({"Cookie": "yes"}, "http://evil.example"),
        ({"Cookie": "yes"}, None),
        ({"Cookie": "yes"}, "null"),
        ({"Authorization": "Bearer wrong"}, None),
        ({"Cookie": "yes", "Host": "evil.example"}, "own"),
    ],
)
def test_foreign_websocket_is_refused(running: Studio, headers: dict[str, str], origin: str | None) -> None:
    given = {name: own(running)["Cookie"] if value == "yes" else value for name, value in headers.items()}
    source: Any = own(running)["Origin"] if origin == "own" else origin
    with (
        pytest.raises((InvalidStatus, ConnectionClosed)) as refused,
        connect(f"ws://127.0.0.1:{running.port}/api/live", additional_headers=given, origin=source) as socket,
    ):
        socket.recv(timeout=5)
    assert isinstance(refused.value, ConnectionClosed) or refused.value.response.status_code in (400, 403)


def test_the_pages_own_websocket_is_let_in(running: Studio) -> None:
    sent, origin = own(running), own(running)["Origin"]
    address, cookie = f"ws://127.0.0.1:{running.port}/api/live", {"Cookie": sent["Cookie"]}
    offered: Any = [PROTOCOL, sent[KEY]]
    with connect(address, additional_headers=cookie, origin=origin, subprotocols=offered, max_size=None) as socket:  # type: ignore[arg-type]
        assert socket.subprotocol == PROTOCOL
        assert json.loads(socket.recv(timeout=10))["type"] == "state"


def test_headers_keep_the_page_to_itself(running: Studio) -> None:
    nonces = set()
    for path in ("/", "/api/state", "/api/no", "/assets/no.js"):
        _, _, headers = running.request("GET", path)
        policy = dict(part.strip().split(" ", 1) for part in headers["content-security-policy"].split(";"))
        assert policy["default-src"] == policy["frame-ancestors"] == policy["base-uri"] == "'none'"
        assert policy["script-src"] == policy["connect-src"] == "'self'"
        assert "unsafe" not in headers["content-security-policy"]
        nonces.add(policy["style-src"])
        assert headers["x-content-type-options"] == "nosniff" and headers["x-frame-options"] == "DENY"
        assert "access-control-allow-origin" not in headers
    assert len(nonces) == 4


@pytest.mark.parametrize("declared", [True, False])
def test_large_bodies_are_refused(running: Studio, declared: bool) -> None:
    connection = http.client.HTTPConnection("127.0.0.1", running.port, timeout=20)
    body = b"x" * (MOST_BYTES + 2**16)
    if declared:
        connection.request("PUT", "/api/source", headers={**running.headers, "Content-Length": str(10**12)})
    else:
        pieces = (body[i : i + 2**16] for i in range(0, len(body), 2**16))
        connection.request("PUT", "/api/source", pieces, running.headers, encode_chunked=True)
    assert connection.getresponse().status == 413
    connection.close()
    assert (running.folder / "procedure.py").read_text() == PROCEDURE


@pytest.mark.parametrize(
    "path",
    [
        "../secret.py",
        "..%2fsecret.py",
        "../../secret.py",
        "%2e%2e/%2e%2e/%2e%2e/secret.py",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "..\\secret.py",
        "link.png",
        "folder/secret.png",
        "iteration.json",
        "procedure.py",
        "",
    ],
)
def test_no_path_leaves_the_run(running: Studio, path: str) -> None:
    run = running.folder / "runs" / "001"
    if not run.exists():
        run.mkdir(parents=True)
        (run / "iteration.json").write_text("{}")
        (run / "fine.png").write_bytes(b"png")
        outside = running.folder.parent / "outside"
        outside.mkdir(exist_ok=True)
        (outside / "secret.png").write_bytes(b"secret")
        (run / "link.png").symlink_to(outside / "secret.png")
        (run / "folder").symlink_to(outside)
    assert running.request("GET", "/api/runs/001/files/fine.png")[1] == b"png"
    found, body, _ = running.request("GET", f"/api/runs/001/files/{path}")
    assert found == 404 and b"secret\n" not in body and body != b"secret"


@pytest.mark.parametrize(
    "path",
    [
        "/api/runs/..%2f..%2foutside/files/secret.png",
        "/api/runs/../files/secret.png",
        "/api/exports/..%2f..%2f..%2fsecret.zip",
        "/api/exports/..%2fsecret.zip",
        "/api/pictures/..%2f..%2fsecret.png",
        "/assets/..%2f..%2f..%2fprocedure.py",
        "/assets/../app.py",
        "/assets/%2e%2e/app.py",
        "/assets//etc/passwd",
        "/api/references/..%2fsecret",
        "/api/compare?before=..%2f..&after=001",
    ],
)
def test_no_path_leaves_the_project(running: Studio, path: str) -> None:
    found, body, _ = running.request("GET", path)
    assert found == 404 and b"root:" not in body and b"import" not in body


def test_linked_run_outside_is_refused(running: Studio) -> None:
    outside = running.folder.parent / "elsewhere"
    outside.mkdir()
    (outside / "iteration.json").write_text("{}")
    (outside / "x.png").write_bytes(b"secret")
    (running.folder / "runs").mkdir(exist_ok=True)
    (running.folder / "runs" / "900").symlink_to(outside)
    (outside / "procedure.py").write_text("secret")
    for path in ("/files/x.png", "/report.html", ""):
        assert running.request("GET", f"/api/runs/900{path}")[0] == 404
    assert running.request("POST", "/api/runs/900/restore", {"digest": None})[0] == 404
    (running.folder / "runs" / "900").unlink()


def test_procedure_that_becomes_a_link_outwards_is_not_read_or_written(running: Studio) -> None:
    path = running.folder / "procedure.py"
    path.unlink()
    path.symlink_to(running.folder.parent / "secret.py")
    assert running.get("/api/source") == {
        "path": "procedure.py", "text": "", "digest": "",
        "unreadable": "procedure.py has become a link that leads out of the project",
    }  # fmt: skip
    assert running.request("PUT", "/api/source", {"text": "x", "digest": None})[0] == 409
    assert (running.folder.parent / "secret.py").read_text() == "secret"
    path.unlink()
    path.write_text(PROCEDURE)


def test_references_that_lead_outwards_are_not_read(tmp_path: Path) -> None:
    from shapewright.studio.project.listing import listing

    home = tmp_path / "project"
    (home / "references").mkdir(parents=True)
    (home / "procedure.py").write_text(PROCEDURE)
    (tmp_path / "secret.obj").write_text("v 0 0 0")
    (home / "references" / "link.obj").symlink_to(tmp_path / "secret.obj")
    (home / "references" / "own.obj").write_text("v 0 0 0")
    found = listing(Project.of(home).origin)
    assert list(found.sources) == ["own"] and "leads out of the project" in next(iter(found.skipped.values()))
    assert set(listing(Project.of(home, references=str(home / "references")).origin).sources) == {"link", "own"}


def test_project_links_outwards_are_refused(tmp_path: Path) -> None:
    (tmp_path / "project").mkdir()
    (tmp_path / "outside.py").write_text(PROCEDURE)
    (tmp_path / "project" / "procedure.py").symlink_to(tmp_path / "outside.py")
    with pytest.raises(ProjectError, match="leads out of the project"):
        Project.of(tmp_path / "project")
    with pytest.raises(ProjectError, match="shapewright new"):
        Project.of(tmp_path)
    with pytest.raises(ProjectError, match="no such folder"):
        Project.of(tmp_path / "nothing")


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.7", "example.org"])
def test_other_addresses_need_a_flag_of_their_own(tmp_path: Path, host: str) -> None:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    with pytest.raises(ProjectError, match="--allow-remote"):
        serve(Project.of(tmp_path), Preferences(), host=host)


@pytest.mark.parametrize(
    ("host", "named", "allowed"),
    [
        ("127.0.0.1", "127.0.0.1:80", True),
        ("127.0.0.1", "LOCALHOST:80", True),
        ("127.0.0.1", "[::1]:80", True),
        ("127.0.0.1", "192.168.1.7:80", False),
        ("127.0.0.1", None, False),
        ("0.0.0.0", "192.168.1.7:80", True),
        ("0.0.0.0", "rebound.example:80", False),
        ("0.0.0.0", "192.168.1.7:81", False),
        ("studio.local", "studio.local:80", True),
    ],
)
def test_which_names_a_server_has(host: str, named: str | None, allowed: bool) -> None:
    assert Access(host, 80).allows_host(named) == allowed


def test_tokens_differ_and_are_not_shown() -> None:
    one, other = Access("127.0.0.1", 80), Access("127.0.0.1", 80)
    assert one.token != other.token and len(one.token) > 40 and one.token not in repr(one)


NOWHERE = {
    "up": "../secret.py",
    "encoded up": "..%2Fsecret.py",
    "twice encoded": "..%252Fsecret.py",
    "absolute": "/etc/hosts.txt",
    "below": "references/notes.txt",
    "the studio's own": ".shapewright/settings.json",
    "hidden": ".hidden.py",
    "marks": "marks.json",
    "a link out": "linked.py",
    "a link that leads nowhere": "dangling.py",
    "a folder": "folder.py",
    "no text": "shape.ply",
    "no suffix": "Makefile",
    "a zero": "a%00.py",
    "a line": "a%0Ab.py",
    "a stream of Windows": "a.py::$DATA",
    "a backslash": "..\\secret.py",
    "nothing": "%20",
    "a surrogate": "%ED%A0%80.py",
    "too long": "a" * 300 + ".py",
}


@pytest.mark.parametrize("method", ["GET", "PUT"])
@pytest.mark.parametrize("name", NOWHERE.values(), ids=NOWHERE)
def test_no_other_file_is_read_or_written_by_the_editor(running: Studio, name: str, method: str) -> None:
    folder = running.folder
    secret = folder.parent / "secret.py"
    for path in (folder / ".hidden.py", folder / "references" / "notes.txt"):
        path.write_text("secret")
    (folder / "folder.py").mkdir(exist_ok=True)
    for link, to in (("linked.py", secret), ("dangling.py", folder.parent / "nowhere.py")):
        if not (folder / link).is_symlink():
            (folder / link).symlink_to(to)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file() and "cache" not in path.parts}
    body = {"text": "x = 1", "digest": None} if method == "PUT" else None
    status, answer, _ = running.request(method, f"/api/source?file={name}", body)
    assert status == 404 and b'"secret"' not in answer, answer
    after = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file() and "cache" not in path.parts}
    assert after == before and secret.read_text() == "secret" and not (folder.parent / "nowhere.py").exists()
    for link in ("linked.py", "dangling.py", ".hidden.py"):
        (folder / link).unlink()
    (folder / "folder.py").rmdir()


def test_files_beside_the_procedure_have_the_safety_rules_of_the_procedure(running: Studio) -> None:
    (running.folder / "sizes.json").write_text("1")
    source = running.get("/api/source?file=sizes.json")
    assert source["text"] == "1"
    (running.folder / "sizes.json").write_text("2")
    running.send("PUT", "/api/source?file=sizes.json", {"text": "3", "digest": source["digest"]}, 409)
    assert (running.folder / "sizes.json").read_text() == "2"
    foreign = {**running.headers, "Origin": "http://evil.example"}
    order = {"text": "4", "digest": None}
    assert running.request("PUT", "/api/source?file=sizes.json", order, foreign)[0] == 403
    home = running.folder / ".shapewright" / "revisions"
    home.mkdir(parents=True, exist_ok=True)
    (home / "sizes.json").symlink_to(running.folder.parent)
    refused = running.send("PUT", "/api/source?file=sizes.json", order, 409)
    assert "a link; remove it" in refused["error"]
    (home / "sizes.json").unlink()
    revision = running.send("PUT", "/api/source?file=sizes.json", order)["revision"]
    assert running.get(f"/api/revisions/{revision}?file=sizes.json")["revision"]["writer"] == "editor"
    assert running.request("GET", f"/api/revisions/{revision}")[0] == 404
    (running.folder / "sizes.json").unlink()
