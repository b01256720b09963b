"""The page as the server gives it out."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import Any

import pytest

from shapewright.studio.project.preferences import Preferences
from shapewright.studio.project.workspace import Project
from shapewright.studio.server.app import make_app
from shapewright.studio.server.security import Access
from shapewright.studio.session.session import Session
from studio_client import PROCEDURE


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    return Project.of(tmp_path)


def get(project: Project, page: Path, path: str) -> tuple[int, dict[str, str], str]:
    """Status, headers and text of an answer to a request with the token."""
    access = Access("127.0.0.1", 80)
    headers = {"host": "127.0.0.1:80", "authorization": f"Bearer {access.token}"}
    scope = {
        "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "method": "GET", "scheme": "http",
        "path": path, "raw_path": path.encode(), "root_path": "", "query_string": b"",
        "headers": [(name.encode(), value.encode()) for name, value in headers.items()],
    }  # fmt: skip
    sent: list[dict[str, Any]] = []

    bodies = [{"type": "http.request", "body": b"", "more_body": False}]

    async def receive() -> dict[str, Any]:
        return bodies.pop() if bodies else await asyncio.Future()

    async def send(message: Any) -> None:
        sent.append(message)

    async def run() -> None:
        await make_app(Session(project, Preferences()), access, page)(scope, receive, send)

    asyncio.run(run())
    told = {name.decode(): value.decode() for name, value in sent[0]["headers"]}
    return sent[0]["status"], told, b"".join(message.get("body", b"") for message in sent[1:]).decode()


def test_page_gets_the_nonce_of_its_answer(project: Project, tmp_path: Path) -> None:
    (tmp_path / "page" / "assets").mkdir(parents=True)
    (tmp_path / "page" / "index.html").write_text('<meta name="csp-nonce" content="__CSP_NONCE__">')
    (tmp_path / "page" / "assets" / "index.js").write_text("export {}")
    status, headers, text = get(project, tmp_path / "page", "/")
    nonce = text.split('content="')[1].split('"')[0]
    assert status == 200 and len(nonce) > 20 and f"'nonce-{nonce}'" in headers["content-security-policy"]
    assert headers["cache-control"] == "no-store"
    status, headers, _ = get(project, tmp_path / "page", "/assets/index.js")
    assert status == 200 and headers["content-type"].startswith("text/javascript")


def test_page_that_was_not_built_says_how(project: Project, tmp_path: Path) -> None:
    status, _, text = get(project, tmp_path / "nothing", "/")
    assert status == 200 and "was not built" in text and "npm run build" in text
    assert get(project, tmp_path / "nothing", "/assets/index.js")[0] == 404
