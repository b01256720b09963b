"""A program of another environment that stays beside this process and answers its requests, one after another."""

from __future__ import annotations

import contextlib
import json
import os
import struct
import subprocess
import tempfile
import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import IO, Any

import numpy as np

from shapewright.processes.external import Ended, allow, last_lines
from shapewright.processes.worker import START_SECONDS

HELLO = b"\0shapewright\0"
"""What the program writes before its first answer. What stands before that is not its own."""

_TO_END = 2.0
"""Seconds that a program that has closed its output may take to end."""


class Gone(Exception):
    """The program ended without an answer."""

    def __init__(self, ended: Ended) -> None:
        super().__init__(ended)
        self.ended = ended


@dataclass(frozen=True)
class Answer:
    """What the program answered.

    Attributes:
        header: plain values.
        arrays: by name.
    """

    header: Mapping[str, Any]
    arrays: Mapping[str, np.ndarray[Any, Any]]


class Resident:
    """A program that reads requests from its standard input: four bytes with the length, big endian, then JSON.

    It answers in the same form on standard output; its JSON lists arrays, (name, kind, form), which follow.

    Attributes:
        first: its answer to the request with which it was started.
    """

    def __init__(self, words: Sequence[str], request: Mapping[str, Any]) -> None:
        """Start it, and wait for its first answer. Raises Gone; OSError where it cannot be started."""
        self._lock = threading.RLock()  # a request that fails stops the program itself
        self._said = tempfile.TemporaryFile(mode="a+b")  # noqa: SIM115 - closed with the program
        try:
            self._process = subprocess.Popen(
                list(words),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self._said,
                bufsize=0,
                preexec_fn=partial(allow, None) if os.name == "posix" else None,  # its own limit comes with a request
            )
        except BaseException:
            self._said.close()
            raise
        assert self._process.stdin and self._process.stdout
        self._to: IO[bytes] = self._process.stdin
        self._from: IO[bytes] = self._process.stdout
        hurry = threading.Timer(START_SECONDS, self._process.kill)
        hurry.start()
        try:
            self.first = self.ask(request, begins=True)
        finally:
            hurry.cancel()

    @property
    def alive(self) -> bool:
        return self._process.poll() is None

    def ask(self, request: Mapping[str, Any], begins: bool = False) -> Answer:
        """Raises Gone when the program ends instead. Whatever else ends the wait ends the program.

        begins: whether it still has to say hello.
        """
        with self._lock:
            try:
                text = json.dumps(request).encode()
                self._to.write(struct.pack(">I", len(text)) + text)
                if begins:
                    self._await_hello()
                header = json.loads(self._read(struct.unpack(">I", self._read(4))[0]))
                arrays = {name: self._array(kind, form) for name, kind, form in header.pop("arrays")}
                self._said.truncate(0)
                return Answer(header, arrays)
            except (EOFError, OSError) as error:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    self._process.wait(_TO_END)  # so that its own status is known
                self._end()
                said = last_lines(self._said)
                self.stop()
                raise Gone(Ended(self._process.returncode, said)) from error
            except BaseException:
                self.stop()
                raise

    def stop(self) -> None:
        """End it at once; a thread that waits for its answer gets Gone."""
        self._end()
        with self._lock:
            self._said.close()

    def _end(self) -> None:
        self._process.kill()
        self._process.wait()
        self._to.close()
        self._from.close()

    def _await_hello(self) -> None:
        heard = b""
        while not heard.endswith(HELLO):
            heard = heard[-len(HELLO) :] + self._read(1)

    def _array(self, kind: str, form: Sequence[int]) -> np.ndarray[Any, Any]:
        numbers = np.dtype(kind)
        size = int(np.prod(form)) * numbers.itemsize
        return np.frombuffer(self._read(size), numbers).reshape(form)

    def _read(self, size: int) -> bytearray:
        """Exactly so many bytes. Raises EOFError."""
        content = bytearray()
        while len(content) < size:
            piece = self._from.read(size - len(content))
            if not piece:
                raise EOFError
            content += piece
        return content


STARTING = Resident.__init__.__code__
"""The code that waits for such a program to start."""
