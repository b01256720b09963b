"""What the stages of work took is kept, whatever the file says."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from shapewright.studio.project.timings import Timings, Took
from shapewright.studio.project.workspace import SCRATCH, Project
from shapewright.studio.wire.work import JobStage
from studio_client import PROCEDURE


@pytest.fixture
def project(tmp_path: Path) -> Project:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    return Project.of(tmp_path)


def stage(name: str, seconds: float, total: int) -> JobStage:
    return JobStage(name=name, done=total, total=total, remark="", seconds=seconds)


def test_stages_last_over_a_restart_and_those_that_come_again_are_one(project: Project) -> None:
    assert Timings(project).of("fit") == {}
    Timings(project).note(
        "fit", [stage("open", 3, 3), stage("sample", 2, 200), stage("train", 5, 10), stage("sample", 1, 100)]
    )
    assert Timings(project).of("fit") == {"open": Took(3, 3), "sample": Took(3, 300), "train": Took(5, 10)}
    assert Timings(project).of("sweep") == {}


def test_a_run_of_the_command_line_tells_of_a_fit(project: Project) -> None:
    run = project.folder / "runs" / "001"
    run.mkdir(parents=True)
    (run / "iteration.json").write_text(json.dumps({"format": 1, "seconds": {"sample": 2.5}, "references": []}))
    assert Timings(project).of("fit").keys() <= {"sample"}
    assert Timings(project).of("explain") == {}


@pytest.mark.parametrize(
    "entry", ["1", '{"a": 1}', '{"a": [1e999, 2]}', '{"a": [NaN, 2]}', '{"a": ["x", 2]}', '{"a": [-4, 2]}']
)
@pytest.mark.parametrize("text", ["", "[]", "{", "\x00", '{"fit": ENTRY}'])
def test_a_file_that_says_something_else_says_nothing(project: Project, text: str, entry: str) -> None:
    (project.folder / SCRATCH).mkdir()
    (project.folder / SCRATCH / "timings.json").write_text(text.replace("ENTRY", entry))
    assert Timings(project).of("fit") == {}


def test_a_folder_that_is_a_link_is_not_written_to(project: Project, tmp_path_factory: pytest.TempPathFactory) -> None:
    outside = tmp_path_factory.mktemp("outside")
    (project.folder / SCRATCH).symlink_to(outside)
    timings = Timings(project)
    timings.note("export", [stage("replicas", 1, 5)])
    assert timings.of("export") == {"replicas": Took(1, 5)} and not list(outside.iterdir())
