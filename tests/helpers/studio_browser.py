"""A headless Chromium on the studio's page, which notes every error and every request beyond the studio itself."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import shapewright.studio
from studio_client import Studio

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
PAGE = Path(shapewright.studio.__file__).with_name("page") / "index.html"
# WebGL by the processor, so that it is there on every machine.
FLAGS = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
GPU = dict[str, int]


def missing() -> str | None:
    """Why the journeys cannot be made here."""
    if CHROMIUM is None:
        return "no chromium, chromium-browser or google-chrome on PATH"
    try:
        import playwright  # noqa: F401
    except ImportError:
        return "no playwright in this environment: pip install playwright"
    if not PAGE.exists():
        return "the studio's page is not built: npm ci && npm run build in studio-page"
    return None


@contextlib.contextmanager
def chromium() -> Iterator[Any]:
    from playwright.sync_api import sync_playwright

    root = hasattr(os, "geteuid") and os.geteuid() == 0
    with sync_playwright() as playwright:
        flags = [*FLAGS, *(["--no-sandbox"] if root else [])]
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=flags)
        yield browser
        browser.close()


@dataclass
class Visit:
    """One visit of the page. trouble: errors on the console, exceptions, requests that left the machine."""

    studio: Studio
    page: Any
    trouble: list[str] = field(default_factory=list)

    @classmethod
    def of(cls, studio: Studio, browser: Any, **options: Any) -> Visit:
        """Open the studio's address, as it was printed, in a context of its own."""
        context = browser.new_context(viewport={"width": 1360, "height": 860}, **options)
        visit = cls(studio, context.new_page())
        visit.page.set_default_timeout(90_000)
        visit.page.on("console", visit._hears)
        visit.page.on("pageerror", lambda error: visit.trouble.append(str(error)))
        visit.page.on("request", lambda request: visit._sees(request.url))
        visit.page.goto(f"http://127.0.0.1:{studio.port}/?token={studio.token}")
        visit.page.wait_for_selector(".header")
        return visit

    def _hears(self, message: Any) -> None:
        if message.type == "error":
            self.trouble.append(f"{message.text} ({message.location.get('url', '')})")

    def _sees(self, url: str) -> None:
        parts = urlsplit(url)
        if parts.scheme not in ("data", "blob") and parts.netloc != f"127.0.0.1:{self.studio.port}":
            self.trouble.append(f"a request to {url}")

    def end(self) -> None:
        """Close the page. Fails when anything was wrong with it."""
        self.page.context.close()
        assert self.trouble == [], str(self.trouble)[:600]

    def go(self, view: str) -> None:
        self.page.click(f"nav a[href='#{view}']")

    def open(self, slug: str) -> None:
        """Open a pair in the inspector, and wait until its replica is there and measured."""
        self.page.evaluate("slug => { location.hash = `inspect/${slug}`; }", slug)
        self.page.wait_for_selector(f".inspector h2[title='{slug}']")
        self.page.wait_for_selector(".figures:not(.waiting) [data-figure=distance]")
        self.until("document.querySelector('.plane') || window.shapewright.gpu().geometries >= 4")

    def until(self, expression: str, seconds: float = 30) -> None:
        """Wait until an expression is true. (Playwright's own way to wait for one is against the page's policy.)"""
        end = time.monotonic() + seconds
        while not self.page.evaluate(expression):
            assert time.monotonic() < end, f"not true within {seconds} s: {expression}"
            self.page.wait_for_timeout(50)

    def text(self, selector: str) -> str:
        found: str = self.page.inner_text(selector)
        return found

    @property
    def distance(self) -> float:
        """The distance that the inspector shows."""
        return float(self.page.inner_text("[data-figure=distance]"))

    def gpu(self) -> GPU:
        found: GPU = self.page.evaluate("window.shapewright.gpu()")
        return found

    def click_at(self, side: str, point: tuple[float, float, float], off: tuple[float, float] = (0.0, 0.0)) -> None:
        """Click on the stage where a point of the normalised frame is seen, or some pixels beside it."""
        at = self.page.evaluate("([side, point]) => window.shapewright.seen(side, point)", [side, list(point)])
        self.page.mouse.move(at["x"] + off[0], at["y"] + off[1])
        self.page.mouse.click(at["x"] + off[0], at["y"] + off[1])

    def number(self, selector: str) -> float:
        return float(re.sub(r"[^0-9.e-]", "", self.page.inner_text(selector)))
