"""The author's file: replaced whole or not at all, with its line endings, behind a link, and a copy kept."""

import pytest

from broken_disk import full_after, hidden, killed, shown
from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError


@pytest.fixture
def project(tmp_path):
    (tmp_path / "procedure.py").write_bytes(b"one\r\ntwo\r\n")
    return Project.of(tmp_path)


def kept(project):
    return [path.read_bytes() for path in (project.folder / SCRATCH).glob("procedure-*.py")]


def test_a_text_is_replaced_with_its_line_endings_and_kept(project):
    project.write_source("one\nthree\n", None)
    assert project.procedure.read_bytes() == b"one\r\nthree\r\n"
    assert kept(project) == [b"one\ntwo\n"]


def test_a_link_is_followed(tmp_path):
    (tmp_path / "v1.py").write_text("one\n")
    (tmp_path / "procedure.py").symlink_to("v1.py")
    Project.of(tmp_path).write_source("two\n", None)
    assert (tmp_path / "procedure.py").is_symlink() and (tmp_path / "v1.py").read_text() == "two\n"


def test_what_fails_or_is_killed_leaves_the_text_as_it_was(project):
    before = shown(project.folder)
    with pytest.raises(ProjectError, match="cannot be written: File too large"), full_after(20):
        project.write_source("x" * 30, None)
    assert shown(project.folder) == before
    with pytest.raises(ProjectError, match="cannot be written"), full_after(20):
        project.write_copy("x" * 30)
    assert shown(project.folder) == before
    assert hidden(project.folder) == [".gitignore", SCRATCH]
    killed(lambda: project.write_source("x" * 30, None))
    assert shown(project.folder) == before
