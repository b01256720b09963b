"""The commands about a run that is there."""

import json
import shutil

import pytest
from test_main import QUICK, SOURCE
from typer.testing import CliRunner

from shapewright.cli.main import app
from shapewright.modelling.solids import box
from shapewright.runs.folder import RunError
from shapewright.settings import Settings


def call(*arguments):
    """The last line of output as JSON; a failure is raised as it is."""
    result = CliRunner().invoke(app, [*map(str, arguments), "--json"])
    if result.exception and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout.splitlines()[-1])


@pytest.fixture(scope="module", autouse=True)
def _brief():
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("shapewright.feedback.causes.better_replicas.EVALUATIONS", 300)
        yield


@pytest.fixture(scope="module")
def fitted(tmp_path_factory):
    project = tmp_path_factory.mktemp("project")
    (project / "stool.py").write_text(SOURCE.format(body=""))
    (project / "references").mkdir()
    for i, size in enumerate([(1, 0.5, 1), (1, 2, 1), (0.2, 1, 3)]):
        mesh = box(size).mesh()
        lines = [f"v {x} {y} {z}" for x, y, z in mesh.vertices]
        lines += [f"f {a} {b} {c}" for a, b, c in mesh.faces + 1]
        (project / "references" / f"block {i}.obj").write_text("\n".join(lines))
    out = project / "runs" / "001"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("SHAPEWRIGHT_CACHE", str(project / "cache"))
        call("fit", project / "stool.py", project / "references", *QUICK, "--workers", 1, "--out", out)
        yield project


@pytest.fixture
def project(fitted, tmp_path):
    shutil.copytree(fitted, tmp_path / "project")
    return tmp_path / "project"


def test_explain_writes_the_run_and_its_report(project):
    run = project / "runs" / "001"
    record = call("explain", run, "--no-suggestions", "--workers", 1)
    on_disk = json.loads((run / "explanation.json").read_text())
    assert on_disk["references"] == record["references"] and on_disk["suggestions"] == []
    assert record["run"] == str(run) and record["report"] == str(run / "report.html")
    misfits = [name for name, each in record["references"].items() if each["causes"]]
    assert set(misfits) <= {"block 0", "block 1", "block 2"}
    assert misfits and 'class="badge"' in (run / "report.html").read_text()


def test_explain_uses_the_text_that_the_run_keeps_when_the_file_has_changed(project):
    run = project / "runs" / "001"
    record = json.loads((run / "iteration.json").read_text())
    record["procedure"]["path"] = str(project / "stool.py")
    (run / "iteration.json").write_text(json.dumps(record))
    (project / "stool.py").write_text("broken(")
    assert call("explain", run, "--no-suggestions", "--workers", 1)["references"]
    (run / "procedure.py").write_text("from elsewhere import table\n")
    with pytest.raises(RunError, match="cannot be loaded"):
        call("explain", run, "--no-suggestions")


def test_a_moved_collection_gets_a_clear_error(project):
    run = project / "runs" / "001"
    record = json.loads((run / "iteration.json").read_text())
    record["collection"]["origins"] = [str(project / "nowhere")]
    (run / "iteration.json").write_text(json.dumps(record))
    with pytest.raises(RunError, match="--references FOLDER"):
        call("explain", run, "--no-suggestions")
    (project / "references" / "block 2.obj").unlink()
    with pytest.raises(RunError, match=r"1 of its 3 references are not in .*references any more \(block 2\)"):
        call("explain", run, "--references", project / "references", "--no-suggestions")
    assert not (run / "explanation.json").exists()


def test_explain_needs_a_run(tmp_path):
    with pytest.raises(RunError, match="no run here"):
        call("explain", tmp_path)


def test_a_fit_keeps_its_run_when_the_explanation_fails(project, monkeypatch):
    def fail(*_, **__):
        raise KeyError("no such label")

    monkeypatch.setattr("shapewright.feedback.explanation.explain", fail)
    monkeypatch.setenv("SHAPEWRIGHT_CACHE", str(project / "cache"))
    run = project / "runs" / "002"
    arguments = (project / "stool.py", project / "references", *QUICK, "--workers", 1, "--out", run)
    with pytest.raises(
        RunError, match=rf"no such label(.|\n)*the run is whole in {run}(.|\n)*shapewright explain {run}"
    ):
        call("fit", *arguments, "--explain")
    assert (run / "iteration.json").is_file() and (run / "report.html").is_file()


def test_marks_move_the_cut_of_the_judge(project):
    run = project / "runs" / "001"
    entries = json.loads((run / "iteration.json").read_text())["references"]
    best = max(entries, key=lambda entry: entry["fidelity"])
    found = call("mark", run, best["name"], "different")
    assert found["marks"] == 1 and found["replicated"] >= max(min(best["fidelity"], 0.99), Settings.replicated)
    assert json.loads((project / "marks.json").read_text())[0]["measures"]["fidelity"] == best["fidelity"]
    arguments = (project / "stool.py", project / "references", *QUICK, "--workers", 1, "--marks", "--out")
    call("fit", *arguments, project / "runs" / "002")
    settings = json.loads((project / "runs" / "002" / "iteration.json").read_text())["settings"]
    assert settings["replicated"] == pytest.approx(found["replicated"]) and settings["threshold"] == 0.18
    call("fit", *arguments, project / "runs" / "003", "--judge", "paper")
    settings = json.loads((project / "runs" / "003" / "iteration.json").read_text())["settings"]
    assert settings["threshold"] == pytest.approx(found["threshold"]) and settings["replicated"] == Settings.replicated


def test_fit_with_marks_needs_marks(project):
    arguments = (project / "stool.py", project / "references", *QUICK)
    with pytest.raises(RunError, match="no marks yet"):
        call("fit", *arguments, "--marks", "--out", project / "runs" / "002")
