"""An export: one ZIP, whole or not at all."""

import io
import json
import zipfile

import numpy as np
import pytest
import trimesh

from broken_disk import full_after, killed
from shapewright.modelling.solids import box
from shapewright.shapes.files import encode
from shapewright.studio.jobs.events import Reporter
from shapewright.studio.jobs.export_job import pack
from shapewright.studio.project.listing import Origin


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


def test_replicas_lie_over_their_references_files_where_that_is_wished(tmp_path, request_):
    run, references = tmp_path / "runs" / "001", tmp_path / "references"
    (run / "replicas").mkdir()
    references.mkdir()
    made = box((2, 4, 1)).label("seat").mesh()
    (run / "replicas" / "a.glb").write_bytes(encode(made))
    entry = {"name": "a", "slug": "a", "replica": "replicas/a.glb", "parameters": {}}
    (run / "iteration.json").write_text(json.dumps({"format": 1, "procedure": {"name": "s"}, "references": [entry]}))
    # In the file z is up, the front looks to -y, and the shape stands somewhere else, a hundred times as large.
    trimesh.creation.box((200, 100, 400)).apply_translation((1000, 50, 7)).export(references / "a.stl")
    order = {**request_, "what": ["replicas"], "format": "obj", "frame": "reference"}
    file = pack({**order, "origin": vars(Origin(str(references), up="z"))}, Reporter(io.BytesIO()))
    text = zipfile.ZipFile(file).read("replicas/a.obj").decode()
    corners = np.array([line.split()[1:] for line in text.splitlines() if line.startswith("v ")], dtype=float)
    np.testing.assert_allclose(corners.min(axis=0), (900, 0, -193), atol=1e-3)
    np.testing.assert_allclose(corners.max(axis=0), (1100, 100, 207), atol=1e-3)
    assert "g seat" in text


def test_an_export_is_whole_or_not_there(tmp_path, request_):
    with pytest.raises(OSError, match="File too large"), full_after(100):
        pack(request_, Reporter(io.BytesIO()))
    assert not list((tmp_path / "scratch").iterdir())
    killed(lambda: pack(request_, Reporter(io.BytesIO())))
    assert not list((tmp_path / "scratch").glob("*.zip"))
    file = pack(request_, Reporter(io.BytesIO()))
    assert zipfile.ZipFile(file).namelist() == ["report.html"]
