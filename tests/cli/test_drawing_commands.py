import json
from pathlib import Path

import pytest
import trimesh
from typer.testing import CliRunner

from shapewright.cli.main import app
from shapewright.demo import drawings

V1 = Path(__file__).resolve().parents[2] / "examples" / "drawings" / "v1.py"


def run(*arguments):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exit_code == 0, result.output
    return json.loads(result.stdout.splitlines()[-1])


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Runs of the first version on a few bundled drawings: as by default, and by the paper, strictly and leniently."""
    folder = tmp_path_factory.mktemp("runs")
    for path in drawings.write(folder / "all")[:4]:
        (folder / "few").mkdir(exist_ok=True)
        path.rename(folder / "few" / path.name)
    (folder / "few" / "broken.png").write_bytes(b"nothing")
    settings = ("--samples", 200, "--epochs", 2, "--refine", "off", "--workers", 1, "--json")
    paper = ("--judge", "paper", *settings)
    found = run("fit", V1, folder / "few", "--out", folder / "001", *settings)
    run("fit", V1, folder / "few", "--out", folder / "002", "--from", folder / "001", "--vif", 0.9, *paper)
    run("fit", V1, folder / "few", "--out", folder / "003", "--from", folder / "001", "--vif", 0.002, *paper)
    return folder, found


def test_fit_says_by_what_drawings_are_judged(runs):
    _, found = runs
    assert found["references"] == 4 and found["metric"]["name"] == "1 - VIF"
    assert [Path(path).name for path in found["skipped"]] == ["broken.png"]
    assert all(result["compatible"] == (result["distance"] <= 0.95) for result in found["results"].values())


def test_report_and_compare(runs):
    folder, _ = runs
    page = Path(run("report", folder / "002", "--json")["report"]).read_text()
    assert "visual information fidelity at least 0.9" in page
    moves = run("compare", folder / "003", folder / "002", "--json")
    assert not moves["gained"] and moves["lost"]


def test_samples_are_written_as_svg(tmp_path):
    written = run("sample", V1, "-n", 3, "--out", tmp_path / "samples", "--workers", 1, "--json")
    assert written["shapes"] == 3 and len(list((tmp_path / "samples").glob("*.svg"))) == 3


def test_silhouettes(tmp_path):
    trimesh.creation.box((1, 2, 3)).export(tmp_path / "box.ply")
    (tmp_path / "broken.obj").write_text("v 0 0 0\n")
    written = run("silhouettes", tmp_path, "--out", tmp_path / "out", "--view", "side", "--json")
    assert written["drawings"] == 1 and len(written["skipped"]) == 1
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["box.svg"]
    assert CliRunner().invoke(app, ["silhouettes", str(tmp_path / "out"), "--out", str(tmp_path / "2")]).exit_code
