"""Small things that are felt every day: what moves under the pointer, what can be clicked, what is told once."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from shapewright.feedback.trials.cards import Example, card
from shapewright.modelling.solids import box
from shapewright.procedures import load_procedure
from studio_browser import Visit, missing
from studio_client import Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
QUICK = ("--samples", "40", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
SCALARS = 14
HEAD = """
from typing import Annotated, Literal

from shapewright import Range, procedure
from shapewright.modelling.solids import box, cylinder


@procedure
def table(
    height: Annotated[float, Range(0.3, 1.2)] = 0.6,
"""
MANY = HEAD + "".join(f"    part_{i}: Annotated[float, Range(0.0, 1.0)] = 0.5,\n" for i in range(1, SCALARS))
MANY += """    count: Annotated[int, Range(2, 9)] = 4,
    round: bool = False,
    form: Literal["plain", "wide", "narrow"] = "plain",
):
    top = box((1.0, 0.08, 0.4 + 0.4 * part_1), at=(0, height, 0)).label("top")
    post = cylinder if round else box
    wide = {"plain": 0.1, "wide": 0.16, "narrow": 0.06}[form]
    leg = post((wide, height, wide), at=(0.4, height / 2, 0.15)).label("legs")
    return top | leg.mirror("x", keep=True).mirror("z", keep=True)
"""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Tables of a procedure with seventeen parameters, a drum that it cannot make, and a run."""
    folder = tmp_path_factory.mktemp("daily")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(MANY)
    procedure = load_procedure(folder / "procedure.py")
    for i in range(3):
        made = procedure(height=0.4 + 0.2 * i, round=bool(i % 2))
        trimesh.Trimesh(made.vertices, made.faces, process=False).export(folder / "references" / f"table-{i}.ply")
    trimesh.creation.cylinder(0.5, 1.2).export(folder / "references" / "drum.ply")
    with studio(folder, *QUICK) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {}, 202)
        started.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done", 240)
        yield started


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    visit = Visit.of(server, browser)
    yield visit
    visit.end()


def tops(page: Any) -> list[float]:
    found: list[float] = page.evaluate(
        "[...document.querySelectorAll('[data-parameter]')].map(row => row.getBoundingClientRect().top)"
    )
    return found


@pytest.mark.parametrize("slug", ["table-1", "drum"])
def test_no_slider_moves_under_the_pointer(visit: Visit, slug: str) -> None:
    page = visit.page
    visit.open(slug)
    page.wait_for_timeout(400)
    before = tops(page)
    assert len(before) == SCALARS + 3
    for name, ends in (("height", (0.1, 0.9)), ("part_1", (0.95, 0.6)), ("part_9", (0.2, 0.8))):
        track = page.locator(f"[data-parameter={name}] input[type=range]").bounding_box()
        middle = track["y"] + track["height"] / 2
        page.mouse.move(track["x"] + track["width"] * 0.5, middle)
        page.mouse.down()
        for end in ends:
            page.mouse.move(track["x"] + track["width"] * end, middle, steps=6)
            page.wait_for_timeout(250)
            assert tops(page) == before
        page.mouse.up()
        page.wait_for_selector(".figures:not(.waiting)")
        assert tops(page) == before
        assert page.locator(f"[data-parameter={name}] [title*='as found']").count() == 1
    page.click("text=As found")
    page.wait_for_selector(".figures:not(.waiting)")
    assert tops(page) == before


def test_a_replica_that_cannot_be_built_moves_nothing_either(server: Studio, visit: Visit) -> None:
    page = visit.page
    server.edit(MANY.replace("    top = box", "    assert part_2 < 0.9, f'too thick: {part_2}'\n    top = box", 1))
    server.wait_for(lambda s: s["sweep"] is None)
    visit.open("table-1")
    page.wait_for_timeout(400)
    before = tops(page)
    field = page.locator("[data-parameter=part_2] .number")
    field.fill("0.95")
    field.press("Enter")
    page.wait_for_selector(".failure:has-text('too thick')")
    assert tops(page) == before
    server.edit(MANY)
    server.wait_for(lambda s: s["sweep"] is None and not s["procedure"]["stale"])


def test_seventeen_parameters_fit_on_the_screen(visit: Visit) -> None:
    page = visit.page
    visit.open("table-1")
    section = page.locator(".parameters").bounding_box()
    rows = page.locator("[data-parameter]")
    assert rows.count() == 17 and section["height"] < 560
    for i in range(17):
        box_ = rows.nth(i).bounding_box()
        assert box_["height"] <= 32
        assert page.evaluate("row => row.scrollWidth <= row.clientWidth + 1", rows.nth(i).element_handle())
    number = page.locator("[data-parameter=height] .number")
    assert page.evaluate("field => field.scrollWidth <= field.clientWidth", number.element_handle())
    title = page.get_attribute("[data-parameter=height] .slider", "title")
    assert "Range: 0.3 to 1.2" in title and "Predicted before the search" in title


def test_an_address_of_a_reference_that_is_gone_says_so(visit: Visit) -> None:
    page = visit.page
    for odd in ("nobody", "%", "%E0%A4%A", "a%2Fb", "<b>", "table-1/more/%"):
        page.evaluate("odd => { location.hash = `inspect/${odd}`; }", odd)
        if odd.startswith("table-1"):
            page.wait_for_selector(".inspector h2[title='table-1']")
            continue
        page.wait_for_selector(".empty:has-text('There is no such reference')")
        assert page.locator("text=reading…").count() == 0
    page.evaluate("location.hash = 'inspect/nobody'")
    page.wait_for_selector(".empty:has-text('nobody')")
    page.click(".empty .button")
    page.wait_for_selector(".tile")
    page.evaluate("location.hash = 'inspect/nobody'")
    page.wait_for_selector(".empty:has-text('nobody')")
    page.reload()
    page.wait_for_selector(".empty:has-text('nobody')")
    page.wait_for_timeout(200)
    page.keyboard.press("Escape")
    page.wait_for_selector(".tile")


def test_a_reference_that_goes_while_it_is_open_says_so(server: Studio, visit: Visit) -> None:
    page = visit.page
    path = server.folder / "references" / "drum.ply"
    data = path.read_bytes()
    visit.open("drum")
    path.unlink()
    page.wait_for_selector(".empty:has-text('There is no such reference')")
    path.write_bytes(data)
    page.wait_for_selector(".inspector h2[title='drum']")
    # Its files are read anew now; the page asks again for what it could not have.
    visit.trouble[:] = [one for one in visit.trouble if "404" not in one]


def test_without_webgl_the_picture_follows_the_sliders(server: Studio, browser: Any) -> None:
    visit = Visit.of(server, browser)
    page = visit.page
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.reload()
    page.evaluate("location.hash = 'inspect/table-1'")
    page.wait_for_selector(".pictures img[alt=replica]")
    picture = page.locator(".pictures img[alt=replica]")
    visit.until("document.querySelector('.pictures img[alt=replica]').naturalWidth === 512")
    before, found = picture.screenshot(), picture.get_attribute("src")
    field = page.locator("[data-parameter=height] .number")
    field.fill("1.15")
    field.press("Enter")
    page.wait_for_selector(".pictures img[alt=replica][data-of*='1.15']")
    assert picture.screenshot() != before
    field.fill("1.6")  # beyond its Range: tried as well
    field.press("Enter")
    page.wait_for_selector(".pictures img[alt=replica][data-of*='1.6']")
    page.click("text=As found")
    page.wait_for_selector(".pictures img[alt=replica][data-of='null']")
    assert picture.get_attribute("src") == found
    visit.end()


def test_all_of_a_tile_can_be_clicked(visit: Visit) -> None:
    page = visit.page
    tile = page.locator(".tile:has([data-tile=drum])")
    tile.wait_for()
    for across, down in ((0.25, 0.3), (0.75, 0.3), (0.2, 0.95), (0.6, 0.95), (0.97, 0.95)):
        tile.scroll_into_view_if_needed()
        page.wait_for_timeout(200)
        area = tile.bounding_box()
        page.mouse.click(area["x"] + across * area["width"], area["y"] + down * area["height"])
        page.wait_for_selector(".inspector h2[title='drum']")
        page.wait_for_timeout(150)
        page.keyboard.press("Escape")
        page.wait_for_selector(".inspector", state="detached")


def suggested(server: Studio) -> None:
    run = server.folder / "runs" / server.get("/api/state")["collection"]["run"]
    (run / "suggestions").mkdir(exist_ok=True)
    shape = box((1, 0.4, 0.5)).mesh()
    points = np.array([[0.0, 0.2, 0.2], [0.2, 0.2, 0.1]])
    (run / "suggestions" / "1.png").write_bytes(card([Example(shape, points, shape, shape)]))
    added = "\n\ndef shelf(shape):\n" + "".join(f"    step_{i} = {i}\n" for i in range(40)) + "    return shape\n"
    source = MANY.replace("import Range, procedure", "import Range, When, procedure") + added
    one = {"kind": "new part", "title": "A shelf", "text": "", "snippet": "x", "source": source, "references": ["drum"]}
    record = {"references": {}, "suggestions": [{**one, "gain": 1, "picture": "suggestions/1.png"}]}
    (run / "explanation.json").write_text(json.dumps(record))
    server.wait_for(lambda s: s["explanation"])


def test_pictures_of_suggestions_have_the_ground_of_their_theme(server: Studio, visit: Visit) -> None:
    suggested(server)
    page = visit.page
    visit.go("feedback")
    page.wait_for_selector(".suggestion img")
    visit.until("document.querySelector('.suggestion img').naturalWidth > 0")
    for scheme, dark in (("dark", True), ("light", False)):
        page.emulate_media(color_scheme=scheme)
        page.wait_for_timeout(300)
        path = server.folder / "shot.png"
        page.locator(".suggestion img").screenshot(path=str(path))
        corner = np.asarray(Image.open(path).convert("L"))[4:10, 4:10]
        assert (corner.max() < 80) if dark else (corner.min() > 200)
    path.unlink()


def test_the_box_of_a_change_opens_at_what_is_new(server: Studio, visit: Visit) -> None:
    suggested(server)
    page = visit.page
    page.set_viewport_size({"width": 1440, "height": 900})
    visit.go("feedback")
    page.wait_for_selector(".part >> nth=1")
    shown = page.locator(".changes").bounding_box()
    line = page.locator("tr.added:has-text('def shelf(shape)')").bounding_box()
    assert shown["y"] <= line["y"] < shown["y"] + shown["height"] / 2


def test_a_fit_says_what_it_does_from_its_first_moment_on(server: Studio, browser: Any) -> None:
    """A fit loads for seconds before its first stage."""
    visit = Visit.of(server, browser)
    page = visit.page
    visit.go("loop")
    server.listen()
    server.send("POST", "/api/fit", {}, 202)
    page.wait_for_selector(".stages li.running b:text-is('open')")
    page.wait_for_selector(
        "[data-working=fit]:has-text('reads the references'), [data-working=fit] b:text-is('sample')"
    )
    assert page.locator("text=starting").count() == 0
    server.next(lambda m: m["type"] == "job" and m["job"]["stages"][-1]["name"] == "sample", 60)
    told = [m["job"]["stages"][0] for m in server.messages if m["type"] == "job" and m["job"]["state"] == "running"]
    assert told[0]["name"] == "open" and {stage["remark"] for stage in told} >= {
        "reads the procedure",
        "reads the references",
    }
    server.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done", 240)
    visit.end()


def test_errors_that_hold_a_value_are_one_problem(server: Studio, browser: Any) -> None:
    line = "    raise ValueError(f'height {height:.3f} of {form!r} does not go')\n    top = box"
    visit = Visit.of(server, browser)
    server.edit(MANY.replace("    top = box", line, 1))
    problems = server.wait_for(lambda s: sum(p["count"] or 0 for p in s["problems"]) == 4)["problems"]
    assert len(problems) == 1 and problems[0]["count"] == 4 and len(problems[0]["slugs"]) == 4
    visit.page.wait_for_selector(".problems:has-text('4 shapes')")
    assert visit.page.locator(".problem").count() == 1
    server.edit(MANY)
    server.wait_for(lambda s: not s["problems"] and not s["procedure"]["stale"])
    visit.page.wait_for_selector(".problems", state="detached")
    visit.end()
