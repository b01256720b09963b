"""After a fit: how long it takes still, what comes next, suggestions part by part, cuts that marks ask for."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
import trimesh

from shapewright.procedures import load_procedure
from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
QUICK = ("--samples", "60", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
SLOW = PROCEDURE.replace("    top = box", "    import time\n\n    time.sleep(0.3)\n    top = box", 1)
WIDER = PROCEDURE.replace("Range(0.3, 1.2)", "Range(0.3, 2.0)")
BOTH = WIDER.replace("(0.8, 0.04, 0.6)", "(0.9, 0.04, 0.65)")
CHANGE = {"procedure": "table", "limits": [{"parameter": "height", "low": None, "high": "2.0", "steps": None}]}


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    """Tables that the procedure can make, two balls that it cannot, and a run."""
    folder = tmp_path_factory.mktemp("next")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    procedure = load_procedure(folder / "procedure.py")
    for i in range(4):
        made = procedure(height=0.4 + 0.2 * i, leg=0.1, shelf=bool(i % 2))
        trimesh.Trimesh(made.vertices, made.faces, process=False).export(folder / "references" / f"table-{i}.ply")
    for i, height in enumerate((1.0, 1.3)):
        trimesh.creation.cylinder(0.5, height).export(folder / "references" / f"drum-{i}.ply")
    with studio(folder, *QUICK) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {}, 202)
        started.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done", 240)
        yield started


@pytest.fixture
def mended(server: Studio) -> Iterator[Studio]:
    yield server
    server.save(PROCEDURE)
    server.wait_for(lambda s: ready(s) and not s["procedure"]["stale"])
    for path in server.folder.glob("procedure-*.py"):
        path.unlink()


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    visit = Visit.of(server, browser)
    yield visit
    visit.end()


def explained(server: Studio, *suggestions: dict[str, Any], tried: list[dict[str, Any]] | None = None) -> None:
    """Write what an explanation would say."""
    state = server.get("/api/state")
    run = server.folder / "runs" / state["collection"]["run"]
    full = [
        {"kind": "range", "text": "", "snippet": "x", "picture": None, "references": [], **one} for one in suggestions
    ]
    record = {"references": {}, "summary": [], "suggestions": full, "tried": tried or []}
    (run / "explanation.json").write_text(json.dumps(record))
    server.wait_for(lambda s: s["explanation"])


SUGGESTION = {"title": "A wider height", "source": BOTH, "change": CHANGE, "gain": 2, "tried": {"nearer": 1}}


def test_one_bar_says_in_every_view_how_long_work_takes_still(mended: Studio, browser: Any) -> None:
    visit = Visit.of(mended, browser)
    page = visit.page
    page.wait_for_selector(".tile")
    assert page.locator("[data-working]").count() == 0
    mended.save(SLOW)
    page.wait_for_selector("[data-working=sweep]:has-text('build')")
    assert "/12" in page.inner_text("[data-working=sweep]")
    mended.wait_for(lambda s: s["sweep"] is None and ready(s), 60)
    page.wait_for_selector("[data-working]", state="detached")
    assert "sweep" in json.loads((mended.folder / ".shapewright" / "timings.json").read_text())
    mended.send("PATCH", "/api/settings", {"samples": 40})
    mended.send("POST", "/api/fit", {"fresh": True}, 202)
    # The fit of before says how long this one is likely to take, from its first moment on.
    page.wait_for_selector(
        "[data-working=fit] [data-left]:has-text('left'), [data-working=fit] [data-left]:has-text('done')"
    )
    page.wait_for_selector("[data-working=fit] b:text-is('open')")
    for view in ("loop", "history", "feedback", "collection"):
        visit.go(view)
        page.wait_for_selector("[data-working=fit] [data-left]")
        assert page.locator(".progress-line [role=progressbar] i").bounding_box()["height"] >= 2
    page.set_viewport_size({"width": 400, "height": 800})
    shown = page.locator("[data-working=fit] [data-left]").bounding_box()
    assert shown["width"] > 40 and shown["x"] + shown["width"] <= 400
    page.set_viewport_size({"width": 1360, "height": 860})
    page.evaluate("location.hash = 'inspect/table-1'")
    page.wait_for_selector(".inspector h2[title='table-1']")
    page.wait_for_selector("[data-working=fit]")
    shares = []
    while mended.get("/api/state")["jobs"]["fit"]["state"] == "running":
        if (bar := page.locator("[role=progressbar][aria-label=fit]")).count():
            shares.append(int(bar.get_attribute("aria-valuenow") or 0))
        page.wait_for_timeout(250)
    assert all(0 <= share <= 100 for share in shares) and max(shares) > min(shares)
    # A sweep follows; an export is told in the same place.
    mended.wait_for(lambda s: s["sweep"] is None, 60)
    mended.send("POST", "/api/export", {"what": ["samples"], "count": 60}, 202)
    page.wait_for_selector("[data-working=export]")
    mended.wait_for(lambda s: s["jobs"]["export"]["state"] == "done", 60)
    page.wait_for_selector("[data-working]", state="detached")
    times = json.loads((mended.folder / ".shapewright" / "timings.json").read_text())
    assert times["fit"]["open"][0] > 0 and "samples" in times["export"]
    mended.send("PATCH", "/api/settings", {"samples": 60})
    visit.end()


def test_a_note_of_the_browser_tells_the_end_where_it_is_switched_on(server: Studio, browser: Any) -> None:
    visit = Visit.of(server, browser, permissions=["notifications"])
    page = visit.page
    page.add_init_script(
        "window.told = []; window.asked = 0; window.Notification = class { static permission = 'default';"
        " static async requestPermission() { window.asked += 1; return (this.permission = 'granted'); }"
        " constructor(title, { body }) { window.told.push(title + ' | ' + body); } };"
    )
    page.reload()
    page.wait_for_selector(".header")
    server.send("POST", "/api/export", {"what": ["parameters"]}, 202)
    server.wait_for(lambda s: s["jobs"]["export"]["state"] == "done", 60)
    page.wait_for_timeout(300)
    assert page.evaluate("[window.told, window.asked]") == [[], 0]
    visit.go("loop")
    switch = page.locator(".settings [role=switch] >> nth=2")
    switch.check()
    visit.until("window.asked === 1")
    server.send("POST", "/api/export", {"what": ["parameters"]}, 202)
    page.wait_for_selector("[data-working=export] button[aria-pressed=true]")
    server.wait_for(lambda s: s["jobs"]["export"]["state"] == "done", 60)
    visit.until("window.told.length === 1")
    assert "The export is done" in page.evaluate("window.told[0]")
    switch.uncheck()
    switch.check()
    visit.until("window.asked === 1")  # the browser is asked once
    switch.uncheck()
    server.send("POST", "/api/export", {"what": ["parameters"]}, 202)
    server.wait_for(lambda s: s["jobs"]["export"]["state"] == "done", 60)
    page.wait_for_timeout(300)
    assert page.evaluate("window.told.length") == 1
    visit.end()


def test_after_a_fit_one_sentence_and_one_button(mended: Studio, browser: Any) -> None:
    for path in (mended.folder / "runs").glob("*/explanation.json"):
        path.unlink()
    mended.wait_for(lambda s: not s["explanation"])
    visit = Visit.of(mended, browser)
    page, step = visit.page, mended.get("/api/next")
    page.wait_for_selector(".next[data-next=explain]")
    assert page.locator(".next .button").count() == 1
    words = page.inner_text(".next p")
    group = mended.get(f"/api/references/{step['group']}")
    assert f"{step['members']} reference" in words and group["name"] in words
    misfits = [
        tile["slug"] for tile in mended.get("/api/state")["collection"]["tiles"] if tile["grade"] != "replicated"
    ]
    lacking = {slug: mended.get(f"/api/references/{slug}")["missing"] for slug in misfits}
    longest = max(misfits, key=lambda slug: max((piece["size"] for piece in lacking[slug]), default=0.0))
    assert step["longest"] == longest
    page.click(f".next .link:has-text('{group['name']}') >> nth=0")
    page.wait_for_selector(f".inspector h2[title='{step['group']}']")
    page.keyboard.press("Escape")
    # What was tried and brought something is told, also where nothing is suggested.
    explained(
        mended, tried=[{"title": "A round top", "kind": "part replaced", "nearer": 2, "best": 1.4, "seconds": 1.0}]
    )
    page.wait_for_selector(".next:has-text('A round top'):has-text('2 references nearer')")
    assert page.get_attribute(".next", "data-next") == "inspect"
    explained(mended, SUGGESTION)
    page.wait_for_selector(".next[data-next=suggestion]:has-text('A wider height')")
    page.click(".next .button")
    page.wait_for_selector(".suggestion h3:has-text('A wider height')")
    visit.end()


def parts(page: Any) -> list[str]:
    found: list[str] = page.locator(".part label").all_inner_texts()
    return found


def test_a_suggestion_is_accepted_part_by_part(mended: Studio, browser: Any) -> None:
    explained(mended, SUGGESTION)
    path = mended.folder / "procedure.py"
    visit = Visit.of(mended, browser)
    page = visit.page
    visit.go("feedback")
    page.wait_for_selector(".part >> nth=1")
    assert len(parts(page)) == 2
    assert "Range(0.3, 2.0)" in page.inner_text("[data-part='0'] tr.added")
    colours = page.evaluate(
        "[...document.querySelectorAll('[data-part=\"0\"] tr')].map(row => getComputedStyle(row).backgroundColor)"
    )
    assert len(set(colours)) >= 3  # added, removed and the lines around
    page.locator("[data-part='0'] input").uncheck()
    page.click(".parts .button.primary:has-text('Apply 1 part')")
    page.wait_for_selector(".notice:has-text('A wider height')")
    assert path.read_text() == PROCEDURE.replace("(0.8, 0.04, 0.6)", "(0.9, 0.04, 0.65)")
    newest = mended.get("/api/revisions")[0]
    assert (newest["writer"], newest["of"]) == ("suggestion", "A wider height (1 of 2 parts)")
    # The other one is still there, and joins what is written meanwhile.
    visit.go("feedback")
    mended.edit("# mine\n" + path.read_text())
    page.wait_for_selector(".part label:has-text('the file has it'), .part label:has-text('of 1')")
    page.click(".parts .button.primary")
    mended.wait_for(lambda _: "Range(0.3, 2.0)" in path.read_text())
    assert path.read_text() == "# mine\n" + BOTH
    page.wait_for_selector("nav a[href='#loop'][aria-current]")  # it shows what was written
    visit.go("feedback")
    page.wait_for_selector(".parts .good, .suggestion .good:has-text('has all of it')")
    # Both are in the undo list.
    visit.go("history")
    page.wait_for_selector(".revisions li:has-text('A wider height') >> nth=1")
    mended.send("POST", f"/api/revisions/{newest['number']}/undo", {"digest": None})
    assert path.read_text() == PROCEDURE
    visit.end()


def test_a_part_that_does_not_fit_says_why_and_the_others_can_be_had(mended: Studio, browser: Any) -> None:
    explained(mended, SUGGESTION)
    path = mended.folder / "procedure.py"
    mended.edit(PROCEDURE.replace("Range(0.3, 1.2)", "Range(0.2, 1.1)"))
    visit = Visit.of(mended, browser)
    page = visit.page
    visit.go("feedback")
    page.wait_for_selector("[data-refused]:has-text('you have edited')")
    assert page.is_disabled("[data-part='0'] input")
    assert "does not fit: you have edited the same lines since (line 10)" in parts(page)[0]
    page.click(".parts .button:has-text('Apply to a copy')")
    page.wait_for_selector(".notice:has-text('procedure-1.py')")
    text = (mended.folder / "procedure-1.py").read_text()
    assert "Range(0.2, 1.1)" in text and "(0.9, 0.04, 0.65)" in text
    assert "(0.9, 0.04, 0.65)" not in path.read_text()
    # Parts of another text than the one on disk are refused, whoever asks.
    order = {"to": "procedure", "digest": "0" * 16, "hunks": [1]}
    assert "has changed" in mended.send("POST", "/api/suggestions/0/apply", order, 409)["error"]
    digest = mended.get("/api/source")["digest"]
    for hunks, why in (([0], "does not fit"), ([7], "no part"), ([-1], "no part")):
        order = {"to": "procedure", "digest": digest, "hunks": hunks}
        assert why in mended.send("POST", "/api/suggestions/0/apply", order, 409)["error"]
    assert "Range(0.2, 1.1)" in path.read_text()
    visit.end()


def test_marks_say_what_their_cut_would_change_and_a_button_uses_it(server: Studio, visit: Visit) -> None:
    tiles = [tile for tile in server.get("/api/state")["collection"]["tiles"] if tile["fidelity"] is not None]
    best = max(tiles, key=lambda tile: tile["fidelity"])
    worst = min(tiles, key=lambda tile: tile["fidelity"])
    for tile, same in ((best, True), (worst, False)):
        server.send("PATCH", "/api/marks", {"a": tile["slug"], "b": tile["slug"], "same": same})
    learned = server.get("/api/state")["marking"]["learned"]
    visit.go("feedback")
    page = visit.page
    page.wait_for_selector(".cut[data-cut=holds]")
    other = 0.999 if best["fidelity"] < 0.999 else 1.0
    server.send("PATCH", "/api/settings", {"replicated": other, "close": 0.01})
    page.wait_for_selector(".cut[data-cut=open]")
    now = server.get("/api/state")["collection"]["tiles"]
    better = [tile for tile in now if tile["fidelity"] is not None and tile["fidelity"] >= learned["cut"]]
    gained = [tile["name"] for tile in better if tile["grade"] != "replicated"]
    told = [f"{len(gained)} more would be replicated", gained[0]] if gained else ["no reference"]
    page.wait_for_selector(".cut" + "".join(f":has-text('{words}')" for words in told))
    page.click(".cut .button.primary")
    server.wait_for(lambda s: abs(s["settings"]["replicated"] - learned["cut"]) < 1e-6)
    page.wait_for_selector(".cut[data-cut=holds]")
    for tile in (best, worst):
        server.send("PATCH", "/api/marks", {"a": tile["slug"], "b": tile["slug"], "same": None})
    page.wait_for_selector(".cut", state="detached")


def test_the_report_opens_in_the_browser(server: Studio, visit: Visit) -> None:
    page = visit.page
    run = server.get("/api/state")["runs"][-1]["run"]
    visit.go("history")
    with page.context.expect_page() as opened:
        page.click(".run-facts >> text=Report")
    report = opened.value
    report.wait_for_selector("h1")
    assert f"/api/runs/{run}/report.html" in report.url and "table-1" in report.content()
    report.close()
    _, _, headers = server.request("GET", f"/api/runs/{run}/parameters.csv")
    assert headers["content-disposition"].startswith("attachment")


def test_more_of_history_and_feedback_is_filled(server: Studio, visit: Visit) -> None:
    """At 1440 pixels: what there is reaches over most of the width."""
    page = visit.page
    page.set_viewport_size({"width": 1440, "height": 900})
    for path in (server.folder / "runs").glob("*/explanation.json"):
        path.unlink()
    page.wait_for_selector(".next[data-next=explain]")
    visit.go("history")
    page.wait_for_selector(".run-times li >> nth=3")
    shown = "train" in page.inner_text(".run-times") and "samples " in page.inner_text(".run-times")
    box = page.locator(".run-times").bounding_box()
    assert shown and box["x"] + box["width"] > 1380 and box["y"] < 200
    visit.go("feedback")
    page.wait_for_selector(".misfits .twin")
    groups = server.get("/api/state")["collection"]["groups"]
    assert page.locator(".misfits .cause-row").count() == len(groups) > 0
    page.click(".misfits .twin >> nth=0")
    page.wait_for_selector(".inspector")
