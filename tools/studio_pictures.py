"""Take the pictures of docs/studio.md: python tools/studio_pictures.py [--project DIR] [NAME ...]

A studio is started on the demo's tables; the author writes versions 1, 2 and 4 of the procedure, each is fitted, and a
headless Chromium looks at every view. Another is started on their silhouettes. That takes some minutes; projects that
are kept (in DIR) are fitted only once. Of each view there is a sheet as well: light and dark, in three sizes.
"""

from __future__ import annotations

import argparse
import io
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from PIL import Image

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "helpers"))

from shapewright.demo.meshes import write  # noqa: E402
from studio_browser import Visit, chromium  # noqa: E402
from studio_client import Studio, ready, studio  # noqa: E402

PICTURES = ROOT / "docs" / "pictures" / "studio"
VERSIONS = ("v1", "v2", "v4")
SETTINGS = ("--samples", "1500", "--epochs", "10", "--workers", "1")
SIZE = {"width": 1280, "height": 800}
SIZES = (SIZE, {"width": 1720, "height": 1000}, {"width": 390, "height": 844})  # a laptop, a large screen, a phone
SHEETS, SHEET_SCALE, GAP = PICTURES / "sheets", 0.5, 12


def collection(visit: Visit) -> None:
    visit.page.click(".more >> nth=0")
    visit.page.mouse.move(0, 0)


def inspector(visit: Visit) -> None:
    visit.open("side-stretchers")


def residual(visit: Visit) -> None:
    visit.open("claw-foot")
    visit.page.keyboard.press("v")
    visit.page.wait_for_selector(".legend.residual:has-text('of the largest extent')")


def overlay(visit: Visit) -> None:
    visit.open("sit-stand")
    visit.page.keyboard.press("b")


def measure(visit: Visit) -> None:
    visit.open("kitchen")
    visit.page.keyboard.press("m")
    size = visit.studio.get("/api/references/kitchen")["units"]["size"]
    width, height, depth = (side / max(size) / 2 for side in size)
    visit.click_at("reference", (-width, height, depth))
    visit.click_at("reference", (width, -height, depth))
    visit.page.mouse.move(0, 0)
    visit.page.click("text=Propose as Range")


def loop(visit: Visit) -> None:
    visit.studio.send("POST", "/api/fit", {"fresh": True}, 202)
    visit.go("loop")
    visit.page.wait_for_selector(".cm-line")
    visit.page.wait_for_selector(".curve figcaption", timeout=300_000)
    visit.until("document.querySelector('.header .status').textContent.includes('train 6')", 300)


def broken(visit: Visit) -> None:
    visit.studio.send("POST", "/api/cancel", {"kind": "fit"}, 202)
    visit.studio.wait_for(rested, 60)
    text = (ROOT / "examples" / "tables" / "v4.py").read_text(encoding="utf-8")
    visit.studio.save(text.replace("    side = breadth", "    side = bredth"))
    visit.page.wait_for_selector(".problems")
    visit.page.click(".problems .link.mono")
    visit.page.wait_for_selector(".cm-lint-marker-error")


def history(visit: Visit) -> None:
    visit.go("history")
    visit.page.wait_for_selector(".moves")


def drawings(visit: Visit) -> None:
    visit.page.click(".fold")
    visit.page.wait_for_load_state("networkidle")
    visit.page.wait_for_timeout(1500)


def difference(visit: Visit) -> None:
    tiles = visit.studio.get("/api/state")["collection"]["tiles"]
    visit.open(max((tile for tile in tiles if tile["distance"] is not None), key=lambda tile: tile["distance"])["slug"])
    visit.page.click("text=Difference")
    visit.page.wait_for_selector(".sheet .agrees", state="attached")


def feedback(visit: Visit) -> None:
    visit.go("feedback")
    visit.page.wait_for_selector(".suggestion img")


def causes(visit: Visit) -> None:
    visit.open("bench")
    visit.page.wait_for_selector(".causes .badge")
    visit.page.keyboard.press("e")


def explore(visit: Visit) -> None:
    visit.go("explore")
    visit.page.wait_for_selector("[data-shape='23']:not(.waits)")


def parameters(visit: Visit) -> None:
    visit.go("parameters")
    visit.page.click(".histogram .bar:not(.none) >> nth=2")
    visit.page.wait_for_selector(".brushed")


def selection(visit: Visit) -> None:
    for i in (0, 1, 3):
        visit.page.click(".tile .pair >> nth=" + str(i), modifiers=["Control"])
    visit.page.wait_for_selector(".selection")


def map_of_all(visit: Visit) -> None:
    visit.page.click(".segments >> text=Map")
    visit.page.wait_for_selector(".map circle")
    visit.page.select_option(".map-view select[aria-label=Colour]", "fidelity")


def old_run(visit: Visit) -> None:
    visit.page.evaluate("location.hash = 'history/001'")
    visit.page.wait_for_selector(".old-run .tile")


def keys(visit: Visit) -> None:
    visit.open("kitchen")
    visit.page.keyboard.press("?")


def first(visit: Visit) -> None:
    visit.until("[...document.querySelectorAll('.standing-pair img')].filter(i => i.naturalWidth === 512).length === 2")


# The name of each picture, how it comes about, and whether it is taken in the dark; the last ones change the project.
FLAT: dict[str, tuple[Callable[[Visit], None], bool]] = {
    "drawings": (drawings, False),
    "difference": (difference, False),
}
NEW: dict[str, tuple[Callable[[Visit], None], bool]] = {"first": (first, False)}
SHOTS: dict[str, tuple[Callable[[Visit], None], bool]] = {
    "collection": (collection, False),
    "inspector": (inspector, False),
    "residual": (residual, False),
    "overlay": (overlay, True),
    "measure": (measure, False),
    "history": (history, False),
    "explore": (explore, False),
    "parameters": (parameters, False),
    "selection": (selection, True),
    "map": (map_of_all, False),
    "old-run": (old_run, True),
    "feedback": (feedback, False),
    "causes": (causes, False),
    "keys": (keys, True),
    "loop": (loop, False),
    "broken": (broken, True),
}


def rested(state: dict[str, Any]) -> bool:
    busy = state["jobs"]["fit"]["state"] in ("running", "cancelling")
    return bool(state["runs"]) and not busy and ready(state)


def prepare(folder: Path) -> None:
    """Make the project of tables, and an iteration of each version."""
    write(folder / "references")
    shutil.copy(ROOT / "examples" / "tables" / "v1.py", folder / "procedure.py")
    with studio(folder, *SETTINGS) as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {"fresh": True}, 202)
        for count, version in enumerate(VERSIONS, start=1):
            if count > 1:
                started.save((ROOT / "examples" / "tables" / f"{version}.py").read_text(encoding="utf-8"))
            started.wait_for(lambda state, count=count: rested(state) and len(state["runs"]) == count, 900)
        started.send("POST", "/api/explain", {}, 202)
        started.wait_for(lambda state: state["explanation"] and state["jobs"]["explain"]["state"] == "done", 1800)
    shutil.copy(ROOT / "examples" / "tables" / f"{VERSIONS[-1]}.py", folder / "procedure.py")


def prepare_flat(folder: Path) -> None:
    """Make the project of the tables' silhouettes, and one iteration."""
    write(folder / "bundled")
    command = [sys.executable, "-m", "shapewright", "silhouettes", str(folder / "bundled")]
    subprocess.run([*command, "--out", str(folder / "references")], check=True, stdout=subprocess.DEVNULL)
    shutil.copy(ROOT / "examples" / "drawings" / "v5.py", folder / "procedure.py")
    with studio(folder, "--workers", "1") as started:
        started.wait_for(ready)
        started.send("POST", "/api/fit", {"fresh": True}, 202)
        started.wait_for(rested, 1800)


def prepare_new(folder: Path) -> None:
    """Make a project with references that was never fitted."""
    write(folder / "references")
    shutil.copy(ROOT / "src" / "shapewright" / "cli" / "starters" / "python_page.py", folder / "procedure.py")


def take(started: Studio, browser: Any, name: str) -> None:
    arrive, dark = (SHOTS | FLAT | NEW)[name]
    visit = Visit.of(started, browser, color_scheme="dark" if dark else "light")
    visit.page.set_viewport_size(SIZE)
    visit.page.wait_for_selector(".tile")
    arrive(visit)
    visit.page.wait_for_timeout(600)
    picture = Image.open(io.BytesIO(visit.page.screenshot())).convert("RGB")
    SHEETS.mkdir(parents=True, exist_ok=True)
    sheet(visit.page).save(SHEETS / f"{name}.webp", quality=80, method=6)
    visit.end()
    small = picture.quantize(256, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    small.save(PICTURES / f"{name}.png", optimize=True)


def sheet(page: Any) -> Image.Image:
    """The page as it is: a row for each theme, a column for each size."""
    columns = [round(SHEET_SCALE * size["width"]) for size in SIZES]
    height = round(SHEET_SCALE * max(size["height"] for size in SIZES))
    whole = Image.new("RGB", (sum(columns) + GAP * (len(SIZES) - 1), 2 * height + GAP), "gray")
    for row, scheme in enumerate(("light", "dark")):
        page.emulate_media(color_scheme=scheme)
        for column, size in enumerate(SIZES):
            page.set_viewport_size(size)
            page.wait_for_timeout(500)
            one = Image.open(io.BytesIO(page.screenshot())).convert("RGB")
            small = one.resize((columns[column], round(SHEET_SCALE * size["height"])), Image.Resampling.LANCZOS)
            whole.paste(small, (sum(columns[:column]) + GAP * column, row * (height + GAP)))
    return whole


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=", ".join(SHOTS | FLAT | NEW))
    parser.add_argument("--project", type=Path, help="where the projects are, or are to be made")
    arguments = parser.parse_args()
    wanted = arguments.names or [*SHOTS, *FLAT, *NEW]
    if unknown := set(wanted) - {*SHOTS, *FLAT, *NEW}:
        parser.error(f"no picture {', '.join(unknown)}")
    with tempfile.TemporaryDirectory() as scratch, chromium() as browser:
        kinds = (("tables", SHOTS, prepare), ("silhouettes", FLAT, prepare_flat), ("new", NEW, prepare_new))
        for folder, shots, make in kinds:
            project = (arguments.project or Path(scratch)) / folder
            names = [name for name in wanted if name in shots]
            if not names:
                continue
            if not (project / "runs").is_dir():
                make(project)
            text = (project / "procedure.py").read_text(encoding="utf-8")
            with studio(project, *SETTINGS, "--no-auto-fit") as started:
                started.wait_for(ready)
                for name in names:
                    take(started, browser, name)
            (project / "procedure.py").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
