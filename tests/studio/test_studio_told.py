"""What the author tells: of single references in the page, and of parameters in the procedure."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import trimesh

from shapewright.references import Collection
from studio_browser import Visit, chromium, missing
from studio_client import PROCEDURE, Studio, ready, studio

MEANING = "How high the top lies."
NOTHING = {"up": None, "front": None, "unit": None, "split": None}
FIELD = ".told select[aria-label='{}']"


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("boxes")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE.replace("1.2)]", f'1.2), "{MEANING}"]'))
    for number in (1, 2, 3):
        box = trimesh.creation.box((1, 0.2 * number, 2))
        box.export(folder / "references" / f"box {number}.stl")
    with studio(folder, "--no-auto-fit", "--workers", "1") as started:
        started.wait_for(drawn)
        yield started


def drawn(state: dict[str, Any]) -> bool:
    return ready(state) and all(tile["reference"] for tile in state["collection"]["tiles"])


def picture(running: Studio, slug: str) -> bytes:
    """The picture of a tile, as soon as all are there."""
    tiles = running.wait_for(drawn)["collection"]["tiles"]
    return running.request("GET", next(tile["reference"] for tile in tiles if tile["slug"] == slug))[1]


def ups(running: Studio) -> list[str]:
    """As the next fit reads them."""
    return [each.orientation.up for each in Collection.load(running.folder / "references")]


def test_references_stand_as_told_at_once_and_in_the_next_fit_until_that_is_taken_back(running: Studio) -> None:
    first, before = running.get("/api/references/box-1"), picture(running, "box-1")
    assert first["told"] == NOTHING
    told = {**NOTHING, "up": "z"}
    running.send("PATCH", "/api/references", {"slugs": ["box-1", "box-2"], "told": told})
    assert picture(running, "box-1") != before
    turned = running.get("/api/references/box-1")
    assert turned["told"] == told and turned["units"]["axes"][1] == [0, 0, 1]
    assert ups(running) == ["z", "z", "y"]
    running.send("PATCH", "/api/references", {"slugs": ["box-1", "box-2"], "told": {}})
    assert picture(running, "box-1") == before
    assert running.get("/api/references/box-1") == first and ups(running) == ["y", "y", "y"]


def test_what_cannot_be_told_is_refused(running: Studio) -> None:
    for wrong in ({"up": "w"}, {"split": "often"}):
        assert (
            "told has up" in running.send("PATCH", "/api/references", {"slugs": ["box-1"], "told": wrong}, 422)["error"]
        )
    running.send("PATCH", "/api/references", {"slugs": ["nobody"], "told": {}}, 422)


@pytest.mark.skipif(missing() is not None, reason=str(missing()))
def test_an_author_says_which_axis_points_up_of_one_and_of_all_that_are_shown(running: Studio) -> None:
    with chromium() as browser:
        visit = Visit.of(running, browser)
        page = visit.page
        page.evaluate("location.hash = 'inspect/box-1'")
        visit.until("window.shapewright?.gpu().geometries >= 2")
        page.wait_for_timeout(500)
        with page.expect_response("**/box-1/shape"):  # the large one turns as well
            page.select_option(FIELD.format("Up"), "z")
        running.wait_for(lambda s: running.get("/api/references/box-1")["told"]["up"] == "z")
        assert ups(running) == ["z", "y", "y"]
        page.click(".told button:has-text('all 3 shown')")
        running.wait_for(lambda s: running.get("/api/references/box-3")["told"]["up"] == "z")
        page.select_option(FIELD.format("Objects"), "apart")
        running.wait_for(lambda s: running.get("/api/references/box-1")["told"]["split"] == "apart")
        for field in ("Up", "Objects"):
            visit.until(f"document.querySelector(\"{FIELD.format(field)}\").value !== 'as all'")
            page.select_option(FIELD.format(field), "as all")
        running.wait_for(lambda s: running.get("/api/references/box-1")["told"] == NOTHING)
        assert ups(running) == ["y", "z", "z"]
        visit.end()


@pytest.mark.skipif(missing() is not None, reason=str(missing()))
def test_a_parameter_is_shown_with_what_the_author_says_of_it(running: Studio) -> None:
    with chromium() as browser:
        visit = Visit.of(running, browser)
        visit.page.evaluate("location.hash = 'inspect/box-2'")
        row = visit.page.locator("[data-parameter=height]")
        assert row.locator(".label").get_attribute("title") == f"height: {MEANING}"
        read = visit.page.context.new_cdp_session(visit.page).send("Accessibility.getFullAXTree")["nodes"]
        heard = {
            (node["role"]["value"], node["name"]["value"]): node.get("description") for node in read if "name" in node
        }
        for control in (("group", "height"), ("slider", "height"), ("spinbutton", "height, typed")):
            assert heard[control]["value"] == MEANING
        assert visit.page.locator("[data-parameter=leg]").get_attribute("title") is None
        visit.end()
