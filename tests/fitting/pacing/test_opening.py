import os
from dataclasses import replace

import pytest

import shapewright as sw
from shapewright.fitting.pacing import opening
from shapewright.fitting.pacing.opening import PROBES, Opening, lasting
from shapewright.modelling.solids import box
from shapewright.procedures import ProcedureError

SOURCE = """
import os, time
from pathlib import Path
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def block(height: Annotated[float, Range(0.2, 1.0)] = 0.5, depth: Annotated[float, Range(0.2, 1.0)] = 0.5):
    {body}
    return box((1.0, height, depth))
"""
SETTINGS = sw.Settings(samples=60, epochs=2, image_size=32, workers=2)


def written(folder, body):
    path = folder / "block.py"
    path.write_text(SOURCE.format(body=body))
    return sw.load_procedure(path)


def ended(process):
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    return False


def test_a_fit_that_was_opened_gives_the_same_result_and_records_what_was_told(tmp_path, monkeypatch):
    monkeypatch.setattr(opening, "_SLOW", 0.0)
    block, told = written(tmp_path, "time.sleep(0.01)"), []
    references = sw.Collection.of({"one": box((1, 0.4, 0.8)), "two": box((1, 0.9, 0.3))})
    plain = sw.fit(block, references, SETTINGS)
    with Opening(block, SETTINGS, told.append) as begun:
        begun.wait()
        assert "pace" in [event.notice.kind for event in told if event.notice]
        opened = sw.fit(block, references, SETTINGS, opening=begun)
        assert len(begun.crew.costs) >= SETTINGS.samples
    kinds = [notice["kind"] for notice in opened.metrics["notices"]]
    assert kinds == ["pace"], "the cost is not told again"
    assert [(r.name, r.parameters, r.fidelity) for r in plain] == [(r.name, r.parameters, r.fidelity) for r in opened]


def test_the_first_samples_are_those_that_a_fit_asks_for(tmp_path):
    block = written(tmp_path, "pass")
    for resumed, count in ((False, 60), (True, 20)):
        with Opening(block, replace(SETTINGS, warm_samples=20), resumed=resumed) as begun:
            assert [build.parameters for build in begun.builds()] == block.space.sample(count, seed=0)[:PROBES]


def test_a_broken_procedure_is_told_to_whoever_asks_for_the_samples(tmp_path):
    with Opening(written(tmp_path, "raise ValueError('no solid')"), SETTINGS) as begun:
        begun.wait()
        with pytest.raises(ProcedureError, match="every one of the first 8 shapes failed"):
            begun.builds()


def test_the_processes_end_with_the_block_though_a_shape_is_not_done(tmp_path):
    marks = tmp_path / "marks"
    marks.mkdir()
    body = f"Path({str(marks)!r}, str(os.getpid())).touch(); time.sleep(60)"
    with Opening(written(tmp_path, body), SETTINGS) as begun:
        begun.wait()  # until it is told that no shape is there
        processes = [int(path.name) for path in marks.iterdir()]
    assert processes and all(map(ended, processes))


@pytest.mark.parametrize(
    ("seconds", "words"), [(0.254, "0.25 s"), (1.0, "1 s"), (44.6, "45 s"), (480.0, "8 min"), (5760.0, "1.6 h")]
)
def test_a_time_in_words(seconds, words):
    assert lasting(seconds) == words
