"""Programs in processes of their own, and the frames that they exchange."""

from __future__ import annotations

import io
import queue
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from shapewright.studio.wire.child import Child, read_frame, write_frame

PROGRAM = """
from shapewright.studio.wire.child import own_streams, read_frame, write_frame

requests, answers = own_streams()
print("to the terminal")
while frame := read_frame(requests):
    write_frame(answers, {"got": frame[0]}, frame[1] * 2)
"""


def test_a_program_answers_until_it_is_ended(tmp_path: Path) -> None:
    (tmp_path / "echo_program.py").write_text(PROGRAM)
    heard: queue.SimpleQueue[Any] = queue.SimpleQueue()
    path = f"{Path(__file__).parents[3] / 'src'}:{tmp_path}"
    child = Child("echo_program", heard.put, environment={"PYTHONPATH": path})
    child.send([1, "é"], b"abc")
    assert heard.get(timeout=60) == ({"got": [1, "é"]}, b"abcabc")
    assert child.end() == -15 and heard.get(timeout=10) is None
    child.send("lost")


def test_frames_carry_numbers_of_numpy_and_no_infinities() -> None:
    stream = io.BytesIO()
    write_frame(stream, {"a": np.float64(0.5), "b": float("nan")})
    whole = stream.getvalue()
    assert read_frame(io.BytesIO(whole)) == ({"a": 0.5, "b": None}, b"")
    for cut in (0, 5, len(whole) - 1):
        assert read_frame(io.BytesIO(whole[:cut])) is None
    with pytest.raises(TypeError, match="object has no form in JSON"):
        write_frame(stream, object())


STUBBORN = """
import signal
from shapewright.studio.wire.child import own_streams, read_frame, write_frame

requests, answers = own_streams()
signal.signal(signal.SIGTERM, lambda *_: None)
while frame := read_frame(requests):
    write_frame(answers, frame[0])
"""


@pytest.mark.parametrize("own_group", [True, False])
def test_a_program_that_does_not_end_when_it_is_told_to_is_killed(tmp_path: Path, own_group: bool) -> None:
    (tmp_path / "stubborn_program.py").write_text(STUBBORN)
    heard: queue.SimpleQueue[Any] = queue.SimpleQueue()
    path = f"{Path(__file__).parents[3] / 'src'}:{tmp_path}"
    child = Child("stubborn_program", heard.put, own_group=own_group, environment={"PYTHONPATH": path})
    child.send("there")
    assert heard.get(timeout=60) == ("there", b"")
    assert child.end() == -9
