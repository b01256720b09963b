"""The studio's fit: one that was cancelled, or died, goes on when the same is fitted again."""

from dataclasses import asdict
from functools import partial

import pytest

import shapewright as sw
from shapewright.fitting.keeping import unfinished
from shapewright.runs.iteration import Iteration
from shapewright.shapes.files import encode
from shapewright.studio.jobs import fit_job
from shapewright.studio.project.listing import Origin

STOOL = """
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def stool(height: Annotated[float, Range(0.3, 1.0)] = 0.6):
    return box((1, 0.1, 1), at=(0, height, 0)) | box((0.15, height, 0.15), at=(0, height / 2, 0))
"""


class Told:
    """A reporter that notes what it is told, and ends the job where a stage begins."""

    def __init__(self, until=None):
        self.until, self.heard = until, []

    def progress(self, event):
        self.heard.append(event)
        if event.stage == self.until:
            raise KeyboardInterrupt

    def stage(self, *_):
        pass

    def opens(self, *_):
        pass


def test_a_fit_that_was_cancelled_goes_on(tmp_path, monkeypatch):
    monkeypatch.setattr(unfinished, "Unfinished", partial(unfinished.Unfinished, least=0.0))
    (tmp_path / "procedure.py").write_text(STOOL)
    (tmp_path / "references").mkdir()
    stool = sw.load_procedure(tmp_path / "procedure.py")
    for i in range(3):
        (tmp_path / "references" / f"stool{i}.glb").write_bytes(encode(stool(height=0.4 + 0.2 * i)))
    settings = sw.Settings(seed=1, samples=40, epochs=1, image_size=32, workers=1, refine_shapes=8)
    request = {
        "procedure": str(tmp_path / "procedure.py"),
        "origin": asdict(Origin(str(tmp_path / "references"))),
        "settings": settings.record(),
        "runs": str(tmp_path / "runs"),
        "previous": None,
    }
    first, second = Told(until="compare"), Told()
    with pytest.raises(KeyboardInterrupt):
        fit_job.fit(request, first)
    kept = {path.name for path in (tmp_path / "runs" / unfinished.UNFINISHED).glob("*/*")}
    assert {"network0", "search0-000000-000003"} <= kept
    result = fit_job.fit(request, second)
    assert "going on" in [event.notice.kind for event in second.heard if event.notice]
    assert any(event.stage == "train" and event.losses for event in first.heard)
    assert not any(event.losses for event in second.heard)
    assert len(Iteration.load(tmp_path / "runs" / result.run)) == 3
    assert not (tmp_path / "runs" / unfinished.UNFINISHED).exists()
