"""A new author's first minutes: no alarm, files that are dropped, axes that can be seen, one button; and restarts."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import trimesh

from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
QUICK = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
DROP = """([files, type]) => {
  const held = new DataTransfer();
  for (const [name, text] of files) held.items.add(new File([text], name));
  const usual = { dataTransfer: held, bubbles: true, cancelable: true };
  for (const kind of type) document.querySelector("main").dispatchEvent(new DragEvent(kind, usual));
}"""
LOADED = "[...document.querySelectorAll('.standing-pair img')].filter(i => i.complete && i.naturalWidth === 512).length"


@pytest.fixture
def empty(tmp_path: Path) -> Iterator[Studio]:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    with studio(tmp_path, *QUICK) as started:
        started.wait_for(ready)
        yield started


def mesh(height: float = 0.6, up: str = "y") -> str:
    """A block as the text of an OBJ, wider than deep."""
    size = (1.0, height, 0.7) if up == "y" else (1.0, 0.7, height)
    exported: str = trimesh.exchange.obj.export_obj(trimesh.creation.box(size), include_normals=False)
    return exported


def test_from_an_empty_project_to_the_first_fit(empty: Studio, browser: Any, tmp_path_factory: Any) -> None:
    visit = Visit.of(empty, browser)
    page = visit.page
    page.wait_for_selector(".welcome")
    assert page.locator(".problems").count() == 0 and page.locator(".status.bad, .status.warn").count() == 0
    page.wait_for_selector(".first-procedure code:has-text('def table(')")
    assert "height" in page.inner_text(".first-procedure ul") and "0.3 to 1.2" in page.inner_text(".first-procedure ul")
    assert page.is_disabled(".welcome .begin")
    files = tmp_path_factory.mktemp("files")
    for i, height in enumerate((0.5, 0.8)):
        (files / f"block {i}.obj").write_text(mesh(height))
    page.set_input_files("[data-drop] input", [str(path) for path in sorted(files.iterdir())])
    page.wait_for_selector(".notice:has-text('2 files taken over')")
    empty.wait_for(lambda s: s["collection"]["count"] == 2)
    page.wait_for_selector(".tile >> nth=1")
    visit.until(f"{LOADED} === 2")
    figure = page.locator(".standing-pair figure").first
    assert "1 wide, 0.5 high, 0.7 deep" in figure.inner_text() and "up: y" in figure.inner_html()
    # The author says that another axis points up: sizes and picture follow.
    before = figure.locator("img").get_attribute("src")
    page.select_option(".standing-pair select >> nth=0", "z")
    page.wait_for_selector(".standing-pair figure:first-child figcaption:has-text('0.7 high')")
    assert figure.locator("img").get_attribute("src") != before
    page.select_option(".standing-pair select >> nth=0", "y")
    page.select_option(".standing-pair select >> nth=1", "z")
    page.wait_for_selector(".standing-pair figure:first-child figcaption:has-text('0.5 high')")
    page.click(".welcome .begin:has-text('Fit 2 references')")
    page.wait_for_selector("[data-working=fit]")
    page.wait_for_selector(".welcome", state="detached")
    empty.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done", 240)
    page.wait_for_selector(".next")
    visit.go("history")
    page.wait_for_selector(".run-source code:has-text('def table(')")
    visit.end()


def test_files_are_dropped_in_any_view_and_go_over_no_other(empty: Studio, browser: Any) -> None:
    home = empty.folder / "references"
    visit = Visit.of(empty, browser)
    page = visit.page
    visit.go("history")
    page.wait_for_selector(".history")
    page.evaluate(DROP, [[["a.obj", mesh()]], ["dragenter", "dragover"]])
    page.wait_for_selector(".drop-cover")
    page.evaluate(DROP, [[["a.obj", mesh()]], ["dragover", "drop"]])
    page.wait_for_selector(".drop-cover", state="detached")
    page.wait_for_selector(".notice:has-text('1 file taken over')")
    assert (home / "a.obj").read_text() == mesh()
    visit.trouble.clear()
    odd = [["a.obj", mesh(0.9)], ["evil.py", "x = 1"], ["b.obj", mesh(0.7)]]
    page.evaluate(DROP, [odd, ["dragenter", "dragover", "drop"]])
    page.wait_for_selector(".refused:has-text('another a.obj already')")
    page.wait_for_selector(".refused:has-text('no kind of file that is read')")
    empty.wait_for(lambda _: (home / "b.obj").exists())
    assert (home / "a.obj").read_text() == mesh()
    page.click(".refused >> text=Keep both")
    page.wait_for_selector(".refused:has-text('another a.obj')", state="detached")
    empty.wait_for(lambda _: (home / "a-2.obj").exists())
    assert (home / "a-2.obj").read_text() == mesh(0.9) and not (home / "evil.py").exists()
    page.click(".refused >> text=Put away")
    page.wait_for_selector(".refused", state="detached")
    visit.go("collection")
    page.wait_for_selector(".tile >> nth=2")
    # A browser notes each refusal of a server on its console: these two are what was tried.
    assert all("409" in one or "422" in one for one in visit.trouble) and len(visit.trouble) == 2
    visit.trouble.clear()
    visit.end()


def test_references_elsewhere_have_no_drop_zone(browser: Any, tmp_path: Path) -> None:
    (tmp_path / "project").mkdir()
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "project" / "procedure.py").write_text(PROCEDURE)
    (tmp_path / "elsewhere" / "a.obj").write_text(mesh())
    with studio(tmp_path / "project", *QUICK, "--references", str(tmp_path / "elsewhere")) as server:
        visit = Visit.of(server, browser)
        visit.page.wait_for_selector(".welcome .tile, .welcome code:has-text('elsewhere')")
        assert visit.page.locator("[data-drop]").count() == 0
        visit.page.evaluate(DROP, [[["b.obj", mesh()]], ["dragenter"]])
        visit.page.wait_for_timeout(200)
        assert visit.page.locator(".drop-cover").count() == 0
        visit.end()


def stopped(server: Studio) -> None:
    server.process.send_signal(signal.SIGTERM)
    try:
        server.process.wait(timeout=15)
    except subprocess.TimeoutExpired:
        server.process.kill()


def test_a_page_connects_again_after_a_restart_where_the_author_wishes(browser: Any, tmp_path: Path) -> None:
    (tmp_path / "procedure.py").write_text(PROCEDURE)
    with studio(tmp_path, *QUICK, "--keep-token") as first:
        visit = Visit.of(first, browser)
        visit.page.wait_for_selector(".welcome")
        stopped(first)
        visit.page.wait_for_selector("[data-lost=gone]:has-text('does not answer')")
    with studio(tmp_path, *QUICK, "--keep-token") as again:
        assert (again.port, again.token) == (first.port, first.token)
        visit.page.wait_for_selector("[data-lost]", state="detached")
        again.wait_for(ready)
        again.edit(PROCEDURE + "\n# later\n")
        visit.page.wait_for_selector(".welcome")
        stopped(again)
        visit.page.wait_for_selector("[data-lost=gone]")
    with studio(tmp_path, *QUICK, "--port", str(first.port)) as other:
        visit.page.wait_for_selector("[data-lost=anew]:has-text('--keep-token')")
        # Its own address, opened in this browser, lets the old page go on, too.
        second = visit.page.context.new_page()
        second.goto(f"http://127.0.0.1:{other.port}/?token={other.token}")
        second.wait_for_selector(".header")
        visit.page.wait_for_selector("[data-lost]", state="detached")
        visit.page.context.close()
    # What a browser notes of connections that fail is what was tried.
    assert all("ERR_" in one or "401" in one or "WebSocket" in one or "403" in one for one in visit.trouble)
