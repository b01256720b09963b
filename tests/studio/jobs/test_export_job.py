"""An export: one ZIP, whole or not at all."""

import io
import json
import zipfile

import pytest

from broken_disk import full_after, killed
from shapewright.modelling.solids import box
from shapewright.shapes.files import encode
from shapewright.studio.jobs.events import Reporter
from shapewright.studio.jobs.export_job import pack


@pytest.fixture
def request_(tmp_path):
    run = tmp_path / "runs" / "001"
    run.mkdir(parents=True)
    (run / "report.html").write_bytes(bytes(range(256)))
    (run / "iteration.json").write_text(json.dumps({"format": 1, "references": []}))
    return {
        "folder": str(tmp_path / "scratch"),
        "run": str(run),
        "procedure": str(tmp_path / "procedure.py"),
        "what": ["report"],
        "format": "glb",
    }


def test_replicas_keep_their_labels_in_another_format(tmp_path, request_):
    run = tmp_path / "runs" / "001"
    (run / "replicas").mkdir()
    (run / "replicas" / "a.glb").write_bytes(encode((box(1).label("seat") | box(1, at=(2, 0, 0))).mesh()))
    entry = {"name": "a", "slug": "a", "replica": "replicas/a.glb", "parameters": {"height": 1.0}}
    record = {"format": 1, "procedure": {"name": "stool"}, "references": [entry, {"replica": None}]}
    (run / "iteration.json").write_text(json.dumps(record))
    file = pack({**request_, "what": ["replicas"], "format": "ply"}, Reporter(io.BytesIO()))
    data = zipfile.ZipFile(file).read("replicas/a.ply")
    assert b"comment label 0 seat\n" in data and b"element vertex 16\n" in data and b'"reference":"a"' in data


def test_an_export_is_whole_or_not_there(tmp_path, request_):
    with pytest.raises(OSError, match="File too large"), full_after(100):
        pack(request_, Reporter(io.BytesIO()))
    assert not list((tmp_path / "scratch").iterdir())
    killed(lambda: pack(request_, Reporter(io.BytesIO())))
    assert not list((tmp_path / "scratch").glob("*.zip"))
    file = pack(request_, Reporter(io.BytesIO()))
    assert zipfile.ZipFile(file).namelist() == ["report.html"]
