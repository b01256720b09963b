"""Up and front that are to be found, in the studio: files that stand in several ways beside one procedure."""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from shapewright.axes.turns import TURNS
from shapewright.references import Collection, Orientation
from shapewright.rendering.thumbnails import thumbnail
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode
from shapewright.studio.project.listing import PICTURE
from studio_browser import Visit, chromium, missing
from studio_client import Studio, ready, studio

PROCEDURE = """
from typing import Annotated

from shapewright import Range, procedure
from shapewright.modelling.solids import box


@procedure
def seat(width: Annotated[float, Range(0.5, 1.5)] = 1.0, back: Annotated[float, Range(0.3, 1.0)] = 0.6):
    return box((width, 0.4, 1)) | box((width, back, 0.15), at=(0, 0.2 + back / 2, -0.4))
"""
GIVEN = {"a": 7, "b": 0, "c": 19, "d": 7}  # of TURNS
FIT = ("--samples", "60", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
FOUND = {name: Orientation().then(TURNS[turn].T) for name, turn in GIVEN.items()}


def shape(name: str) -> Mesh:
    """As it stands right."""
    made: Mesh = load_procedure_text()(width=0.7 + 0.1 * (ord(name) - ord("a")))
    return made


def load_procedure_text() -> Any:
    namespace: dict[str, Any] = {}
    exec(PROCEDURE, namespace)
    return namespace["seat"]


def make_project(folder: Path, names: str = "abcd") -> Path:
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    for name in names:
        (folder / "references" / f"{name}.obj").write_bytes(encode(shape(name).transformed(TURNS[GIVEN[name]]), "obj"))
    return folder


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    with studio(make_project(tmp_path_factory.mktemp("seats")), "--up", "auto", *FIT) as started:
        started.wait_for(drawn)
        yield started


def drawn(state: dict[str, Any]) -> bool:
    tiles = state["collection"]["tiles"]
    return ready(state) and bool(tiles) and all(tile["reference"] and tile["axes"] for tile in tiles)


def axes(state: dict[str, Any]) -> dict[str, Orientation]:
    tiles = state["collection"]["tiles"]
    return {tile["slug"]: Orientation(tile["axes"]["up"], tile["axes"]["front"]) for tile in tiles if tile["axes"]}


def unlike(running: Studio, slug: str, mesh: Mesh) -> float:
    """By how much the picture of a tile differs from one of a mesh that is normalised, 0 to 1."""
    tiles = {tile["slug"]: tile for tile in running.get("/api/state")["collection"]["tiles"]}
    shown = running.request("GET", tiles[slug]["reference"])[1]
    two = [Image.open(io.BytesIO(png)).convert("RGBA").resize((64, 64)) for png in (shown, thumbnail(mesh, PICTURE))]
    first, second = (np.asarray(picture, dtype=float)[..., 3] for picture in two)
    return float(np.abs(first - second).mean() / 255.0)


def fit(running: Studio) -> dict[str, Any]:
    before = len(running.get("/api/state")["runs"])
    running.send("POST", "/api/fit", {}, 202)
    return running.wait_for(lambda s: len(s["runs"]) > before and s["jobs"]["fit"]["state"] == "done" and drawn(s), 120)


def test_references_are_shown_as_they_are_found_to_stand(running: Studio) -> None:
    state = running.get("/api/state")
    assert axes(state) == FOUND
    assert {t["slug"]: t["axes"]["by"] for t in state["collection"]["tiles"]} == {
        "a": "found", "b": "default", "c": "found", "d": "found"
    }  # fmt: skip
    for name in GIVEN:
        right = shape(name).normalised()
        assert unlike(running, name, right) < 0.01
        assert unlike(running, name, right.transformed(TURNS[7])) > 0.03
        assert running.get(f"/api/references/{name}")["units"]["axes"] == FOUND[name].matrix.tolist()


def test_what_is_measured_is_measured_turned(running: Studio) -> None:
    running.listen()
    running.say(type="evaluate", id=1, slug="c", parameters={"width": 0.9, "back": 0.6})
    told = running.next(lambda m: m["type"] == "verdict" and m["id"] == 1)
    assert told["fidelity"] > 0.95 and told["distance"] < 0.01


@pytest.mark.skipif(missing() is not None, reason=str(missing()))
def test_an_author_sees_what_was_found_and_says_otherwise(running: Studio) -> None:
    with chromium() as browser:
        visit = Visit.of(running, browser)
        page = visit.page
        page.wait_for_selector("[data-axes]")
        assert f"{FOUND['a'].up} up, {FOUND['a'].front} front in 2, turned" in visit.text("[data-axes]")
        assert "y up, z front in 1, as the files have it" in visit.text("[data-axes]")
        page.evaluate("location.hash = 'inspect/b'")
        page.wait_for_selector(".told select[aria-label='Front']")
        assert visit.text(".told select[aria-label='Front'] option:first-child") == "as found: z"
        page.select_option(".told select[aria-label='Front']", "x")
        running.wait_for(lambda s: drawn(s) and axes(s)["b"] == Orientation("y", "x"))
        assert running.get("/api/references/b")["told"] == {"up": "y", "front": "x", "split": None, "unit": None}
        page.evaluate("location.hash = 'collection'")
        visit.until("document.querySelector('[data-axes]')?.innerText.includes('y up, x front in 1, as you say')")
        page.evaluate("location.hash = 'inspect/b'")
        page.select_option(".told select[aria-label='Front']", "as all")
        page.select_option(".told select[aria-label='Up']", "as all")
        running.wait_for(lambda s: drawn(s) and axes(s) == FOUND)
        visit.end()


def test_the_authors_word_wins_at_once_and_after_a_run(running: Studio) -> None:
    assert axes(fit(running)) == FOUND
    told = {"up": "x", "front": "-y", "split": None}
    running.send("PATCH", "/api/references", {"slugs": ["b"], "told": told})
    said = shape("b").normalised().transformed(Orientation("x", "-y").matrix)
    running.wait_for(
        lambda s: drawn(s) and axes(s)["b"] == Orientation("x", "-y") and unlike(running, "b", said) < 0.01
    )
    assert [each.axes_by for each in Collection.load(running.folder / "references", up="auto")][1] == "author"
    running.send("PATCH", "/api/references", {"slugs": ["b"], "told": {}})
    right = shape("b").normalised()
    running.wait_for(lambda s: drawn(s) and axes(s) == FOUND and unlike(running, "b", right) < 0.01)


def test_the_axes_of_a_run_win_over_a_new_guess(running: Studio) -> None:
    if not running.get("/api/state")["runs"]:
        fit(running)
    run = running.folder / "runs" / "001" / "iteration.json"
    record = json.loads(run.read_text())
    record["collection"]["axes"]["b"] |= {"up": "x", "front": "-y", "by": "found"}  # as if another procedure taught it
    run.write_text(json.dumps(record))
    (running.folder / "references" / "a.obj").touch()  # all are listed again
    state = running.wait_for(lambda s: drawn(s) and axes(s)["b"] == Orientation("x", "-y"))
    assert axes(state) == FOUND | {"b": Orientation("x", "-y")}
    told = shape("b").normalised().transformed(Orientation("x", "-y").matrix)
    running.wait_for(lambda s: drawn(s) and unlike(running, "b", told) < 0.01)
    assert running.get("/api/references/b")["units"]["axes"][1] == [1, 0, 0]


def test_a_studio_that_is_opened_again_shows_no_picture_unturned(tmp_path: Path) -> None:
    folder = make_project(tmp_path)
    with studio(folder, *FIT) as plain:  # whose pictures are kept as the files have them
        plain.wait_for(lambda s: ready(s) and all(t["reference"] for t in s["collection"]["tiles"]))
        assert unlike(plain, "a", shape("a").normalised()) > 0.03
    for _ in range(2):
        with studio(folder, "--up", "auto", *FIT) as again:
            seen: set[tuple[str, str]] = set()

            def note(state: dict[str, Any], seen: set[tuple[str, str]] = seen) -> bool:
                seen |= {(t["slug"], t["reference"]) for t in state["collection"]["tiles"] if t["reference"]}
                return drawn(state)

            again.wait_for(note)
            assert seen and all(unlike(again, slug, shape(slug).normalised()) < 0.01 for slug, _ in seen)
            assert len({hashlib.sha256(again.request("GET", url)[1]).digest() for _, url in seen}) == len(GIVEN)


def test_without_a_procedure_that_works_looks_decide_until_there_is_one(tmp_path: Path) -> None:
    folder = make_project(tmp_path)
    (folder / "procedure.py").write_text("broken(\n")
    with studio(folder, "--up", "auto", *FIT) as opened:
        opened.wait_for(lambda s: all(t["reference"] and t["axes"] for t in s["collection"]["tiles"]))
        opened.edit(PROCEDURE)
        opened.wait_for(lambda s: drawn(s) and axes(s) == FOUND)
