"""An author's ways through the studio, in a headless Chromium.

Each fails on any error on the console and on any request off the machine.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

from shapewright.demo.meshes import write
from shapewright.settings import Settings
from studio_browser import Visit, missing
from studio_client import Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
EXAMPLES = Path(__file__).parents[2] / "examples" / "tables"
NAMES = {
    *("kitchen", "square", "parsons", "lamp", "round", "oval"),
    *("bistro", "tulip", "bench", "chest", "sawbuck", "altar"),
}
SHOWN = "document.querySelector('[data-figure=distance]').textContent"
QUICK = ("--samples", "200", "--epochs", "2", "--refine", "off", "--workers", "1")


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Twelve tables of the demo, and the first version of its procedure."""
    bundled = write(tmp_path_factory.mktemp("bundled"))
    folder = tmp_path_factory.mktemp("tables")
    (folder / "references").mkdir()
    for path in bundled:
        if path.stem in NAMES:
            shutil.copy(path, folder / "references")
    shutil.copy(EXAMPLES / "v1.py", folder / "procedure.py")
    return folder


@pytest.fixture(scope="module")
def server(project: Path) -> Iterator[Studio]:
    with studio(project, *QUICK) as started:
        yield started


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    server.wait_for(ready)
    visit = Visit.of(server, browser)
    yield visit
    visit.end()


@pytest.fixture
def fitted(server: Studio) -> dict[str, Any]:
    """The state after a fit at least, whichever journey made it."""
    state = server.wait_for(ready)
    if not state["runs"]:
        server.send("POST", "/api/fit", {"fresh": False}, 202)
    return server.wait_for(rested, 240)


def rested(state: dict[str, Any]) -> bool:
    """Whether there are results, and nothing is under way."""
    busy = state["jobs"]["fit"]["state"] in ("running", "cancelling")
    return (
        bool(state["runs"]) and not busy and ready(state) and not any(t["stale"] for t in state["collection"]["tiles"])
    )


def whole(state: dict[str, Any]) -> Callable[[dict[str, Any]], bool]:
    """Whether there is a run more than there was."""
    return lambda now: rested(now) and len(now["runs"]) > len(state["runs"])


def test_the_first_fit(visit: Visit) -> None:
    page = visit.page
    page.wait_for_selector(".tile")
    assert page.locator(".tile").count() == len(NAMES)
    page.click(".button.fit")
    page.wait_for_selector(".status.busy")
    page.wait_for_selector(".tile .badge:text-is('early')")
    visit.go("loop")
    page.wait_for_selector(".stages li")
    page.wait_for_selector(".curve path.train", timeout=240_000)
    visit.studio.wait_for(rested, 240)
    visit.go("collection")
    page.wait_for_selector(".score:has-text('replicated')")
    state = visit.studio.get("/api/state")["collection"]
    counts = state["counts"]
    assert page.inner_text(".score b") == str(counts["replicated"])
    assert f"{counts['close']} close" in page.inner_text(".score")
    assert f"paper's measure: {counts['compatible']} of {len(NAMES)}" in page.inner_text(".score")
    assert page.locator("[data-group]").count() == len(state["groups"]) > 0
    assert page.inner_text(".status").startswith("fitted in")


def test_a_group_opens_in_place(visit: Visit, fitted: dict[str, Any]) -> None:
    page, group = visit.page, fitted["collection"]["groups"][0]
    assert len(group["members"]) > 1
    slug = group["representative"]
    page.wait_for_selector(f"[data-group='{slug}'] .more")
    before = page.locator(".tile").count()
    page.click(f"[data-group='{slug}'] .more")
    shown = [tile.get_attribute("data-tile") for tile in page.locator(f"[data-group='{slug}'] [data-tile]").all()]
    assert set(shown) == set(group["members"])
    assert shown[0] == slug
    page.click(f"[data-group='{slug}'] >> text=Close")
    assert page.locator(".tile").count() == before


def test_the_collection_by_keyboard(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    page.wait_for_selector("[data-group]")
    focused = "document.activeElement.dataset.tile"
    page.keyboard.press("n")
    first = page.evaluate(focused)
    assert first == fitted["collection"]["groups"][0]["representative"]
    page.keyboard.press("o")
    page.wait_for_selector(".group.open")
    page.keyboard.press("n")
    second = page.evaluate(focused)
    assert second in fitted["collection"]["groups"][0]["members"] and second != first
    page.keyboard.press("Enter")
    page.wait_for_selector(f".inspector h2[title='{second}']")
    page.wait_for_timeout(300)  # its keys are listened to once it has been painted
    page.keyboard.press("ArrowLeft")
    page.wait_for_selector(f".inspector h2[title='{first}']")
    page.keyboard.press("?")
    page.wait_for_selector("dialog.help h3:text-is('Inspector')")
    page.keyboard.press("Escape")
    page.wait_for_selector("dialog.help", state="detached")
    page.keyboard.press("Escape")
    page.wait_for_selector(".inspector", state="detached")
    visit.until(f"{focused} === '{first}'")
    page.keyboard.press("/")
    page.keyboard.type("kitch")
    visit.until("document.querySelectorAll('.tile').length === 1")


def test_a_slider_changes_the_replica_and_its_distance(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.open("kitchen")
    page.wait_for_timeout(300)
    found, picture = visit.distance, page.locator("[data-stage]").screenshot()
    track = page.locator("[data-parameter=height] input[type=range]").bounding_box()
    middle, value = track["y"] + track["height"] / 2, page.locator("[data-parameter=height] .number")
    was = float(value.input_value())
    goal = 0.06 if was > 0.75 else 0.94
    page.mouse.move(track["x"] + (was - 0.5) / 0.5 * (track["width"] - 14) + 7, middle)
    page.mouse.down()
    page.mouse.move(track["x"] + track["width"] * goal, middle, steps=12)
    page.mouse.up()
    visit.until(f"{SHOWN} !== '{found:.3f}'.slice(1)")
    page.wait_for_selector(".figures:not(.waiting)")
    assert abs(float(value.input_value()) - was) > 0.1
    assert abs(visit.distance - found) > 0.01
    assert page.inner_text("[data-figure=grade]") in ("replicated", "close", "different")
    assert page.locator("[data-stage]").screenshot() != picture
    page.click("text=As found")
    visit.until(f"{SHOWN} === '{found:.3f}'.slice(1)")
    assert float(value.input_value()) == pytest.approx(was, abs=1e-3)


def test_changes_of_parameters_are_undone_and_a_field_shows_what_holds(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.open("kitchen")
    field = page.locator("[data-parameter=height] .number")
    found = field.input_value()

    def shows(value: str) -> None:
        try:
            visit.until(f"document.querySelector('[data-parameter=height] .number').value === '{value}'", 5)
        except AssertionError:
            raise AssertionError(f"{field.input_value()!r}, not {value!r}") from None

    field.fill("0.9")
    field.press("Enter")
    page.wait_for_timeout(1000)  # another step begins
    field.fill("0.7")
    field.press("Enter")
    field.press("Control+z")
    shows("0.9")
    field.press("Control+z")
    shows(found)
    field.press("Control+z")
    shows(found)
    field.press("Control+Shift+z")
    shows("0.9")
    field.fill("0.8")
    field.press("Control+z")  # typed, and not tried yet
    shows("0.9")
    field.fill("")
    field.press("Enter")
    shows("0.9")
    page.click("[data-own-undo] header [title^='Undo the last']")
    shows(found)
    page.wait_for_selector(".figures:not(.waiting)")


def test_a_value_beyond_the_range_is_tried_and_offered_as_a_wider_range(visit: Visit, fitted: dict[str, Any]) -> None:
    page, path = visit.page, visit.studio.folder / "procedure.py"
    before = path.read_text()
    visit.open("kitchen")
    page.wait_for_timeout(300)
    found, field = visit.distance, page.locator("[data-parameter=height] .number")
    field.fill("1.7")
    field.press("Enter")
    visit.until(f"{SHOWN} !== '{found:.3f}'.slice(1)")
    page.wait_for_selector(".figures:not(.waiting)")
    assert field.input_value() == "1.7"
    page.wait_for_selector("[data-parameter=height] .badge:has-text('beyond its Range')")
    page.click("[data-parameter=height] .beyond button")
    page.wait_for_selector(".cm-line:has-text('height: Annotated[float, Range(0.5, 1.7')")
    assert path.read_text() == before
    page.click("text=Discard")


def test_residuals_and_parts_are_coloured(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.open("kitchen")
    stage = page.locator("[data-stage]")
    plain = stage.screenshot()
    page.click("text=Residual")
    page.wait_for_selector(".legend.residual:has-text('of the largest extent')")
    page.wait_for_timeout(300)
    residual = stage.screenshot()
    page.click("text=Parts")
    page.wait_for_selector(".legend:has-text('legs')")
    page.wait_for_timeout(300)
    parts = stage.screenshot()
    assert len({plain, residual, parts}) == 3


def test_a_known_length_is_measured(visit: Visit, fitted: dict[str, Any], project: Path) -> None:
    page = visit.page
    file = next((project / "references").glob("kitchen.*"))
    own = trimesh.load(file, process=False).extents
    visit.open("kitchen")
    width, height, depth = own / own.max()
    assert width == 1.0
    page.keyboard.press("m")
    corner = height / 2, depth / 2
    visit.click_at("reference", (-0.5, *corner), off=(3, 2))
    visit.click_at("reference", (0.5, *corner), off=(-2, 3))
    assert visit.number("[data-measure='length normalised']") == pytest.approx(1.0, abs=1e-3)
    assert visit.number("[data-measure='dx normalised']") == pytest.approx(1.0, abs=1e-3)
    assert visit.number("[data-measure='dy normalised']") == pytest.approx(0.0, abs=1e-3)
    assert visit.number("[data-measure='length reference']") == pytest.approx(own.max(), rel=1e-3)
    visit.click_at("reference", (0.5, *corner), off=(2, -2))
    visit.click_at("reference", (0.5, -height / 2, depth / 2), off=(2, 2))
    assert visit.number("[data-measure='length normalised']") == pytest.approx(height, abs=1e-3)
    page.click("text=Propose as Range")
    page.wait_for_selector(".proposal code")
    page.click(".measure-card [title^='Stop']")
    page.keyboard.press("a")
    for point in ((-0.5, *corner), (0.5, *corner), (0.5, -height / 2, depth / 2)):
        visit.click_at("reference", point)
    assert visit.number(".measure-card .angle") == pytest.approx(90.0, abs=0.05)


def test_a_broken_file_is_told_and_mended(visit: Visit, fitted: dict[str, Any]) -> None:
    page, good = visit.page, (visit.studio.folder / "procedure.py").read_text()
    tiles = page.locator(".tile").count()
    visit.studio.save(good.replace("def table(", "def table(("))
    page.wait_for_selector(".problems")
    assert "procedure.py:" in page.inner_text(".problems")
    assert page.locator(".tile").count() == tiles > 0
    assert page.is_disabled(".button.fit")
    page.click(".problems .link.mono")
    page.wait_for_selector(".cm-lintRange-error, .cm-lint-marker-error")
    # At run time, with the author's own line.
    visit.studio.save(good.replace("    thick =", "    raise ValueError('too thin')\n    thick =", 1))
    page.wait_for_selector(".problems:has-text('too thin')")
    raised = good.split("    thick =")[0].count("\n") + 1
    assert f"procedure.py:{raised}" in page.inner_text(".problems")
    visit.studio.save(good)
    page.wait_for_selector(".problems", state="detached", timeout=60_000)
    visit.studio.wait_for(rested, 240)


def test_the_editor_in_the_page(visit: Visit, fitted: dict[str, Any]) -> None:
    page, path = visit.page, visit.studio.folder / "procedure.py"
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": False})
    good = path.read_text()
    visit.go("loop")
    page.wait_for_selector(".cm-line")
    page.click(".cm-content")
    page.keyboard.press("Control+End")
    page.keyboard.type("\n# seen to\n")
    page.wait_for_selector(".editor header:has-text('not saved')")
    assert path.read_text() == good
    page.keyboard.press("Control+s")
    page.wait_for_selector(".editor header:not(:has-text('not saved'))")
    assert "# seen to" in path.read_text()
    # Another program writes while there are edits here: nothing is lost without asking.
    page.keyboard.type("# mine\n")
    visit.studio.save(good + "\n# theirs\n")
    page.wait_for_selector(".conflict")
    page.click("text=Take the file's text")
    page.wait_for_selector(".cm-line:has-text('# theirs')")
    visit.studio.save(good)
    page.wait_for_selector(".cm-line:has-text('# theirs')", state="detached")
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": True})
    visit.studio.wait_for(rested, 240)


def test_what_is_typed_survives_a_reload_and_escape_runs_no_command(visit: Visit, fitted: dict[str, Any]) -> None:
    page, path = visit.page, visit.studio.folder / "procedure.py"
    good = path.read_text()
    visit.go("loop")
    page.wait_for_selector(".cm-line")
    page.click(".cm-content")
    page.keyboard.press("Control+End")
    page.keyboard.type("\n# half a thought")
    page.keyboard.press("Escape")
    page.keyboard.type("fd1?")
    assert page.locator(".loop .editor").count() == 1 and page.locator("dialog").count() == 0
    assert visit.studio.get("/api/state")["jobs"]["fit"]["state"] != "running"
    visit.go("collection")
    page.wait_for_selector("nav .unsaved")
    page.reload()
    page.wait_for_selector(".notice:has-text('did not save')")
    page.click(".notice >> text=Open")
    page.wait_for_selector(".cm-line:has-text('# half a thought')")
    page.wait_for_selector(".editor header:has-text('not saved')")
    assert path.read_text() == good
    page.click("text=Discard")
    page.wait_for_selector(".cm-line:has-text('# half a thought')", state="detached")
    page.click(".notice:has-text('given up') >> text=Undo")
    page.wait_for_selector(".cm-line:has-text('# half a thought')")
    page.click("text=Discard")
    page.reload()
    page.wait_for_selector(".cm-line")
    assert page.locator(".cm-line:has-text('# half a thought')").count() == page.locator("nav .unsaved").count() == 0


def test_a_deleted_file_is_written_again_from_the_editor(visit: Visit, fitted: dict[str, Any]) -> None:
    page, path = visit.page, visit.studio.folder / "procedure.py"
    good = path.read_text()
    visit.go("loop")
    page.wait_for_selector(".cm-line")
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": False})
    path.unlink()
    page.wait_for_selector(".editor .conflict:has-text('not there any more')")
    page.reload()
    page.wait_for_selector(".editor .conflict:has-text('not there any more')")
    page.wait_for_selector(".cm-line:has-text('def table')")
    page.click("text=Save it as a new file")
    page.wait_for_selector(".notice:has-text('procedure-1.py')")
    assert (visit.studio.folder / "procedure-1.py").read_text() == good
    (visit.studio.folder / "procedure-1.py").unlink()
    page.click("text=Write it again")
    page.wait_for_selector(".editor .conflict", state="detached")
    assert path.read_text() == good
    visit.studio.wait_for(rested, 240)
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": True})


def test_changes_of_the_procedure_are_listed_and_undone_after_a_restart(
    visit: Visit, fitted: dict[str, Any], browser: Any
) -> None:
    path = visit.studio.folder / "procedure.py"
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": False})
    good = path.read_text()
    digest = visit.studio.get("/api/source")["digest"]
    visit.studio.send("PUT", "/api/source", {"text": good + "\n# mine\n", "digest": digest})
    visit.studio.wait_for(lambda s: ready(s) and s["procedure"]["digest"] != digest)
    visit.studio.save(good + "\n# mine\n# theirs\n")
    visit.studio.wait_for(lambda s: visit.studio.get("/api/revisions")[0]["writer"] == "another program")
    with studio(visit.studio.folder, *QUICK, "--no-auto-fit") as again:
        later = Visit.of(again, browser)
        later.go("history")
        newest = later.page.locator(".revisions li").first
        newest.wait_for()
        assert "saved by another program" in newest.inner_text()
        newest.locator(".what").click()
        later.page.wait_for_selector(".revisions .diff tr.added:has-text('# theirs')")
        later.page.locator(".revisions li").nth(1).locator("text=Undo to here").click()
        later.page.wait_for_selector(".notice:has-text('as it was before')")
        assert path.read_text() == good
        later.page.click(".notice >> text=Undo")
        again.wait_for(lambda _: "# theirs" in path.read_text())
        later.page.wait_for_selector(".revisions li:nth-child(2):has-text('undid change')")
        later.end()
    visit.studio.save(good)
    visit.studio.wait_for(rested, 240)
    visit.studio.send("PATCH", "/api/settings", {"auto_fit": True})


def test_a_fit_is_begun_by_a_key_with_a_modifier_and_single_keys_can_be_switched_off(
    visit: Visit, fitted: dict[str, Any]
) -> None:
    page = visit.page
    page.wait_for_selector(".tile")
    page.keyboard.press("f")
    page.wait_for_timeout(200)
    assert visit.studio.get("/api/state")["jobs"]["fit"]["state"] != "running"
    page.keyboard.press("Control+Enter")
    visit.studio.wait_for(lambda s: s["jobs"]["fit"]["state"] == "running")
    page.click(".button.fit:has-text('Cancel')")
    visit.studio.wait_for(rested)
    page.keyboard.press("?")
    page.locator("dialog.help [role=switch]").uncheck()
    page.keyboard.press("Escape")
    page.keyboard.press("2")
    page.keyboard.press("?")
    page.reload()
    page.wait_for_selector(".tile")
    page.keyboard.press("2")
    page.wait_for_timeout(200)
    assert page.locator(".loop").count() == page.locator("dialog").count() == 0


def test_a_fit_is_cancelled(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.studio.send("PATCH", "/api/settings", {"samples": 3000, "epochs": 200})
    visit.go("loop")
    page.click("text=Fit afresh")
    page.wait_for_selector(".stages li.running")
    page.click("text=Cancel the fit")
    page.wait_for_selector(".fit-pane header:has-text('cancelled after')", timeout=60_000)
    assert page.locator(".stages li.broken").count() == 1 and page.locator(".stages li.running").count() == 0
    assert "cancelled here" in page.inner_text(".stages li:last-child")
    assert page.inner_text(".status") == f"run {fitted['collection']['run']}"
    visit.studio.send("PATCH", "/api/settings", {"samples": 200, "epochs": 2})
    state = visit.studio.wait_for(rested)
    assert [run["run"] for run in state["runs"]] == [run["run"] for run in fitted["runs"]]
    visit.go("collection")
    page.wait_for_selector("[data-group]")
    assert page.locator("[data-group]").count() > 0


def test_elapsed_time_goes_on_while_the_server_says_nothing(visit: Visit, fitted: dict[str, Any]) -> None:
    page, silent = visit.page, {"now": False}

    def between(socket: Any) -> None:
        server = socket.connect_to_server()
        server.on_message(lambda message: None if silent["now"] else socket.send(message))

    page.route_web_socket("**/api/live", between)
    page.reload()
    page.wait_for_selector(".tile")
    visit.studio.send("PATCH", "/api/settings", {"samples": 3000, "epochs": 200})
    visit.go("loop")
    page.click("text=Fit afresh")
    page.wait_for_selector(".stages li.running")
    silent["now"] = True
    page.wait_for_timeout(300)
    shown = page.inner_text(".fit-pane header p"), page.inner_text(".stages li.running .time")
    page.wait_for_timeout(1500)
    assert page.inner_text(".fit-pane header p") != shown[0]
    assert page.inner_text(".stages li.running .time") != shown[1]
    visit.studio.send("POST", "/api/cancel", {"kind": "fit"}, 202)
    visit.studio.send("PATCH", "/api/settings", {"samples": 200, "epochs": 2})
    visit.studio.wait_for(rested)


def test_two_iterations_are_compared(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.studio.send("PATCH", "/api/settings", {"refine": "quick"})  # without it neither version replicates a table
    visit.studio.save((EXAMPLES / "v5.py").read_text())
    state = visit.studio.wait_for(whole(fitted), 240)
    visit.studio.send("PATCH", "/api/settings", {"refine": "off"})
    visit.go("history")
    page.wait_for_selector(".chart .after")
    assert page.locator(".chart li").count() == len(state["runs"])
    page.wait_for_selector(".moves")
    before, after = state["runs"][-2]["run"], state["runs"][-1]["run"]
    truth = visit.studio.get(f"/api/compare?before={before}&after={after}")
    moved = sum(len(truth[kind]) for kind in ("gained", "lost", "closer", "further"))
    assert page.locator(".tile.move").count() == moved > 0
    assert "pedestal" in page.inner_text(".diff")
    page.click("text=Whole file")
    assert page.locator(".diff tr:not(.gap)").count() == len(truth["diff"])
    # Back to the version before, and forward again.
    page.locator(".chart button").nth(-2).click()
    page.wait_for_selector(".run-facts:has-text('Run " + before + "')")
    page.click("text=Go back to its procedure")
    page.wait_for_selector(".notice:has-text('again')")
    assert "pedestal" not in (visit.studio.folder / "procedure.py").read_text()
    page.click(".notice >> text=Undo")
    visit.studio.wait_for(lambda _: "pedestal" in (visit.studio.folder / "procedure.py").read_text())
    visit.studio.wait_for(rested, 240)


def test_marks_and_export(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    visit.open("kitchen")
    page.click(".judgement >> text=the same")
    page.wait_for_selector(".judgement:has-text('1 pair marked')")
    page.keyboard.press("Escape")
    visit.go("feedback")
    page.wait_for_selector(".marks li:has-text('kitchen')")
    page.click(".marks [title^='Take this mark']")
    page.wait_for_selector(".marks", state="detached")
    page.click("text=Export")
    for name, on in (("Replicas", False), ("Parameters", True)):
        page.set_checked(f".popover label:has-text('{name}') input", on)
    page.click(".popover .button.primary")
    page.wait_for_selector(".popover a[download]", timeout=60_000)
    with page.expect_download() as download:
        page.click(".popover a[download]")
    assert Path(download.value.path()).stat().st_size > 100


def test_pairs_that_decide_most_are_marked_and_move_the_cut(visit: Visit, fitted: dict[str, Any]) -> None:
    page, studio = visit.page, visit.studio
    sure = [tile for tile in fitted["collection"]["tiles"] if tile["fidelity"] is not None]
    middle = sorted(tile["fidelity"] for tile in sure)[len(sure) // 2]
    cut = min(max(middle, 0.05), 0.95)
    studio.send("PATCH", "/api/settings", {"close": min(0.04, cut), "replicated": cut})
    asked = studio.get("/api/state")["marking"]["asked"]
    assert asked
    page.wait_for_selector(f".asking:has([data-asked='{asked[-1]}'])")
    assert [pair.get_attribute("data-asked") for pair in page.locator("[data-asked]").all()] == asked
    page.click(f"[data-asked='{asked[0]}'] >> text='not the same'")
    page.wait_for_selector(f"[data-asked='{asked[0]}']", state="detached")
    page.wait_for_selector(".asking [role=status]:has-text('1 of 1 mark')")
    state = studio.get("/api/state")
    assert state["marking"]["learned"]["cut"] == state["collection"]["replicated"] == state["settings"]["replicated"]
    assert page.inner_text(".score b") == str(state["collection"]["counts"]["replicated"])
    page.click(".asking >> text=Undo")
    state = studio.wait_for(lambda now: not now["marking"]["marks"])
    assert state["settings"]["replicated"] == Settings.replicated


def test_forty_opens_leave_nothing_on_the_graphics_card(visit: Visit, fitted: dict[str, Any]) -> None:
    page = visit.page
    slugs = [tile["slug"] for tile in fitted["collection"]["tiles"]]
    visit.open(slugs[0])
    first = visit.gpu()
    assert first["contexts"] == 1
    for number in range(1, 41):
        if number % 2:
            page.keyboard.press("Escape")
            page.wait_for_selector(".inspector", state="detached")
            visit.until("window.shapewright.gpu().contexts === 0")
        visit.open(slugs[number % len(slugs)])
        if number % 5 == 0:
            page.keyboard.press("v")
    assert visit.gpu() == {name: pytest.approx(count) for name, count in first.items()}


def test_without_webgl_pictures_are_shown(server: Studio, browser: Any, fitted: dict[str, Any]) -> None:
    visit = Visit.of(server, browser)
    visit.page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    visit.page.reload()
    visit.page.evaluate("location.hash = 'inspect/kitchen'")
    visit.page.wait_for_selector(".pictures img")
    loaded = "[...document.querySelectorAll('.pictures img')].every(i => i.complete && i.naturalWidth === 512)"
    visit.until(loaded)
    visit.end()


DRAWINGS = """
from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.drawing import box


@procedure
def table(
    height: Annotated[float, Range(0.4, 1.2)] = 0.7,
    leg: Annotated[float, Range(0.05, 0.2)] = 0.1,
):
    top = box((1, 0.1), at=(0, height - 0.05))
    return top | box((leg, height), at=(0.5 - leg / 2, height / 2)).mirror("x", keep=True)
"""


def svg(height: float, leg: float, shelf: bool) -> str:
    """The front of a table, 100 wide, on a page of its own."""
    parts = [(0, 0, 100, 10), (0, 0, leg, height), (100 - leg, 0, leg, height)]
    if shelf:
        parts.append((0, height / 2, 100, 8))
    boxes = "".join('<rect x="{}" y="{}" width="{}" height="{}"/>'.format(*part) for part in parts)
    return f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-10 -10 120 {height + 20}">{boxes}</svg>'


def test_drawings(browser: Any, tmp_path: Path) -> None:
    (tmp_path / "references").mkdir()
    for i in range(8):
        text = svg(45 + 8 * i, 6 + 2 * (i % 4), shelf=i % 3 == 0)
        (tmp_path / "references" / f"front-{i}.svg").write_text(text)
    (tmp_path / "procedure.py").write_text(DRAWINGS)
    with studio(tmp_path, *QUICK) as server:
        server.wait_for(ready)
        visit = Visit.of(server, browser)
        page = visit.page
        page.wait_for_selector(".tile")
        page.click(".button.fit")
        state = server.wait_for(rested, 240)
        page.wait_for_selector(".score:has-text('replicated')")
        assert state["dimension"] == 2
        visit.open("front-3")
        page.wait_for_selector(".plane.beside .sheet path >> nth=1", state="attached")
        assert page.locator(".plane .sheet").count() == 2
        page.click("text=Overlay")
        page.wait_for_selector(".sheet .reference + .replica", state="attached")
        page.click("text=Difference")
        page.wait_for_selector(".sheet .missing", state="attached")
        outline = page.get_attribute(".sheet .missing", "d")
        found = visit.distance
        slider = page.locator("[data-parameter=height] input[type=range]")
        slider.focus()
        for _ in range(40):
            page.keyboard.press("ArrowLeft" if float(slider.input_value()) > 0.8 else "ArrowRight")
        visit.until(f"{SHOWN} !== '{found:.3f}'.slice(1)")
        assert page.get_attribute(".sheet .missing", "d") != outline
        visit.end()


def test_trouble_is_noticed(server: Studio, browser: Any) -> None:
    """The journeys' own alarm goes off."""
    visit = Visit.of(server, browser)
    visit.page.evaluate("console.error('a trial')")
    visit.page.evaluate("fetch('http://127.0.0.1:9/nothing').catch(() => 0)")
    visit.page.wait_for_timeout(200)
    with pytest.raises(AssertionError):
        visit.end()
    assert any("a trial" in one for one in visit.trouble)
    assert np.any(["127.0.0.1:9" in one for one in visit.trouble])
