"""Files of references that are put into a project: under safe names, over no other file, and whole or not at all."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from shapewright.studio.project.arrivals import Taken, arriving
from shapewright.studio.project.workspace import Project, ProjectError
from shapewright.studio.wire.requests import Arrived, Wrong
from studio_client import PROCEDURE


@pytest.fixture
def project(tmp_path: Path) -> Project:
    home = tmp_path / "project"
    home.mkdir()
    (home / "procedure.py").write_text(PROCEDURE)
    return Project.of(home)


def put(project: Project, name: str, data: bytes = b"v 0 0 0\n", beside: bool = False) -> Arrived:
    with arriving(project, name, beside) as (file, done):
        file.write(data)
    return done[0]


def there(project: Project) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in (project.folder / "references").iterdir()}


@pytest.mark.parametrize("name", ["chair.obj", "Stuhl 2.PLY", "椅子.glb", "a.b.c.stl", "scan.tar.gz", "scene.bin"])
def test_a_file_arrives_under_its_name(project: Project, name: str) -> None:
    assert put(project, name) == Arrived(path=name, bytes=8, there=False)
    assert there(project) == {name: b"v 0 0 0\n"}


def test_a_name_is_composed_as_most_systems_write_it(project: Project) -> None:
    assert put(project, "cafe\u0301.obj").path == "caf\u00e9.obj"


def test_nothing_is_written_over_and_what_is_the_same_stays(project: Project) -> None:
    put(project, "chair.obj")
    assert put(project, "chair.obj").there
    with pytest.raises(Taken, match=r"another chair\.obj"):
        put(project, "chair.obj", b"mine")
    assert put(project, "chair.obj", b"mine", beside=True).path == "chair-2.obj"
    assert put(project, "chair.obj", b"third", beside=True).path == "chair-3.obj"
    assert there(project) == {"chair.obj": b"v 0 0 0\n", "chair-2.obj": b"mine", "chair-3.obj": b"third"}


def test_without_hard_links_nothing_is_written_over_either(project: Project, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(1, "not permitted")

    monkeypatch.setattr(os, "link", refuse)
    put(project, "chair.obj")
    with pytest.raises(Taken):
        put(project, "chair.obj", b"mine")
    assert put(project, "chair.obj", b"mine", beside=True).path == "chair-2.obj"
    assert there(project) == {"chair.obj": b"v 0 0 0\n", "chair-2.obj": b"mine"}


def test_a_file_that_breaks_off_leaves_nothing(project: Project) -> None:
    for error in (ConnectionError("gone"), TimeoutError(), KeyError("x")):
        with pytest.raises((ProjectError, TimeoutError, KeyError)), arriving(project, "a.obj", False) as (file, _):
            file.write(b"half")
            raise error
    with pytest.raises(Wrong, match="is empty"):
        put(project, "a.obj", b"")
    assert there(project) == {}


def test_references_elsewhere_are_left_alone(project: Project, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    other = Project.of(project.folder, references=str(tmp_path / "elsewhere"))
    with pytest.raises(ProjectError, match="writes nothing"):
        put(other, "a.obj")
    assert not list((tmp_path / "elsewhere").iterdir())


def test_a_linked_folder_that_leads_out_is_refused(project: Project, tmp_path: Path) -> None:
    (tmp_path / "outside").mkdir()
    (project.folder / "references").rmdir()
    (project.folder / "references").symlink_to(tmp_path / "outside")
    with pytest.raises(ProjectError, match="leads out"):
        put(project, "a.obj")
    assert not list((tmp_path / "outside").iterdir())


def test_links_at_the_place_are_not_followed(project: Project, tmp_path: Path) -> None:
    for target in (tmp_path / "secret.obj", tmp_path / "nothing.obj"):
        (tmp_path / "secret.obj").write_bytes(b"secret")
        link = project.folder / "references" / "a.obj"
        link.symlink_to(target)
        with pytest.raises(Taken):
            put(project, "a.obj", b"secret")
        assert link.is_symlink() and not (tmp_path / "nothing.obj").exists()
        assert (tmp_path / "secret.obj").read_bytes() == b"secret"
        link.unlink()


def test_a_project_is_new_until_something_is_put_into_it(project: Project) -> None:
    assert project.is_new
    put(project, "a.obj")
    assert not project.is_new
