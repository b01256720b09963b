"""A studio in a process of its own, and a client of it, for the tests."""

from __future__ import annotations

import contextlib
import hashlib
import http.client
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from websockets.sync.client import ClientConnection, connect

from shapewright.studio.wire.answers import parse

PROCEDURE = """
from typing import Annotated

from shapewright import Range, When, procedure
from shapewright.modelling.solids import box


@procedure
def table(
    height: Annotated[float, Range(0.3, 1.2)] = 0.6,
    leg: Annotated[float, Range(0.05, 0.2, steps=4)] = 0.1,
    shelf: bool = False,
    shelf_height: Annotated[float, Range(0.1, 0.2, when=lambda p: p.shelf)] = 0.15,
):
    top = box((1.0, 0.08, 0.7), at=(0, height, 0)).label("top")
    post = box((leg, height, leg), at=(0.4, height / 2, 0.28)).label("legs")
    legs = post.mirror("x", keep=True).mirror("z", keep=True)
    return top | legs | box((0.8, 0.04, 0.6), at=(0, shelf_height, 0)).label("shelf") if shelf else top | legs
"""


@dataclass
class Studio:
    """One that runs. messages: all texts and binaries that its WebSocket sent so far."""

    folder: Path
    process: subprocess.Popen[str]
    port: int
    token: str
    messages: list[dict[str, Any]] = field(default_factory=list)
    socket: ClientConnection | None = None
    stack: contextlib.ExitStack = field(default_factory=contextlib.ExitStack)

    def request(
        self, method: str, path: str, body: Any = None, headers: dict[str, str] | None = None, raw: bytes | None = None
    ) -> tuple[int, bytes, dict[str, str]]:
        """Status, body and headers of an answer; with the token unless other headers are given."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=30)
        given = self.headers if headers is None else headers
        data = raw if raw is not None else None if body is None else json.dumps(body).encode()
        connection.request(method, path, data, given)
        answer = connection.getresponse()
        found = answer.status, answer.read(), {name.lower(): value for name, value in answer.getheaders()}
        connection.close()
        return found

    def get(self, path: str) -> Any:
        status, body, _ = self.request("GET", path)
        assert status == 200, body
        return json.loads(body)

    def get_run(self, name: str) -> Any:
        """The record of a run."""
        return json.loads((self.folder / "runs" / name / "iteration.json").read_text())

    def send(self, method: str, path: str, body: Any, status: int = 200) -> Any:
        found, answer, _ = self.request(method, path, body)
        assert found == status, answer
        return json.loads(answer)

    @property
    def headers(self) -> dict[str, str]:
        return {"Authorization": f"Bearer {self.token}"}

    def listen(self) -> dict[str, Any]:
        """Open the WebSocket; returns the state."""
        address = f"ws://127.0.0.1:{self.port}/api/live"
        limits: dict[str, Any] = {"max_size": None, "max_queue": None}  # a test may not listen for a long while
        self.socket = self.stack.enter_context(connect(address, additional_headers=self.headers, **limits))
        return self.next(lambda message: message["type"] == "state", 10)

    def next(self, wanted: Callable[[dict[str, Any]], bool], seconds: float = 60) -> dict[str, Any]:
        """The next message that is wanted; a binary one has its arrays under ``arrays``."""
        assert self.socket is not None
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            with contextlib.suppress(TimeoutError):
                got = self.socket.recv(timeout=left)
                if isinstance(got, bytes):
                    header, arrays = parse(got)
                    message = {**header, "arrays": arrays}
                else:
                    message = json.loads(got)
                self.messages.append(message)
                if wanted(message):
                    return message
        told = [(m["type"], m.get("error")) for m in self.messages[-20:]]
        raise AssertionError(f"no such message within {seconds} s; the last were {told}")

    def wait_for(self, wanted: Callable[[dict[str, Any]], bool], seconds: float = 60) -> dict[str, Any]:
        """The state as soon as it is as wanted."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            state: dict[str, Any] = self.get("/api/state")
            if wanted(state):
                return state
            time.sleep(0.05)
        raise AssertionError(f"the state did not come within {seconds} s: {json.dumps(state)[:3000]}")

    def say(self, **message: Any) -> None:
        assert self.socket is not None
        self.socket.send(json.dumps(message))

    def save(self, text: str, name: str = "procedure.py") -> None:
        """As an editor does: another file takes the place of the old one."""
        partial = self.folder / f".{name}.swp"
        partial.write_text(text)
        partial.replace(self.folder / name)

    def edit(self, text: str, outcome: str = "good") -> dict[str, Any]:
        """Save the procedure; the state as soon as that is read."""
        self.save(text)
        digest = hashlib.sha256(text.encode()).hexdigest()[:16]
        return self.wait_for(lambda s: (s["procedure"]["digest"], s["procedure"]["state"]) == (digest, outcome))


def ready(state: dict[str, Any]) -> bool:
    return bool(state["bench"] == "ready" and state["procedure"]["state"] == "good")


@contextlib.contextmanager
def studio(folder: Path, *options: str) -> Iterator[Studio]:
    """Start a studio of a folder; it is ended at the end."""
    command = [sys.executable, "-m", "shapewright", "studio", str(folder), "--no-browser", *options]
    environment = {**os.environ, "SHAPEWRIGHT_CACHE": str(folder / "cache")}
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment)
    try:
        assert process.stdout is not None
        address = urlsplit(process.stdout.readline().strip())
        assert address.port, "the studio printed no address"
        started = Studio(folder, process, address.port, parse_qs(address.query)["token"][0])
        with started.stack:
            yield started
    finally:
        process.send_signal(signal.SIGTERM)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(timeout=15)
        process.kill()
        process.wait()
