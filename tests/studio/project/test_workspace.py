"""The author's file: replaced whole or not at all, with its line endings, behind a link, and a copy kept."""

import pytest

from broken_disk import full_after, hidden, killed, shown
from shapewright.studio.project.watch import fingerprint
from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError


@pytest.fixture
def project(tmp_path):
    (tmp_path / "procedure.py").write_bytes(b"one\r\ntwo\r\n")
    return Project.of(tmp_path)


def test_a_text_is_replaced_with_its_line_endings_and_kept(project):
    number = project.write_source("one\nthree\n", None)
    assert project.procedure.read_bytes() == b"one\r\nthree\r\n"
    assert project.revisions.texts(number) == ("one\ntwo\n", "one\nthree\n")
    assert project.write_source("one\nthree\n", None) is None and len(project.revisions.all()) == 1


def test_a_file_that_was_deleted_is_made_anew_where_nothing_else_is_expected(project):
    digest = project.read_source()[1]
    project.procedure.unlink()
    with pytest.raises(ProjectError, match="not there any more"):
        project.write_source("mine\n", digest)
    project.write_source("mine\n", None)
    assert project.procedure.read_text() == "mine\n"


def test_nothing_is_written_through_a_link_that_leads_out(project, tmp_path_factory):
    outside = tmp_path_factory.mktemp("outside")
    project.procedure.unlink()
    project.procedure.symlink_to(outside / "not-there.py")
    with pytest.raises(ProjectError, match="leads out of the project"):
        project.write_source("mine\n", None)
    (project.folder / SCRATCH).mkdir()
    for name in ("revisions", "exports"):
        (project.folder / SCRATCH / name).symlink_to(outside)
        with pytest.raises(ProjectError, match="a link; remove it"):
            project.scratch(name)
    assert not list(outside.iterdir())


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


@pytest.fixture
def scad(tmp_path):
    """A project whose procedure is no Python, with what it uses and what it does not."""
    (tmp_path / "lib").mkdir()
    (tmp_path / "box.scad").write_text('use <lib/feet.scad>\nimport("my logo.stl");\n')
    (tmp_path / "lib" / "feet.scad").write_text("include <sizes.scad>\n")
    (tmp_path / "lib" / "sizes.scad").write_text("a = 1;\n")
    (tmp_path / "my logo.stl").write_bytes(b"\0binary")
    (tmp_path / "other.scad").write_text("b = 1;\n")
    return Project.of(tmp_path, "box.scad")


@pytest.mark.parametrize("name", ["box.scad", "lib/feet.scad", "lib/sizes.scad", "my logo.stl"])
def test_a_change_of_what_a_procedure_that_is_no_python_uses_is_seen(scad, name):
    before = fingerprint(scad)
    (scad.folder / name).write_bytes((scad.folder / name).read_bytes() + b"// more")
    assert fingerprint(scad) != before


def test_a_change_of_what_it_does_not_use_is_none(scad):
    before = fingerprint(scad)
    (scad.folder / "other.scad").write_text("b = 2;\n")
    assert fingerprint(scad) == before


def test_copies_of_it_are_the_same_kind_of_file(scad):
    assert scad.write_copy("cube(3);").name == "box-1.scad"


def test_a_binary_procedure_is_read_as_a_line_about_it_and_never_written(tmp_path):
    (tmp_path / "model.blend").write_bytes(b"BLENDER\xff\0")
    project = Project.of(tmp_path, "model.blend")
    assert project.read_source()[0].startswith("9 bytes, SHA-256 ")
    with pytest.raises(ProjectError, match=r"model.blend is no text"):
        project.write_source("other", None)
