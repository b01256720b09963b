"""Secrets that are kept for the next start: only where this user alone can read and write them."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

import pytest

from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError
from shapewright.studio.server.kept_access import Kept, forget, keep, kept
from shapewright.studio.server.security import Access
from studio_client import PROCEDURE, studio


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    return Project.of(tmp_path)


def place(project: Project) -> Path:
    return project.folder / SCRATCH / "access.json"


def test_what_is_kept_comes_back(project: Project) -> None:
    access = Access("127.0.0.1", 4321)
    keep(project, access)
    assert place(project).stat().st_mode & 0o777 == 0o600
    found = kept(project)
    assert found and found.port == 4321 and found.access("127.0.0.1", 4321) == access
    keep(project, access)
    assert [path.name for path in (project.folder / SCRATCH).iterdir() if "access" in path.name] == ["access.json"]
    forget(project)
    assert kept(project) is None and not place(project).exists()


@pytest.mark.skipif(os.name != "posix", reason="modes of files are of POSIX")
@pytest.mark.parametrize("mode", [0o644, 0o640, 0o604, 0o620, 0o602, 0o666])
def test_a_file_that_others_may_read_or_write_is_not_believed(project: Project, mode: int) -> None:
    keep(project, Access("127.0.0.1", 4321))
    place(project).chmod(mode)
    assert kept(project) is None


@pytest.mark.skipif(os.name != "posix", reason="links and pipes of POSIX")
@pytest.mark.timeout(20)
def test_links_and_pipes_are_not_believed(project: Project, tmp_path_factory: pytest.TempPathFactory) -> None:
    keep(project, Access("127.0.0.1", 4321))
    elsewhere = tmp_path_factory.mktemp("elsewhere") / "access.json"
    place(project).rename(elsewhere)
    place(project).symlink_to(elsewhere)
    assert kept(project) is None
    keep(project, Access("127.0.0.1", 4321))  # the link goes, what it leads to stays
    assert not place(project).is_symlink() and elsewhere.exists()
    place(project).unlink()
    os.mkfifo(place(project), 0o600)
    assert kept(project) is None


def test_a_linked_folder_is_refused(project: Project, tmp_path_factory: pytest.TempPathFactory) -> None:
    outside = tmp_path_factory.mktemp("outside")
    (project.folder / SCRATCH).symlink_to(outside)
    with pytest.raises(ProjectError, match="a link"):
        keep(project, Access("127.0.0.1", 4321))
    assert not list(outside.iterdir())


LONG = "x" * 43


@pytest.mark.parametrize(
    "content",
    [
        "",
        "[]",
        "{",
        "\x00",
        json.dumps({"port": 1, "token": "", "cookie": "", "key": ""}),
        json.dumps({"port": 1, "token": "short", "cookie": LONG, "key": LONG + "y"}),
        json.dumps({"port": 1, "token": LONG, "cookie": LONG, "key": LONG}),
        json.dumps({"port": 0, "token": LONG, "cookie": LONG + "y", "key": LONG + "z"}),
        json.dumps({"port": 10**9, "token": LONG, "cookie": LONG + "y", "key": LONG + "z"}),
        json.dumps({"port": "x", "token": LONG, "cookie": LONG + "y", "key": LONG + "z"}),
        json.dumps({"port": 1, "token": LONG + "; Path=/", "cookie": LONG + "\r\nSet-Cookie: a=b", "key": LONG}),
        '{"a":' * 1500,
    ],
)
def test_a_file_that_says_something_else_is_not_believed(project: Project, content: str) -> None:
    project.scratch()
    place(project).write_text(content)
    place(project).chmod(0o600)
    assert kept(project) is None


def test_a_sound_file_is_believed(project: Project) -> None:
    project.scratch()
    place(project).write_text(json.dumps({"port": 9, "token": LONG, "cookie": LONG + "y", "key": LONG + "z"}))
    place(project).chmod(0o600)
    assert kept(project) == Kept(9, {"token": LONG, "cookie": LONG + "y", "key": LONG + "z"})


def test_a_studio_that_keeps_its_token_lets_the_same_page_in_again(tmp_path: Path) -> None:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    with studio(tmp_path, "--keep-token") as first:
        _, body, headers = first.request("GET", f"/?token={first.token}", headers={})
        key = re.search(r"url=/#key=([\w-]+)", body.decode())
        assert key
        sent = {"Cookie": headers["set-cookie"].split(";")[0], "X-Shapewright-Key": key[1]}
        assert first.request("GET", "/api/state", headers=sent)[0] == 200
    with studio(tmp_path, "--keep-token") as again:
        assert (again.port, again.token) == (first.port, first.token)
        assert again.request("GET", "/api/state", headers=sent)[0] == 200
    with studio(tmp_path, "--port", str(first.port)) as new:
        assert new.token != first.token and not (tmp_path / SCRATCH / "access.json").exists()
        assert new.request("GET", "/api/state", headers=sent)[0] == 401
        assert new.request("GET", "/api/state", headers=first.headers)[0] == 401
