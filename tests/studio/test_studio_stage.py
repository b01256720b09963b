"""The stage of the inspector: how shapes are drawn there, pictures to take away, and a million triangles."""

from __future__ import annotations

from collections.abc import Iterator
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image

from boxes import CORNERS, TRIANGLES
from shapewright.shapes import Mesh
from shapewright.shapes.files import encode
from studio_browser import Visit, missing
from studio_client import PROCEDURE, Studio, ready, studio

pytestmark = [
    pytest.mark.skipif(missing() is not None, reason=str(missing())),
    pytest.mark.timeout(600),
]
SIZE = (1.0, 0.5, 0.8)
"""Of the box that is the reference."""
Point = tuple[float, float, float]


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("boxes")
    (folder / "references").mkdir()
    (folder / "references" / "block.ply").write_bytes(encode(block(), "ply"))
    (folder / "references" / "million.ply").write_bytes(encode(dense(500), "ply"))
    (folder / "procedure.py").write_text(PROCEDURE)
    with studio(folder, "--no-auto-fit") as started:
        yield started


@pytest.fixture
def visit(server: Studio, browser: Any) -> Iterator[Visit]:
    server.wait_for(ready)
    visit = Visit.of(server, browser)
    yield visit
    visit.end()


def block() -> Mesh:
    return Mesh(np.array(CORNERS) / [1, 2, 3] * SIZE, np.array(TRIANGLES))


def dense(rows: int) -> Mesh:
    """An ellipsoid with waves, of four triangles times the square of the rows."""
    turn, tilt = np.meshgrid(np.linspace(0, 2 * np.pi, 2 * rows, endpoint=False), np.linspace(0, np.pi, rows + 1))
    radius = 0.5 * (1 + 0.1 * np.sin(9 * turn) * np.sin(7 * tilt))
    axes = np.sin(tilt) * np.cos(turn), np.cos(tilt), 0.6 * np.sin(tilt) * np.sin(turn)
    vertices = np.stack([radius * axis for axis in axes], axis=-1).reshape(-1, 3)
    row, column = np.meshgrid(np.arange(rows), np.arange(2 * rows), indexing="ij")
    a, b = row * 2 * rows + column, row * 2 * rows + (column + 1) % (2 * rows)
    c, d = a + 2 * rows, b + 2 * rows
    faces = np.stack([np.stack([a, b, c], -1), np.stack([b, d, c], -1)]).reshape(-1, 3)
    return Mesh(vertices, faces)


def seen(visit: Visit, point: Point, side: str = "reference") -> np.ndarray[Any, np.dtype[np.float64]]:
    at = visit.page.evaluate("([side, point]) => window.shapewright.seen(side, point)", [side, list(point)])
    return np.array([at["x"], at["y"]])


def pixels(visit: Visit) -> np.ndarray[Any, np.dtype[np.float64]]:
    """The reference's half of the stage, without what lies over it at its edges."""
    box = visit.page.locator("[data-stage]").bounding_box()
    clip = {"x": box["x"] + 10, "y": box["y"] + 40, "width": box["width"] / 2 - 20, "height": box["height"] - 80}
    shot = Image.open(BytesIO(visit.page.screenshot(clip=clip))).convert("L")
    return np.asarray(shot, dtype=float)


def switch(visit: Visit, name: str) -> None:
    visit.page.click(".tools >> text=Stage")
    visit.page.click(f".stage-tools label:has-text('{name}')")
    visit.page.keyboard.press("Escape")
    visit.page.wait_for_selector(".stage-tools", state="detached")
    visit.page.wait_for_timeout(150)


def test_wireframe_grid_and_axes_are_drawn_and_taken_away(visit: Visit) -> None:
    visit.open("block")
    plain = pixels(visit)
    switch(visit, "Wireframe")
    wired = pixels(visit)
    changed = np.abs(wired - plain) > 12
    assert 50 < changed.sum() < 0.1 * changed.size, "the diagonals of the box, and not more"
    switch(visit, "Grid and axes")
    assert [text.inner_html() for text in visit.page.locator(".axis-names text").all()] == [*"xyz", *"xyz"]
    assert (np.abs(pixels(visit) - wired) > 12).sum() > 500
    visit.page.keyboard.press("g")
    visit.page.keyboard.press("w")
    visit.page.wait_for_selector(".axis-names", state="detached")
    visit.page.wait_for_timeout(150)
    assert np.abs(pixels(visit) - plain).max() < 3


def test_without_perspective_what_is_equally_long_looks_so(visit: Visit) -> None:
    visit.open("block")

    def lengths() -> list[float]:
        ends = [((-0.5, -0.25, z), (0.5, -0.25, z)) for z in (-0.4, 0.4)]
        return [float(np.linalg.norm(seen(visit, a) - seen(visit, b))) for a, b in ends]

    far, near = lengths()
    assert near > 1.05 * far
    switch(visit, "Orthographic")
    far, near = lengths()
    assert near == pytest.approx(far, rel=1e-6)
    assert distance(visit, (-0.5, 0.25, 0.4), (0.5, 0.25, 0.4)) == 1.0
    visit.page.keyboard.press("o")


def distance(visit: Visit, *ends: Point) -> float:
    visit.page.click("[role=radio]:has-text('Orbit')")
    visit.page.click("[role=radio]:has-text('Distance')")
    for end in ends:
        visit.click_at("reference", end)
    found = float(visit.page.inner_text("[data-measure='length normalised']"))
    visit.page.click("[role=radio]:has-text('Orbit')")
    return found


def test_a_section_cuts_and_what_it_cuts_away_is_not_measured(visit: Visit) -> None:
    visit.open("block")
    assert distance(visit, (0.5, 0.25, 0.4), (0.5, -0.25, 0.4)) == 0.5
    visit.page.click(".tools >> text=Stage")
    visit.page.click(".section-tools [role=radio]:text-is('x')")
    visit.page.keyboard.press("Escape")
    visit.page.wait_for_timeout(150)
    visit.page.click("[role=radio]:has-text('Distance')")
    for kind in ("box", "edge"):
        visit.page.click(f".measure-card label:has-text('{kind}')")
    visit.click_at("reference", (0.5, 0.25, 0.4))
    assert visit.page.locator(".measure .point").count() == 0
    visit.click_at("reference", (-0.5, 0.25, 0.4))
    assert visit.page.locator(".measure .point").count() == 2, "drawn in both halves"
    for kind in ("box", "edge"):
        visit.page.click(f".measure-card label:has-text('{kind}')")
    visit.page.keyboard.press("Escape")
    visit.page.click(".tools >> text=Stage")
    visit.page.fill(".section-tools input[type=range]", "0.4")
    visit.page.click(".section-tools label:has-text('other side')")
    assert visit.text(".section-tools output") == ".40"
    visit.page.click(".section-tools [role=radio]:text-is('Whole')")


def test_fitted_shapes_fill_the_pane_at_any_size_and_zoom(visit: Visit) -> None:
    visit.open("block")

    def filled() -> tuple[float, float]:
        corners = [(x, y, z) for x in (-0.5, 0.5) for y in (-0.25, 0.25) for z in (-0.4, 0.4)]
        spots = np.array([seen(visit, corner) for corner in corners])
        box = visit.page.locator("[data-stage]").bounding_box()
        low, high = spots.min(axis=0), spots.max(axis=0)
        inside = np.all(low >= [box["x"], box["y"]]) and np.all(
            high <= [box["x"] + box["width"] / 2, box["y"] + box["height"]]
        )
        assert inside, (low, high, box)
        return tuple((high - low) / [box["width"] / 2, box["height"]])  # type: ignore[return-value]

    for _ in range(3):
        visit.page.keyboard.press("+")
    with pytest.raises(AssertionError):
        filled()
    visit.page.click("[title^='Fit both shapes']")
    assert max(filled()) > 0.6
    for size in ((1700, 700), (900, 900), (700, 1000)):
        visit.page.set_viewport_size({"width": size[0], "height": size[1]})
        visit.page.wait_for_timeout(250)
        assert max(filled()) > 0.6, size
    visit.page.keyboard.press("o")
    visit.page.keyboard.press("-")
    visit.page.keyboard.press(".")
    assert max(filled()) > 0.6
    visit.page.keyboard.press("o")


def test_either_shape_of_an_overlay_can_be_seen_through(visit: Visit) -> None:
    visit.open("block")
    visit.page.keyboard.press("b")
    visit.page.wait_for_timeout(150)
    solid = pixels(visit)
    visit.page.fill("input[aria-label='Opacity of the reference']", "0.2")
    visit.page.wait_for_timeout(150)
    faint = pixels(visit)
    assert np.abs(solid - faint).max() > 20
    visit.page.fill("input[aria-label='Opacity of the replica']", "1")
    visit.page.wait_for_timeout(150)
    assert np.abs(pixels(visit) - faint).max() > 20
    visit.page.fill("input[aria-label='Opacity of the reference']", "1")
    visit.page.keyboard.press("b")


def test_a_picture_and_a_turntable_are_files(visit: Visit) -> None:
    visit.open("block")
    visit.page.click(".tools >> text=Stage")
    with visit.page.expect_download() as download:
        visit.page.click(".stage-tools >> text=Picture")
    assert download.value.suggested_filename == "block.png"
    picture = Image.open(download.value.path()).convert("L")
    stage = visit.page.locator("[data-stage]").bounding_box()
    assert picture.size == (round(stage["width"]), round(stage["height"]))
    assert np.asarray(picture).std() > 5
    before = seen(visit, (0.5, 0.25, 0.4))
    with visit.page.expect_download() as download:
        visit.page.click(".stage-tools >> text=Turntable")
    assert download.value.suggested_filename == "block.gif"
    film = Image.open(download.value.path())
    assert (film.format, film.n_frames, film.info["loop"]) == ("GIF", 36, 0)
    frames = []
    for number in (0, 9, 18):
        film.seek(number)
        frames.append(np.asarray(film.convert("L"), dtype=float))
    assert np.abs(frames[0] - frames[1]).mean() > 1
    # Half a turn of a box looks the same, in the right half, too; the light turns with the eye.
    left = frames[0].shape[1] // 2
    assert np.abs(frames[0] - frames[2])[:, :left].mean() < 0.5
    still = np.asarray(picture.resize(film.size), dtype=float)
    assert np.abs(frames[0] - still).mean() < 3, "colours are those of the picture"
    assert seen(visit, (0.5, 0.25, 0.4)) == pytest.approx(before, abs=0.5)


def test_a_contact_sheet_of_the_collection_is_a_file(visit: Visit) -> None:
    visit.page.wait_for_selector(".tile")
    visit.studio.wait_for(lambda s: all(tile["reference"] for tile in s["collection"]["tiles"]), 120)
    with visit.page.expect_download() as download:
        visit.page.click("[title^='Contact sheet']")
    whole = np.asarray(Image.open(download.value.path()).convert("L"), dtype=float)
    visit.page.fill("input[type=search]", "block")
    visit.page.wait_for_timeout(200)
    with visit.page.expect_download() as download:
        visit.page.click("[title^='Contact sheet']")
    one = np.asarray(Image.open(download.value.path()).convert("L"), dtype=float)
    assert whole.size > 1.5 * one.size, "what is filtered away is not on it"
    reference, replica = one[100:300, :300], one[100:300, 330:]
    assert reference.std() > 5 > replica.std(), "nothing has been fitted yet"


def test_a_million_triangles_are_drawn_by_fewer_and_measured_exactly(visit: Visit) -> None:
    visit.studio.wait_for(lambda s: all(tile["reference"] for tile in s["collection"]["tiles"]), 120)
    page = visit.page
    page.evaluate("location.hash = 'inspect/million'")
    visit.until("(window.shapewright.faces()?.reference.measured ?? 0) >= 999000", 120)
    faces = page.evaluate("window.shapewright.faces().reference")
    assert 60_000 < faces["drawn"] < 115_000
    assert len(page.workers) == 1, "another thread makes it ready"
    page.wait_for_timeout(300)
    assert pixels(visit).std() > 5
    mesh = dense(500).normalised()
    eye = np.array([0.52, 0.42, 0.74])
    outward = mesh.vertices @ eye
    a, b = (tuple(mesh.vertices[i]) for i in (outward.argmax(), outward.argsort()[-40_000]))
    truth = float(np.linalg.norm(np.subtract(a, b)))
    assert distance(visit, a, b) == pytest.approx(truth, abs=0.012)  # eleven pixels hold several vertices


def test_a_large_reference_is_answered_while_the_bench_is_busy(server: Studio) -> None:
    server.wait_for(lambda s: ready(s) and all(tile["reference"] for tile in s["collection"]["tiles"]), 120)
    home = server.folder / "cache"
    server.wait_for(lambda _: any(home.rglob("*.mesh")))  # it is written after the picture was told of
    kept = [*home.rglob("*.mesh")]
    assert len(kept) == 1, "the million triangles are kept, the box is not"
    status, before, _ = server.request("GET", "/api/references/million/shape")
    assert (status, before) == (200, kept[0].read_bytes())
    path = server.folder / "references" / "million.ply"
    path.write_bytes(encode(dense(420), "ply"))
    server.wait_for(lambda s: ready(s))

    def answered() -> bytes:
        body: bytes = server.request("GET", "/api/references/million/shape")[1]
        return body

    server.wait_for(lambda _: answered() != before)  # what is kept is of the file as it was
