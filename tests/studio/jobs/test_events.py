import io

from shapewright.progress import Notice, Stages
from shapewright.studio.jobs.events import Reporter
from shapewright.studio.wire.child import read_frame


def remarks(work):
    """By stage, the last remark that a page gets of it."""
    stream = io.BytesIO()
    stages = Stages(Reporter(stream).progress)
    work(stages)
    stages.end()
    stream.seek(0)
    last = {}
    while frame := read_frame(stream):
        last[frame[0]["stage"]] = frame[0].get("remark", "")
    return last


def test_what_is_told_once_stays_beside_its_stage():
    def work(stages):
        stages.begin("sample", 3000)
        stages.tell(Notice("pace", "one shape takes 1 s."))
        stages.tell(Notice("stochastic", "it draws."))
        stages.step(3000, 3000)
        stages.begin("train", 2)
        stages.step(2, 2, "validation loss 0.1")

    assert remarks(work) == {"sample": "one shape takes 1 s. it draws.", "train": "validation loss 0.1"}
