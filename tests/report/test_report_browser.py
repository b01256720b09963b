"""The report in a headless Chromium, led with real clicks and keys by its debugging protocol over a pipe."""

from __future__ import annotations

import fcntl
import itertools
import json
import os
import select
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from test_page import EVIL, record, reference, saved, typical

from shapewright.report import write_report

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
pytestmark = pytest.mark.skipif(CHROMIUM is None, reason="no chromium, chromium-browser or google-chrome on PATH")
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--remote-debugging-pipe",
]
# The protocol is spoken on the descriptors 3 and 4: messages of JSON that end in a zero byte.
LAUNCH = (
    "import os, sys; os.dup2(int(sys.argv[1]), 3); os.dup2(int(sys.argv[2]), 4); os.execv(sys.argv[3], sys.argv[3:])"
)
KEYS = {"ArrowLeft": 37, "ArrowRight": 39, "Escape": 27, "Enter": 13}


def above_four(descriptors: tuple[int, int]) -> tuple[int, int]:
    """The same pipe under numbers that the protocol's do not overwrite."""
    first, second = (fcntl.fcntl(descriptor, fcntl.F_DUPFD_CLOEXEC, 5) for descriptor in descriptors)
    for descriptor in descriptors:
        os.close(descriptor)
    return first, second


class Browser:
    """One page of a Chromium of its own, and the errors and requests that the page caused."""

    def __init__(self, profile: Path) -> None:
        assert CHROMIUM
        there, self.output = above_four(os.pipe())
        self.input, back = above_four(os.pipe())
        launch = [sys.executable, "-c", LAUNCH, str(there), str(back)]
        self.process = subprocess.Popen(
            [*launch, CHROMIUM, *FLAGS, f"--user-data-dir={profile}", "about:blank"],
            pass_fds=(there, back),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(there)
        os.close(back)
        self.numbers = itertools.count(1)
        self.received = b""
        self.events: list[dict[str, Any]] = []
        self.session: str | None = None
        target = next(t for t in self.send("Target.getTargets")["targetInfos"] if t["type"] == "page")
        self.session = self.send("Target.attachToTarget", targetId=target["targetId"], flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log", "Network"):
            self.send(f"{domain}.enable")

    def close(self) -> None:
        self.session = None
        self.send("Browser.close")
        self.process.wait(20)
        os.close(self.output)
        os.close(self.input)

    def message(self) -> dict[str, Any]:
        while b"\0" not in self.received:
            assert select.select([self.input], [], [], 60)[0], "the browser does not answer"
            piece = os.read(self.input, 1 << 16)
            assert piece, "the browser has ended"
            self.received += piece
        first, self.received = self.received.split(b"\0", 1)
        message: dict[str, Any] = json.loads(first)
        return message

    def send(self, method: str, **params: Any) -> Any:
        request = {"id": next(self.numbers), "method": method, "params": params}
        if self.session:
            request["sessionId"] = self.session
        os.write(self.output, json.dumps(request).encode() + b"\0")
        while (answer := self.message()).get("id") != request["id"]:
            self.events.append(answer)
        assert "error" not in answer, answer
        return answer["result"]

    def open(self, path: Path, width: int = 1400) -> None:
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        self.events.clear()
        self.send("Page.navigate", url=path.as_uri())
        while not self.of("Page.loadEventFired"):
            self.events.append(self.message())

    def of(self, *methods: str) -> list[dict[str, Any]]:
        return [event["params"] for event in self.events if event.get("method") in methods]

    def trouble(self) -> list[Any]:
        """Errors on the console, and requests beyond the page itself and the pictures inside it."""
        self.send("Runtime.evaluate", expression="new Promise(done => setTimeout(done, 50))", awaitPromise=True)
        logged = [one for one in self.of("Runtime.consoleAPICalled") if one["type"] in ("error", "warning", "assert")]
        urls = [one["request"]["url"] for one in self.of("Network.requestWillBeSent")]
        fetched = [url for url in urls[1:] if not url.startswith("data:")]
        return [*logged, *self.of("Runtime.exceptionThrown", "Log.entryAdded"), *fetched]

    def ask(self, expression: str) -> Any:
        """The value of a JavaScript expression."""
        answer = self.send("Runtime.evaluate", expression=expression, returnByValue=True)
        assert "exceptionDetails" not in answer, answer
        return answer["result"].get("value")

    def text(self, selector: str) -> str:
        return str(self.ask(f"document.querySelector({json.dumps(selector)}).innerText"))

    def shown(self, selector: str) -> int:
        """How many of the elements are on the page and not folded away."""
        return int(
            self.ask(f"[...document.querySelectorAll({json.dumps(selector)})].filter(e => e.checkVisibility()).length")
        )

    def click(self, selector: str) -> None:
        """Press the mouse on the middle of an element."""
        x, y = self.ask(
            f"""(() => {{
                const element = document.querySelector({json.dumps(selector)});
                element.scrollIntoView({{ block: "center" }});
                const box = element.getBoundingClientRect();
                return [box.x + box.width / 2, box.y + box.height / 2];
            }})()"""
        )
        for kind in ("mousePressed", "mouseReleased"):
            self.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def press(self, key: str) -> None:
        code = {"key": key, "code": key, "windowsVirtualKeyCode": KEYS[key]}
        self.send("Input.dispatchKeyEvent", type="keyDown", **code, **({"text": "\r"} if key == "Enter" else {}))
        self.send("Input.dispatchKeyEvent", type="keyUp", **code)


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browser]:
    browser = Browser(tmp_path_factory.mktemp("profile"))
    yield browser
    browser.close()


@pytest.fixture
def report(tmp_path: Path) -> Path:
    before = record([reference("oak", 0.3, group=0), reference("elm", 0.1)])
    return write_report(saved(tmp_path / "003", typical()), saved(tmp_path / "002", before))


def test_trouble_is_noticed(browser: Browser, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    page.write_text("<img src='missing.png'><script>console.error('one'); nothing.at.all</script>")
    browser.open(page)
    trouble = json.dumps(browser.trouble())
    for part in ("missing.png", "one", "ReferenceError"):
        assert part in trouble


def test_opening_a_group_shows_its_members(browser: Browser, report: Path) -> None:
    browser.open(report)
    assert browser.shown(".members .pair") == 0
    assert browser.ask("document.querySelector('.members').offsetHeight") == 0
    top = browser.ask("document.querySelector('.group').getBoundingClientRect().top + scrollY")
    browser.click("[aria-controls=group-1]")
    assert browser.shown(".members .pair") == 2
    assert browser.text("[aria-controls=group-1]") == "Close"
    assert browser.ask("document.querySelector('.group').getBoundingClientRect().top + scrollY") == top
    browser.click("[aria-controls=group-1]")
    assert browser.shown(".members .pair") == 0
    assert browser.text("[aria-controls=group-1]") == "+2 more"
    assert browser.trouble() == []


def test_the_compatible_are_folded(browser: Browser, report: Path) -> None:
    browser.open(report)
    assert browser.shown("details .pair") == 0
    browser.click("details.panel summary")
    assert browser.shown("details .pair") == 2
    assert browser.trouble() == []


def test_a_pair_opens_large_and_the_keys_lead_through_all(browser: Browser, report: Path) -> None:
    browser.open(report)
    browser.click("#pair-0")
    assert browser.ask("viewer.open")
    assert browser.text("#viewer-name") == "fir"
    assert browser.text("#viewer-place") == "1 of 7"
    loaded = "[...viewer.querySelectorAll('img')].map(i => [i.naturalWidth, getComputedStyle(i).filter])"
    assert browser.ask(loaded) == [[64, "none"], [64, 'url("#t13")']]
    assert "Distance, incompatible\n0.250" in browser.text("#viewer-facts")
    assert browser.text("#viewer-values").split("\n")[-1] == "one (no effect)"
    assert browser.text("#viewer-values .flag") == "at its limit"
    link = browser.ask("viewer.querySelector('a').href")
    assert link == (report.parent / "replicas" / "fir.glb").as_uri()

    for key, name in (("ArrowRight", "elm"), ("ArrowLeft", "fir"), ("ArrowLeft", EVIL), ("ArrowRight", "fir")):
        browser.press(key)
        assert browser.ask("viewer.querySelector('h2').textContent") == name
    browser.press("Escape")
    assert not browser.ask("viewer.open")
    assert browser.ask("document.activeElement.id") == "pair-0"
    browser.press("ArrowRight")
    assert not browser.ask("viewer.open")
    browser.press("Enter")
    assert browser.ask("viewer.open")
    browser.click("[data-close]")
    assert not browser.ask("viewer.open")
    assert browser.trouble() == []


def test_a_reference_without_a_replica_shows_why(browser: Browser, report: Path) -> None:
    browser.open(report)
    browser.click("#pair-4")
    assert browser.text("#viewer-error") == "ValueError: the legs met"
    assert browser.shown("#viewer-error") == 1
    assert "Distance" not in browser.text("#viewer-facts")
    browser.press("ArrowRight")
    assert browser.shown("#viewer-error") == 0
    assert browser.trouble() == []


def test_changes_and_bars_lead_to_their_pair(browser: Browser, report: Path) -> None:
    browser.open(report)
    assert browser.ask("[...document.querySelectorAll('.small img')].map(i => i.naturalWidth)") == [64] * 4
    browser.click(".small .pair")
    assert browser.text("#viewer-name") == "oak"
    browser.press("Escape")
    browser.click(".strip rect")
    assert browser.text("#viewer-name") == "oak"
    assert browser.trouble() == []


def test_names_are_shown_to_the_letter(browser: Browser, report: Path) -> None:
    browser.open(report)
    browser.ask("show(pairs.length - 1)")
    assert browser.ask("viewer.querySelector('h2').textContent") == EVIL
    assert browser.ask("document.querySelector('details.panel').textContent").count(EVIL) == 1
    assert browser.ask("window.broken") is None
    assert browser.trouble() == []


@pytest.mark.parametrize("width", [1400, 500])
def test_many_references_fit_the_width(browser: Browser, tmp_path: Path, width: int) -> None:
    many = [reference(f"{i:03} {'long name ' * 12}", i / 300, group=i % 9 if i > 54 else None) for i in range(120)]
    for i, one in enumerate(many):
        one["slug"] = str(i)
    browser.open(write_report(saved(tmp_path / "001", record(many))), width)
    assert browser.ask("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    browser.ask("document.querySelectorAll('[aria-controls]').forEach(button => button.click())")
    browser.ask("document.querySelectorAll('details').forEach(details => details.open = true)")
    assert browser.shown(".pair") == 120
    assert browser.ask("document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    browser.ask("show(60)")
    assert browser.ask("viewer.firstElementChild.scrollWidth <= viewer.firstElementChild.clientWidth")
    assert browser.trouble() == []


def test_marking_a_pair_gives_the_command(browser: Browser, report: Path) -> None:
    browser.open(report)
    browser.click("#pair-0")
    assert browser.text("#viewer-command") == ""
    browser.click("[data-mark=different]")
    assert browser.text("#viewer-command") == f"shapewright mark {report.parent} -- fir different"
    browser.press("ArrowRight")
    assert browser.text("#viewer-command") == ""
    browser.ask("show(pairs.length - 1)")
    browser.click("[data-mark=same]")
    assert shlex.split(browser.ask("viewer.querySelector('code').textContent"))[4] == EVIL
    browser.press("Escape")
    browser.click("#pair-4")
    assert browser.shown("#viewer-marks") == 0
    assert browser.trouble() == []
