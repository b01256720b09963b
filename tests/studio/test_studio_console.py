"""The console, the command palette, and several files in the editor."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from boxes import CORNERS, TRIANGLES
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode
from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
BUILDS = "    top = box("
PRINTS = """    print("height", round(height, 3))
    print("\\x1b[31mred\\x1b[0m and a mistake", file=sys.stderr)
"""
TALKING = PROCEDURE.replace(BUILDS, PRINTS + BUILDS).replace("from typing", "import sys\nfrom typing", 1)


@pytest.fixture
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("console")
    (folder / "references").mkdir()
    for name in ("first", "second"):
        mesh = Mesh(np.array(CORNERS) / [1, 2, 3] * (1, 0.5, 0.7), np.array(TRIANGLES))
        (folder / "references" / f"{name}.ply").write_bytes(encode(mesh, "ply"))
    (folder / "procedure.py").write_text(TALKING)
    (folder / "sizes.json").write_text('{"top": 0.08}\n')
    (folder / "helpers.py").write_text("THICK = 0.08\n")
    with studio(folder, "--no-auto-fit") as started:
        started.wait_for(ready)
        yield started


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    visit = Visit.of(server, browser)
    visit.page.wait_for_selector(".tile")
    yield visit
    visit.end()


def test_what_the_procedure_prints_is_shown_beside_its_reference(visit: Visit) -> None:
    page = visit.page
    visit.open("second")
    page.wait_for_selector(".inspector .console code:text-is('height 0.6')")
    page.wait_for_selector(".inspector .console code:text-is('red and a mistake')")
    slider = page.locator("[data-parameter=height] input[type=range]")
    slider.focus()
    page.keyboard.press("End")
    page.wait_for_selector(".inspector .console code:text-is('height 1.2')")
    page.keyboard.press("Escape")
    visit.open("first")
    page.wait_for_selector(".inspector .console code")
    assert page.locator(".inspector .console code:text-is('height 1.2')").count() == 0
    page.keyboard.press("Escape")
    visit.go("loop")
    line = page.locator(".console p:has(code:text-is('height 1.2')) button")
    assert line.first.inner_text() == "second"
    page.click(".console >> text=Clear")
    page.wait_for_selector(".console:has-text('appears here')")
    page.reload()
    page.wait_for_selector(".console code:text-is('height 1.2')")
    line.first.click()
    page.wait_for_selector(".inspector h2[title='second']")


def test_what_is_printed_before_a_crash_and_much_of_it_is_told_and_bounded(visit: Visit) -> None:
    page, studio = visit.page, visit.studio
    studio.edit(TALKING.replace(BUILDS, '    for i in range(20_000):\n        print("line", i)\n' + BUILDS))
    visit.open("first")
    page.wait_for_selector(".inspector .console code:has-text('bytes more')")
    studio.edit(TALKING.replace(BUILDS, '    print("last words")\n    import os; os._exit(3)\n' + BUILDS))
    page.wait_for_selector(".inspector .console code:text-is('last words')")
    assert len(studio.get("/api/state")["console"]) <= 1000
    studio.edit(TALKING)


def test_any_view_command_or_reference_is_found_by_its_name(visit: Visit) -> None:
    page = visit.page

    def ask(words: str) -> None:
        page.keyboard.press("Control+k")
        page.wait_for_selector(".palette")
        page.keyboard.type(words)

    ask("hist")
    page.keyboard.press("Enter")
    page.wait_for_selector(".history, main:has-text('No run')")
    ask("second")
    page.keyboard.press("Enter")
    page.wait_for_selector(".inspector h2[title='second']")
    ask("wirefr")
    assert "inspector" in page.inner_text(".palette [aria-selected=true]")
    page.keyboard.press("Enter")
    page.click(".tools >> text=Stage")
    assert page.is_checked(".stage-tools label:has-text('Wireframe') input")
    page.keyboard.press("Escape")
    theme = page.evaluate("document.documentElement.dataset.theme")
    ask("dark or light colours")
    page.keyboard.press("Enter")
    visit.until(f"document.documentElement.dataset.theme !== '{theme}'")
    ask("o")
    first = page.inner_text(".palette [aria-selected=true]")
    page.keyboard.press("ArrowDown")
    assert page.inner_text(".palette [aria-selected=true]") != first
    active = page.get_attribute(".palette input", "aria-activedescendant")
    assert page.get_attribute(f"#{active}", "aria-selected") == "true"
    page.keyboard.type("zzqq")
    page.wait_for_selector(".palette:has-text('Nothing is called so')")
    page.keyboard.press("Escape")
    page.wait_for_selector(".palette", state="detached")


def test_several_files_are_edited_with_an_undo_list_each(visit: Visit) -> None:
    page, folder = visit.page, visit.studio.folder
    visit.go("loop")
    page.wait_for_selector(".cm-content:has-text('def table')")
    assert page.locator("select[aria-label=File] option").all_inner_texts() == [
        "procedure.py",
        "helpers.py",
        "sizes.json",
    ]
    page.click(".cm-content")
    page.keyboard.press("Control+Home")
    page.keyboard.type("# kept\n")
    page.select_option("select[aria-label=File]", "sizes.json")
    page.wait_for_selector(".cm-content:has-text('0.08')")
    page.click(".cm-content")
    page.keyboard.press("Control+a")
    page.keyboard.type('{"top": 0.1}')
    page.keyboard.press("Control+s")
    visit.until("document.querySelector('.editor .button.primary') === null")
    assert (folder / "sizes.json").read_text() == '{"top": 0.1}'
    # Somebody else writes it meanwhile: it is not written over.
    (folder / "sizes.json").write_text('{"top": 0.3}')
    page.keyboard.press("Control+End")
    page.keyboard.type(" ")
    page.keyboard.press("Control+s")
    page.wait_for_selector(".conflict:has-text('changed on disk')")
    visit.trouble[:] = [one for one in visit.trouble if "409" not in one]  # the browser tells of the refusal, too
    page.click(".conflict >> text=Take the file's text")
    page.wait_for_selector(".cm-content:has-text('0.3')")
    # What was typed into the other one is there.
    page.select_option("select[aria-label=File]", "procedure.py")
    page.wait_for_selector(".cm-content:has-text('# kept')")
    assert "# kept" not in (folder / "procedure.py").read_text()
    page.click(".editor >> text=Discard")
    visit.go("history")
    page.select_option("select[aria-label='Changes of']", "sizes.json")
    page.wait_for_selector(".revisions li:has-text('another program')")
    page.click(".revisions li:has-text('editor') >> text=Undo to here")
    page.wait_for_selector(".notice:has-text('sizes.json is as it was before')")
    assert (folder / "sizes.json").read_text() == '{"top": 0.08}\n'
    page.click(".notice:has-text('sizes.json') >> text=Undo")
    visit.studio.wait_for(lambda _: (folder / "sizes.json").read_text() == '{"top": 0.3}')
    assert len(visit.studio.get("/api/revisions?file=sizes.json")) == 4
    assert visit.studio.get("/api/revisions") == []


def test_a_problem_in_another_file_opens_it_at_its_line(visit: Visit) -> None:
    page, studio = visit.page, visit.studio
    studio.save("THICK = 0.08\nraise ValueError('no thickness')\n", "helpers.py")
    studio.edit(TALKING.replace("import sys", "import sys\nimport helpers"), "broken")
    page.click(".problems button:has-text('helpers.py:2')")
    page.wait_for_selector(".cm-content:has-text('no thickness')")
    assert page.input_value("select[aria-label=File]") == "helpers.py"
    page.wait_for_selector(".cm-activeLine:has-text('no thickness')")


def test_the_editor_completes_names_of_the_file_and_of_the_kit(visit: Visit) -> None:
    page = visit.page
    visit.go("loop")
    page.wait_for_selector(".cm-content:has-text('def table')")
    page.click(".cm-content")
    page.keyboard.press("Control+End")
    page.keyboard.type("round")
    page.wait_for_selector(".cm-tooltip-autocomplete li:has-text('rounded_box')")
    page.keyboard.press("Escape")
    page.keyboard.type("\nTALL = 1\nTA")
    page.wait_for_selector(".cm-tooltip-autocomplete li:has-text('TALL')")
    page.keyboard.press("Escape")
    page.keyboard.type("\ntop.mir")
    page.wait_for_selector(".cm-tooltip-autocomplete li[aria-selected]:has-text('mirror')")
    page.wait_for_timeout(150)  # what is typed on by habit is not taken for an answer sooner
    page.keyboard.press("Enter")
    page.wait_for_selector(".cm-content:has-text('top.mirror(')")
    page.click(".editor >> text=Discard")
