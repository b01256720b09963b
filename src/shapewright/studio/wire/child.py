"""A program of the studio in a process of its own: bench, builder and jobs are started, spoken with and ended here.

Both sides exchange frames over the program's standard streams: a message as JSON, and bytes that go with it.
"""

from __future__ import annotations

import asyncio
import contextlib
import io
import os
import queue
import signal
import struct
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Mapping
from typing import IO, Any, BinaryIO

import msgspec

from shapewright.studio.wire.printed import Printed
from shapewright.studio.wire.values import encode

Frame = tuple[Any, bytes]
"""A message and its payload."""
_TO_END = 0.5
"""Seconds that a program may take to end what it runs itself."""
_STEP = 0.01
_KILL = getattr(signal, "SIGKILL", signal.SIGTERM)  # Windows has only the latter, which kills
_LENGTHS = struct.Struct("<II")


class Child:
    """A Python program that runs beside this process.

    module: the module that it runs.
    heard: called in another thread with every frame that it sends, and with None when it has ended.
    messages: the type of the messages that it sends.
    own_group: whether it leads a process group, with which it is ended.
    environment: variables that it gets besides those of this process.
    printed: takes what it prints; without it that goes where this process prints its errors.
    """

    def __init__(
        self,
        module: str,
        heard: Callable[[Frame | None], object],
        messages: Any = Any,
        own_group: bool = True,
        environment: Mapping[str, str] | None = None,
        printed: Printed | None = None,
    ) -> None:
        self._leads = own_group and os.name == "posix"
        self.process = subprocess.Popen(
            [sys.executable, "-P", "-m", module],  # -P: a random.py of the author in the working folder is not Python's
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=printed.stream if printed else None,
            env={**os.environ, **(environment or {})},
            start_new_session=self._leads,
        )
        self._outgoing: queue.SimpleQueue[Frame | None] = queue.SimpleQueue()
        for work in (lambda: self._listen(heard, messages), self._speak):
            threading.Thread(target=work, daemon=True).start()

    def send(self, message: Any, payload: bytes = b"") -> None:
        """Send a frame, without waiting until it arrives; it is lost when the program has ended."""
        self._outgoing.put((message, payload))

    def end(self) -> int:
        """End the program, and what it started in its group, at once; returns the exit status.

        Programs of others that these run have groups of their own. Told to end, these end them.
        """
        with contextlib.suppress(ProcessLookupError, PermissionError):
            self._signal(signal.SIGTERM)
            deadline = time.monotonic() + _TO_END
            while time.monotonic() < deadline:
                self.process.poll()
                self._signal(0)  # raises where none is left
                time.sleep(_STEP)
            self._signal(_KILL)
        self._outgoing.put(None)
        return self.process.wait()

    def _signal(self, number: int) -> None:
        if self._leads:
            os.killpg(self.process.pid, number)
        elif self.process.poll() is None:
            self.process.send_signal(number)
        else:
            raise ProcessLookupError

    def _listen(self, heard: Callable[[Frame | None], object], messages: Any) -> None:
        assert self.process.stdout is not None
        with self.process.stdout as stream:
            while frame := read_frame(stream, messages):
                heard(frame)
        heard(None)

    def _speak(self) -> None:
        assert self.process.stdin is not None
        with contextlib.suppress(OSError), self.process.stdin as stream:
            while frame := self._outgoing.get():
                write_frame(stream, *frame)


def on_this_loop(heard: Callable[[Frame | None], object]) -> Callable[[Frame | None], object]:
    """Call a function in the event loop that runs now, from any thread."""
    loop = asyncio.get_running_loop()

    def pass_on(frame: Frame | None) -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended
            loop.call_soon_threadsafe(heard, frame)

    return pass_on


def own_streams() -> tuple[BinaryIO, BinaryIO]:
    """For the program: the streams on which frames come and go.

    What anything else prints goes to standard error, and what it reads is empty.
    """
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(line_buffering=True)  # what was printed before a crash is not lost
    return requests, answers


def write_frame(stream: IO[bytes], message: Any, payload: bytes = b"") -> None:
    """Write one frame."""
    text = encode(message)
    stream.write(_LENGTHS.pack(len(text), len(payload)) + text + payload)
    stream.flush()


def read_frame(stream: IO[bytes], messages: Any = Any) -> Frame | None:
    """The next frame; None at the end of the stream, also where that breaks a frame off.

    messages: the type of its message. Raises msgspec.ValidationError for another.
    """
    start = stream.read(_LENGTHS.size)
    if len(start) < _LENGTHS.size:
        return None
    text, payload = (stream.read(length) for length in _LENGTHS.unpack(start))
    try:
        return msgspec.json.decode(text, type=messages), payload
    except msgspec.ValidationError:
        raise
    except msgspec.DecodeError:
        return None
