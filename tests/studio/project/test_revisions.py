"""The undo list: nothing that was in the procedure's file is ever lost."""

import pytest

from broken_disk import full_after
from shapewright.studio.project.authored import Authored
from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError


@pytest.fixture
def project(tmp_path):
    (tmp_path / "procedure.py").write_text("one\n")
    return Project.of(tmp_path)


def listed(project):
    return [(one.number, one.writer, one.of, one.added, one.removed) for one in project.revisions.all()]


def test_every_write_is_listed_with_what_made_it_also_after_a_restart(project):
    project.write_source("one\ntwo\n", None)
    project.write_source("three\n", None, "suggestion", "Longer legs")
    project.write_source("one\n", None, "run", "001")
    again = Project.of(project.folder)
    assert listed(again) == [(3, "run", "001", 1, 1), (2, "suggestion", "Longer legs", 1, 2), (1, "editor", "", 1, 0)]
    assert again.revisions.texts(2) == ("one\ntwo\n", "three\n")
    detail = again.revisions.detail(1)
    assert [(line.kind, line.text) for line in detail.diff] == [("same", "one"), ("added", "two")]
    assert detail.revision.number == 1


def test_what_another_program_writes_in_between_is_a_write_of_its_own(project):
    project.write_source("two\n", None)
    project.procedure.write_text("theirs\n")
    project.write_source("three\n", None)
    assert [(one.writer, project.revisions.texts(one.number)) for one in project.revisions.all()] == [
        ("editor", ("theirs\n", "three\n")),
        ("another program", ("two\n", "theirs\n")),
        ("editor", ("one\n", "two\n")),
    ]


def test_saves_of_another_program_beside_the_studio_are_listed_once(project):
    authored = Authored(project)
    authored.read(saved=False)
    assert listed(project) == [] and not (project.folder / SCRATCH).exists()
    project.procedure.write_text("two\n")
    authored.read(saved=True)
    authored.read(saved=True)
    assert [one.writer for one in project.revisions.all()] == ["another program"]
    assert project.revisions.texts(1) == ("one\n", "two\n")
    project.write_source("three\n", None)
    authored.read(saved=True)
    assert [one.writer for one in project.revisions.all()] == ["editor", "another program"]


def test_a_save_while_the_studio_was_closed_is_listed_when_it_opens(project):
    project.write_source("two\n", None)
    project.procedure.write_text("closed\n")
    Authored(Project.of(project.folder)).read(saved=False)
    assert project.revisions.texts(2) == ("two\n", "closed\n")


def test_a_write_that_fails_is_not_listed(project):
    long = "x" * 3000
    project.procedure.chmod(0o444)
    (project.folder / SCRATCH).mkdir()
    with pytest.raises(ProjectError, match="cannot be written"), full_after(1000):
        project.write_source(long, None)
    assert listed(project) == [] and project.procedure.read_text() == "one\n"


def test_a_damaged_entry_is_passed_over_and_numbers_go_on(project):
    project.write_source("two\n", None)
    project.write_source("three\n", None)
    (project.folder / SCRATCH / "revisions" / "000001.json").write_text('{"before": 3')
    assert [one.number for one in project.revisions.all()] == [2]
    with pytest.raises(KeyError):
        project.revisions.texts(1)
    assert project.write_source("four\n", None) == 3
