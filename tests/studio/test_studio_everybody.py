"""The studio for everybody: colour-blind eyes, keyboards alone, screen readers, phones and large zooms."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from accessibility import AXE, violations
from boxes import CORNERS, TRIANGLES
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode
from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(900),
]
VIEWS = ("collection", "loop", "history", "feedback")
SIZES = {"a phone": (390, 844), "a page at 200 %": (680, 430)}
Colour = tuple[float, float, float]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """A project with a run and its explanation."""
    folder = tmp_path_factory.mktemp("everybody")
    (folder / "references").mkdir()
    for name, size in {"low": (1, 0.4, 0.7), "tall": (0.6, 1, 0.5), "long": (1, 0.3, 0.2)}.items():
        mesh = Mesh(np.array(CORNERS) / [1, 2, 3] * size, np.array(TRIANGLES))
        (folder / "references" / f"{name}.ply").write_bytes(encode(mesh, "ply"))
    (folder / "procedure.py").write_text(PROCEDURE)
    options = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
    with studio(folder, *options) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {"fresh": False}, 202)
        started.wait_for(lambda s: s["runs"] and s["jobs"]["fit"]["state"] == "done", 300)
        started.send("POST", "/api/explain", {}, 202)
        started.wait_for(lambda s: s["explanation"], 300)
        yield started


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    server.wait_for(ready)
    visit = Visit.of(server, browser)
    yield visit
    visit.end()


@pytest.mark.skipif(not AXE.is_file(), reason="axe-core is not installed: npm ci in studio-page")
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_axe_finds_nothing_in_any_view(server: Studio, browser: Any, theme: str) -> None:
    visit = Visit.of(server, browser, color_scheme=theme)
    page, found = visit.page, dict[str, list[str]]()

    def look(name: str) -> None:
        page.wait_for_timeout(300)
        found[name] = violations(page)

    page.wait_for_selector(".tile")
    for view in VIEWS:
        visit.go(view)
        page.wait_for_selector({"loop": ".cm-content", "feedback": ".feedback"}.get(view, "main"))
        look(view)
    page.keyboard.press("?")
    look("keys")
    page.keyboard.press("Escape")
    page.keyboard.press("Control+k")
    look("commands")
    page.keyboard.press("Escape")
    page.click(".header >> text=Export")
    look("export")
    page.keyboard.press("Escape")
    visit.open("low")
    look("inspector")
    page.keyboard.press("v")
    page.keyboard.press("b")
    page.keyboard.press("m")
    page.click(".tools >> text=Stage")
    look("stage and measure")
    assert {name: one for name, one in found.items() if one} == {}
    page.evaluate("document.querySelector('.inspector button[title]').removeAttribute('aria-label')")
    page.evaluate("document.querySelector('.header .button.bare').removeAttribute('title')")
    page.evaluate("document.querySelector('.header .button.bare').removeAttribute('aria-label')")
    assert any("button-name" in one for one in violations(page)), "axe would find what is wrong"
    visit.end()


def luminance(colour: str) -> float:
    linear = [((v / 255 + 0.055) / 1.055) ** 2.4 for v in bytes.fromhex(colour.lstrip("#"))]
    return float(np.dot([0.2126, 0.7152, 0.0722], linear))


def test_grades_differ_in_lightness_and_by_a_sign_and_the_papers_colours_are_an_option(visit: Visit) -> None:
    page = visit.page

    def colours() -> list[str]:
        names = ("different", "close", "replicated")
        read = "name => getComputedStyle(document.documentElement).getPropertyValue(`--grade-${name}`).trim()"
        return [page.evaluate(read, name) for name in names]

    page.wait_for_selector(".tile")
    clear = colours()
    light = [luminance(colour) for colour in clear]
    assert light[0] * 1.8 < light[1] and light[1] * 1.8 < light[2]
    tint = page.evaluate("document.querySelector('.tile .picture.tinted').style.getPropertyValue('--tint')")
    assert tint in clear, "tiles have the colour of their sign"
    signs = {path.get_attribute("d") for path in page.locator("svg.grade path").all()}
    labels = {mark.get_attribute("aria-label") for mark in page.locator("svg.grade").all()}
    assert len(signs) == len(labels) >= 2
    visit.go("loop")
    page.select_option("select[aria-label=Colours]", "paper")
    visit.go("collection")
    page.wait_for_selector(".tile")
    visit.until("document.documentElement.dataset.scale === 'paper'")
    assert colours() == ["#de4a3e", "#f7cd46", "#3ea664"]
    paper = page.evaluate("document.querySelector('.tile .picture.tinted').style.getPropertyValue('--tint')")
    assert paper in colours() and paper != tint
    page.reload()
    page.wait_for_selector(".tile")
    assert page.evaluate("document.documentElement.dataset.scale") == "paper"
    visit.studio.send("PATCH", "/api/settings", {"scale": "clear"})


def test_controls_have_the_names_of_their_parameters(visit: Visit) -> None:
    visit.open("low")
    for name in ("height", "leg"):
        assert visit.page.get_by_role("slider", name=name, exact=True).count() == 1
        assert visit.page.get_by_role("spinbutton", name=f"{name}, typed", exact=True).count() == 1
    assert visit.page.get_by_role("switch", name="shelf", exact=True).count() == 1
    for slider in visit.page.locator("input[type=range]").all():
        assert slider.get_attribute("aria-label")


def test_a_screen_reader_is_told_the_end_of_a_drag_alone(visit: Visit) -> None:
    visit.open("low")
    page = visit.page
    page.evaluate(
        """() => { window.spoken = []; new MutationObserver(() => {
          for (const place of document.querySelectorAll('[role=status], [aria-live], [role=alert], [role=log]'))
            if (place.textContent && place.textContent !== window.spoken.at(-1)) window.spoken.push(place.textContent);
        }).observe(document.body, { subtree: true, childList: true, characterData: true }); }"""
    )
    page.wait_for_timeout(1600)
    page.evaluate("window.spoken.length = 0")
    slider = page.locator("[data-parameter=height] input[type=range]")
    slider.focus()
    for _ in range(25):
        page.keyboard.press("ArrowRight")
        page.wait_for_timeout(30)
    page.wait_for_selector(".figures:not(.waiting)")
    page.wait_for_timeout(1800)
    spoken = page.evaluate("window.spoken")
    assert 1 <= len(spoken) <= 3 and re.search(r"(different|close|replicated), \.?\d", spoken[-1])


@pytest.mark.parametrize("view", [*VIEWS, "inspect/low"])
def test_the_keyboard_gets_everywhere_and_out_again(visit: Visit, view: str) -> None:
    page = visit.page
    page.evaluate(f"location.hash = '{view}'")
    if view == "loop":
        page.wait_for_selector(".cm-content")
    page.wait_for_timeout(500)
    page.evaluate("document.activeElement?.blur(); document.body.dataset.round = ''")
    seen, ends = set[str](), 0
    for _ in range(250):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.closest('.cm-content') !== null"):
            page.keyboard.press("Escape")
        # Each element gets a number when the focus comes to it first; the body is the end of the round.
        where = page.evaluate(
            """() => { const now = document.activeElement;
              if (now === document.body) return 'end';
              window.count ??= 0; now.dataset.seen ??= `${++window.count}`; return now.dataset.seen; }"""
        )
        # The focus begins where the view has put it: it comes by the end before it has been everywhere.
        ends += where in ("end", "1") and len(seen) > 3
        if ends == 3:
            break
        seen.add(where)
    else:
        raise AssertionError(f"no way out within 250 steps; {len(seen)} places were seen")
    assert len(seen) > 8
    unseen = page.evaluate(
        """() => [...document.querySelectorAll('a[href], button, input, select')].filter(one =>
          !one.disabled && one.tabIndex >= 0 && one.checkVisibility() && !one.dataset.seen && !one.closest('.cm-editor')
          && !(one.type === 'radio')).map(one => one.outerHTML.slice(0, 90))"""
    )
    assert unseen == []


@pytest.mark.parametrize("size", SIZES.values(), ids=list(SIZES))
def test_everything_can_be_reached_on(visit: Visit, size: tuple[int, int]) -> None:
    page = visit.page
    page.set_viewport_size({"width": size[0], "height": size[1]})
    for view in (*VIEWS, "inspect/low"):
        page.evaluate(f"location.hash = '{view}'")
        page.wait_for_timeout(600)
        beyond = page.evaluate(
            """() => { const wide = document.documentElement.clientWidth;
              const scrolls = (one) => { for (let up = one.parentElement; up; up = up.parentElement) {
                const { overflowX } = getComputedStyle(up);
                if (['auto', 'scroll'].includes(overflowX) && up.scrollWidth > up.clientWidth + 1) return true; }
                return false; };
              return [...document.querySelectorAll('button, a, input, select, h2, h3, p')].filter(one => {
                const { left, right, width, height } = one.getBoundingClientRect();
                return width && height && !one.closest('.unseen, .cm-editor') && (right > wide + 1 || left < -1) &&
                  !scrolls(one); }).map(one => one.outerHTML.slice(0, 90)); }"""
        )
        assert beyond == [], view
        assert page.evaluate("document.documentElement.scrollWidth") <= size[0], view
    for selector in (".button.fit", ".inspector [title^='Close']", "[data-parameter=leg] input", ".judgement button"):
        page.locator(selector).first.scroll_into_view_if_needed()
        page.locator(selector).first.click(trial=True)
