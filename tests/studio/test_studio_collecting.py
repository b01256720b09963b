"""An author says something of many references at once, and sees all of them at a glance."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import trimesh

from shapewright.references import Collection
from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
QUICK = ("--no-auto-fit", "--samples", "200", "--epochs", "2", "--refine", "off", "--workers", "1")
SIZES = {
    "low": (1, 0.3, 0.7), "middle": (1, 0.6, 0.7), "high": (1, 0.9, 0.7), "twin": (2, 1.2, 1.4),
    "thin": (1, 0.1, 0.1), "post": (0.1, 1, 0.1), "cube": (1, 1, 1), "plate": (1, 0.05, 1),
}  # fmt: skip
SELECTED = "[...document.querySelectorAll('.pick[aria-checked=true]')].length"
SHOWN = "[...document.querySelectorAll('.collection [data-tile]')].map(one => one.dataset.tile)"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    home = tmp_path_factory.mktemp("blocks")
    (home / "references").mkdir()
    for name, size in SIZES.items():
        trimesh.creation.box(size).export(home / "references" / f"{name}.stl")
    (home / "procedure.py").write_text(PROCEDURE)
    return home


@pytest.fixture(scope="module")
def running(folder: Path) -> Iterator[Studio]:
    """With two iterations, the second one of another text."""
    with studio(folder, *QUICK) as started:
        for count, text in enumerate((PROCEDURE, PROCEDURE.replace("0.08", "0.12")), start=1):
            started.edit(text)
            started.wait_for(ready)
            started.send("POST", "/api/fit", {"fresh": True}, 202)
            started.wait_for(lambda s, count=count: len(s["runs"]) == count and rested(s), 240)  # type: ignore[misc]
        started.wait_for(lambda s: bool(s["duplicates"]))
        yield started


@pytest.fixture
def visit(running: Studio, browser: Any) -> Iterator[Visit]:
    visit = Visit.of(running, browser)
    visit.page.wait_for_selector(".tile")
    yield visit
    visit.end()


def rested(state: dict[str, Any]) -> bool:
    return ready(state) and state["jobs"]["fit"]["state"] not in ("running", "cancelling")


def by_name(visit: Visit) -> None:
    visit.page.select_option("select[aria-label=Order]", "name")
    visit.until(f"{SHOWN}.length >= 7")


def noted(visit: Visit) -> Any:
    return visit.studio.get("/api/state")["noted"]


def test_several_are_selected_and_tagged_and_the_tags_last_are_sought_and_are_taken_back(
    visit: Visit, running: Studio, folder: Path
) -> None:
    page = visit.page
    by_name(visit)
    shown = visit.page.evaluate(SHOWN)
    page.locator(f"[data-tile={shown[1]}]").focus()
    page.keyboard.press("x")
    visit.until(f"{SELECTED} === 1")
    page.click(f"[data-tile={shown[3]}]", modifiers=["Shift"])
    visit.until(f"{SELECTED} === 3")
    page.click(f"[data-tile={shown[2]}]", modifiers=["Control"])
    visit.until(f"{SELECTED} === 2")
    page.fill(".selection input[aria-label='Add a tag']", "tall")
    page.press(".selection input[aria-label='Add a tag']", "Enter")
    page.wait_for_selector(".selection [data-tag=tall]")
    assert {slug: one["tags"] for slug, one in noted(visit).items()} == {shown[1]: ["tall"], shown[3]: ["tall"]}
    assert {e["name"] for e in json.loads((folder / "notes.json").read_text())} == {shown[1], shown[3]}
    page.reload()
    page.wait_for_selector(".tile .badge.tag")
    page.select_option("select[aria-label=Tag]", "tall")
    visit.until(f"{SHOWN}.length === 2")
    page.select_option("select[aria-label=Tag]", "")
    by_name(visit)
    page.fill(".search input", "tall")
    visit.until(f"{SHOWN}.length === 2")
    visit.go("history")
    page.click("[data-told-change]:first-child >> text=Undo")
    visit.studio.wait_for(lambda s: not s["noted"])
    visit.go("collection")
    page.fill(".search input", "")
    visit.until("!document.querySelector('.tile .badge.tag')")


def test_a_note_is_kept_and_what_is_not_mine_leaves_the_count(visit: Visit, running: Studio) -> None:
    page = visit.page
    visit.open("cube")
    page.fill("textarea.note", "a test, no table")
    page.click(".noted >> text=Not mine")
    visit.studio.wait_for(
        lambda s: s["noted"].get("cube") == {"tags": [], "note": "a test, no table", "not_mine": True}
    )
    page.wait_for_selector(".noted >> text=It does not count")
    page.keyboard.press("Escape")
    page.wait_for_selector(".inspector", state="detached")
    visit.until("document.querySelector('.score').innerText.includes('of 7 replicated')")
    page.click(".fold:has-text('Not mine')")
    page.wait_for_selector("section[aria-label='Not mine'] [data-tile=cube]")
    assert page.locator("section[aria-label='Not mine'] .tile").count() == 1
    page.click("[data-tile=cube]", modifiers=["Control"])
    page.click(".selection >> text=Not mine")
    visit.until("document.querySelector('.score').innerText.includes('of 8 replicated')")
    page.click(".notices >> text=Undo >> nth=-1")  # of what was said last
    visit.until("document.querySelector('.score').innerText.includes('of 7 replicated')")
    visit.studio.send("PATCH", "/api/notes", {"slugs": ["cube"], "not_mine": False, "note": ""})


def test_references_are_turned_and_get_a_unit_for_the_next_fit(visit: Visit, folder: Path) -> None:
    page = visit.page
    by_name(visit)
    before = visit.studio.get("/api/state")["collection"]["tiles"]
    for slug in ("post", "plate"):
        page.click(f"[data-tile={slug}]", modifiers=["Control"])
    page.click(".selection >> text=Tip 90°")
    visit.studio.wait_for(
        lambda s: all(
            now["reference"] != was["reference"]
            for now, was in zip(s["collection"]["tiles"], before, strict=True)
            if now["slug"] in ("post", "plate")
        )
    )
    page.select_option(".selection select[aria-label=Unit]", "cm")
    visit.studio.wait_for(lambda s: visit.studio.get("/api/references/plate")["told"]["unit"] == "cm")
    read = {each.name: each for each in Collection.load(folder / "references")}
    assert (read["post"].orientation.up, read["plate"].orientation.up, read["low"].orientation.up) == ("-z", "-z", "y")
    assert (read["post"].unit, read["low"].unit) == (0.01, None)
    visit.go("history")
    last = max(one["number"] for one in visit.studio.get("/api/told"))
    for number in (last - 1, last):  # the turn first: the unit that was told since stays
        page.click(f"[data-told-change='{number}'] .button")
        page.wait_for_selector(f"[data-told-change='{number}'] >> text=Undone")
        assert [each.unit for each in Collection.load(folder / "references") if each.name == "post"] == [
            0.01 if number < last else None
        ]
    visit.studio.wait_for(lambda s: not (folder / "references" / "shapewright.csv").exists())


def test_duplicates_are_shown_and_the_most_alike_come_first(visit: Visit) -> None:
    page = visit.page
    by_name(visit)
    assert page.locator("[data-duplicate]").count() == 1
    assert page.text_content("[data-duplicate=middle]") == "= middle"
    page.click(".toolbar [role=radio]:has-text('Duplicates')")
    visit.until(f"{SHOWN}.join() === 'middle,twin'")
    page.click(".toolbar [role=radio]:has-text('All')")
    page.click("[data-tile=plate]", modifiers=["Control"])
    page.click(".selection >> text=Sort by likeness")
    order = ["plate", *visit.studio.get("/api/references/plate/alike")]
    visit.until(f"{SHOWN}.join() === '{','.join(order)}'")
    assert page.input_value("select[aria-label=Order]") == "alike"


def test_the_map_shows_references_and_samples_in_colours_and_selects(visit: Visit) -> None:
    page = visit.page
    visit.studio.send("PATCH", "/api/notes", {"slugs": ["low", "high"], "add": ["pair"]})
    page.click(".segments >> text=Map")
    page.wait_for_selector(".map circle")
    assert page.locator(".map circle").count() == len(SIZES) and page.locator(".map rect.sample").count() > 20

    def fills() -> dict[str, str]:
        found: dict[str, str] = page.evaluate(
            "Object.fromEntries([...document.querySelectorAll('.map circle')]"
            ".map(one => [one.dataset.dot, getComputedStyle(one).fill]))"
        )
        return found

    page.select_option(".map-view select[aria-label=Colour]", "tag pair")
    by_tag = fills()
    assert by_tag["low"] == by_tag["high"] != by_tag["cube"] == by_tag["thin"]
    page.select_option(".map-view select[aria-label=Colour]", "parameter height")
    page.wait_for_timeout(800)
    assert len(set(fills().values())) > 1 and "0.3" in page.inner_text("[data-map-legend]")
    page.select_option(".map-view select[aria-label=Colour]", "fidelity")
    box = page.locator(".map").bounding_box()
    page.mouse.move(box["x"] + 3, box["y"] + 3)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] - 3, box["y"] + box["height"] - 3, steps=5)
    page.mouse.up()
    page.wait_for_selector(f".selection >> text={len(SIZES)} references selected")
    page.locator(".map circle[data-dot=cube]").dispatch_event("click")
    page.wait_for_selector(".inspector h2[title=cube]")
    visit.studio.send("PATCH", "/api/notes", {"slugs": ["low", "high"], "remove": ["pair"]})


def test_parameters_at_a_glance_and_what_is_brushed_is_selected_in_the_collection(visit: Visit) -> None:
    page = visit.page
    visit.go("parameters")
    page.wait_for_selector("[data-histogram=height] .bar")
    rows = visit.studio.get("/api/parameters")["rows"]
    names = {one["name"] for one in visit.studio.get("/api/state")["procedure"]["parameters"]}
    assert page.locator(".parameter-card").count() == len(names) == page.locator("[data-axis]").count()
    for name in names:
        assert page.inner_text(f"[data-recovered={name}]").startswith(("±", "right in"))
    told = page.evaluate(
        "[...document.querySelectorAll('[data-histogram=height] .bar')]"
        ".map(one => Number(one.title.match(/: (\\d+) reference/)[1]))"
    )
    assert sum(told) == len(rows) == len(SIZES)
    high = sum(one["parameters"]["height"] > 1.182 for one in rows)
    low = sum(one["parameters"]["height"] < 0.318 for one in rows)
    warned = page.locator("[data-pressed=height]")
    assert (warned.count() == 1) == (max(high, low) >= 3)
    fullest = told.index(max(told))
    page.locator("[data-histogram=height] .bar").nth(fullest).click()
    page.wait_for_selector(f"[data-brushed='{told[fullest]}']")
    page.click("text=Show in the collection")
    visit.until(f"{SHOWN}.length === {told[fullest]} && {SELECTED} === {told[fullest]}")
    visit.go("parameters")
    page.click(".brushed >> text=Select none")
    axis = page.locator("[data-axis=height] .grip").bounding_box()
    page.mouse.move(axis["x"] + axis["width"] / 2, axis["y"] + 2)
    page.mouse.down()
    page.mouse.move(axis["x"] + axis["width"] / 2, axis["y"] + axis["height"] - 2, steps=6)
    page.mouse.up()
    page.wait_for_selector(f"[data-brushed='{len(SIZES)}']")


def test_one_reference_through_all_iterations_and_an_old_run_to_look_at(visit: Visit, folder: Path) -> None:
    page = visit.page
    visit.open("middle")
    page.wait_for_selector(".steps [data-step]")
    assert page.locator(".steps [data-step]").count() == 2
    pictures = page.evaluate(
        "[...document.querySelectorAll('.steps .picture')].map(one => one.style.getPropertyValue('--picture'))"
    )
    assert len(set(pictures)) == 2
    before = {path: path.read_bytes() for path in (folder / "runs").rglob("*") if path.is_file()}
    page.click(".steps [data-step='001']")
    page.wait_for_selector(".old-run .old-pair")
    assert "Run 001" in page.inner_text(".old-run h2") and "read-only" in page.inner_text(".old-run h2")
    record = visit.studio.get_run("001")
    height = next(one for one in record["references"] if one["name"] == "middle")["parameters"]["height"]
    assert f"{height:.4g}"[:5] in page.inner_text(".old-run dl.values")
    page.keyboard.press("Escape")
    page.wait_for_selector(".old-run .tiles .tile")
    assert page.locator(".old-run .tile").count() == len(SIZES)
    assert page.locator(".old-run input, .old-run select, .old-run .pick").count() == 0
    page.click("summary:has-text('Its procedure')")
    assert "0.08" in page.inner_text("pre.source") and "0.12" not in page.inner_text("pre.source")
    page.keyboard.press("ArrowRight")
    page.wait_for_selector(".old-run h2:has-text('Run 002')")
    page.keyboard.press("Escape")
    page.wait_for_selector(".chart")
    after = {path: path.read_bytes() for path in (folder / "runs").rglob("*") if path.is_file()}
    assert after == before
    assert visit.studio.get("/api/state")["collection"]["run"] == "002"
