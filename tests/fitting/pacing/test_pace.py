import shapewright as sw
from shapewright.building import Workers
from shapewright.fitting.pacing import opening
from shapewright.fitting.pacing.opening import PROBES
from shapewright.fitting.pacing.pace import paced
from shapewright.fitting.pacing.stock import Stock
from shapewright.fitting.start import Start
from shapewright.modelling.solids import box
from shapewright.progress import Stages

SOURCE = """
import time
from typing import Annotated
from shapewright import Range, procedure
from shapewright.modelling.solids import box

@procedure
def block(height: Annotated[float, Range(0.2, 1.0)] = 0.5, depth: Annotated[float, Range(0.2, 1.0)] = 0.5):
    time.sleep({seconds})
    return box((1.0, height, depth))
"""


def slow(tmp_path, seconds):
    path = tmp_path / "block.py"
    path.write_text(SOURCE.format(seconds=seconds))
    return sw.load_procedure(path)


def begun(procedure, settings, told, start=None):
    stages = Stages(told.append)
    with Workers.of(procedure, settings) as crew:
        stock = Stock(crew)
        return paced(stock, settings, stages, start), stock


def notices(told):
    return [event.notice for event in told if event.notice]


def test_what_samples_take_is_told_before_they_are_built_and_the_bar_moves_from_the_first(tmp_path, monkeypatch):
    monkeypatch.setattr(opening, "_PATIENCE", 1000.0)  # a busy machine tells that it waits as well
    told = []
    settings = sw.Settings(workers=1)
    same, _ = begun(slow(tmp_path, 0.1), settings, told)
    (notice,) = notices(told)
    assert same == settings and notice.kind == "pace"
    assert notice.text.startswith("one shape takes 0.") and "3,000 samples take about" in notice.text
    assert "on 1 core" in notice.text and "; 500 take" in notice.text and notice.text in map(str, told)
    assert {event.done for event in told if event.stage == "sample"} & set(range(1, PROBES))


def test_a_quick_procedure_is_told_nothing(tmp_path):
    told = []
    begun(slow(tmp_path, 0.0), sw.Settings(workers=1), told)
    assert notices(told) == []


def test_a_word_comes_before_the_first_shape_is_there(tmp_path, monkeypatch):
    monkeypatch.setattr(opening, "_PATIENCE", 0.05)
    told = []
    begun(slow(tmp_path, 0.6), sw.Settings(workers=1), told)
    first = notices(told)[0]
    assert (
        first.text.startswith("no shape is built after ") and "if each takes as long, 3,000 samples take" in first.text
    )
    assert [notice.text.partition(" take")[0] for notice in notices(told)[1:]] == ["one shape"]
    assert next(event for event in told if event.notice).done == 0


def test_a_limit_of_time_becomes_numbers_and_the_first_shapes_are_samples(tmp_path):
    told = []
    settings = sw.Settings(workers=1, within=20.0)
    start = Start.of(sw.Collection.of({"one": box((1, 0.5, 0.5)).mesh()}), slow(tmp_path, 0.1).space, None)
    found, stock = begun(slow(tmp_path, 0.1), settings, told, start)
    assert found.within is None and 20 <= found.samples < 200 and found.refine_shapes >= 1
    (notice,) = notices(told)
    assert notice.kind == "within" and notice.text.endswith("fit in 20 s") and f"{found.samples} samples" in notice.text
    assert len(stock._built) == PROBES
