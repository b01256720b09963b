"""An author explores a procedure: random shapes, locks, parameters that vary, sliders of one shape."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest
import trimesh

from studio_browser import Visit, missing
from studio_client import Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(300),
]
TEXT = """
from typing import Annotated

from shapewright import Mesh, Range, procedure
from shapewright.modelling.solids import box


@procedure
def block(
    width: Annotated[float, Range(0.2, 1.0)] = 0.6,
    height: Annotated[float, Range(0.2, 1.0)] = 0.5,
    rows: Annotated[int, Range(1, 4)] = 2,
    torn: bool = False,
):
    solid = box((width, height, 0.3))
    for row in range(rows):
        solid = solid | box((0.1, 0.3, 0.1), at=(0.2 * row, height, 0))
    whole = solid.mesh()
    return Mesh(whole.vertices, whole.faces[:-1]) if torn else whole
"""
PICTURES = "[...document.querySelectorAll('[data-shape] .picture')].map(one => one.style.getPropertyValue('--picture'))"
WHOLE = "document.querySelectorAll('.shape').length > 0 && !document.querySelector('.shape.waits')"


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("blocks")
    (folder / "references").mkdir()
    trimesh.creation.box((1, 1, 2)).export(folder / "references" / "one.stl")
    (folder / "procedure.py").write_text(TEXT)
    with studio(folder, "--no-auto-fit", "--workers", "1") as started:
        started.wait_for(ready)
        yield started


@pytest.fixture
def visit(running: Studio, browser: Any) -> Iterator[Visit]:
    visit = Visit.of(running, browser)
    visit.go("explore")
    visit.until(WHOLE)
    yield visit
    visit.end()


ANSWER = "document.querySelector('[data-answer]').dataset.answer"


def pictures(visit: Visit) -> list[str]:
    visit.until(WHOLE)
    found: list[str] = visit.page.evaluate(PICTURES)
    return found


def anew(visit: Visit, act: Callable[[], object]) -> list[str]:
    """The pictures of all shapes after something that asks for others."""
    before = visit.page.evaluate(ANSWER)
    act()
    visit.until(f"{ANSWER} !== '{before}'")
    return pictures(visit)


def roll(visit: Visit, seed: int) -> list[str]:
    visit.page.fill("input[aria-label=Seed]", str(seed))
    return anew(visit, lambda: visit.page.press("input[aria-label=Seed]", "Enter"))


def test_a_seed_gives_the_same_shapes_again_and_another_gives_others(visit: Visit) -> None:
    first = roll(visit, 11)
    assert len(first) == 24 and len(set(first)) > 20
    assert anew(visit, lambda: visit.page.click("text=Re-roll")) != first
    assert visit.page.input_value("input[aria-label=Seed]") != "11"
    assert anew(visit, lambda: visit.page.click("[aria-label^='Back to the seed']")) == first
    visit.page.reload()
    visit.page.wait_for_selector(".shape")
    visit.until(WHOLE)
    assert visit.page.input_value("input[aria-label=Seed]") == "11" and pictures(visit) == first


def test_shapes_that_are_not_sound_are_marked_with_what_is_wrong(visit: Visit) -> None:
    page = visit.page
    roll(visit, 3)
    torn = page.locator(".shape.unsound").count()
    assert 0 < torn < 24
    assert page.locator(".shape.unsound[aria-label*='not watertight']").count() == torn
    assert f"{torn} not watertight" in page.inner_text("[data-soundness]")
    page.click("[data-lock=torn] [aria-label='Lock torn at no']")
    visit.until(f"{WHOLE} && document.querySelector('[data-soundness]').textContent.includes('all sound')")
    assert page.locator(".shape.unsound").count() == 0
    page.click("[data-lock=torn] [role=switch]")
    visit.until(f"{WHOLE} && document.querySelectorAll('.shape.unsound').length === 24")
    page.click("text=All at random")


def test_one_and_two_parameters_vary_from_end_to_end(visit: Visit) -> None:
    page = visit.page
    anew(visit, lambda: page.click("[aria-label='Go along width']"))
    labels = page.locator(".shape .what").all_inner_texts()
    assert labels[0] == "width 0.2" and labels[-1] == "width 1" and len(set(pictures(visit))) == len(labels)
    anew(visit, lambda: page.click("[aria-label='Go along rows']"))
    page.wait_for_selector("[data-along='width,rows']")
    assert page.locator("thead th").all_inner_texts()[1:] == ["1", "2", "3", "4"]
    assert page.locator("tbody tr").count() == 7 and page.locator(".shape").count() == 28
    page.click("text=All at random")
    page.wait_for_selector(".shapes-grid")


def test_a_shape_opens_with_sliders_and_the_grid_goes_on_from_it(visit: Visit) -> None:
    page = visit.page
    roll(visit, 5)
    page.click("[data-shape='2']")
    page.wait_for_selector(".lone [data-stage] canvas")
    visit.until("window.shapewright.gpu().geometries >= 1")
    assert page.locator("[data-lone-soundness]").inner_text().startswith("As drawn: ")
    page.wait_for_selector("[data-parameter=width] .number")
    drawn, size = page.input_value("[data-parameter=width] .number"), page.inner_text(".lone .foot")
    field = page.locator("[data-parameter=width] .number")
    field.fill("0.95")
    field.press("Enter")
    visit.until(f"document.querySelector('.lone .foot').innerText !== {size!r}")
    assert page.inner_text(".lone .foot").startswith("0.95 ×")
    page.click("text=As drawn >> nth=-1")
    visit.until(f"document.querySelector('.lone .foot').innerText === {size!r}")
    assert page.input_value("[data-parameter=width] .number") == drawn
    page.click("text=Vary this one")
    page.wait_for_selector("[data-along=width]")
    page.click("text=All at random")
    page.keyboard.press("Escape")
    page.wait_for_selector(".tile")
