"""How the studio's page feels: python benchmarks/studio_page.py [--references 400] [--slides 60]

On a collection of copies of the demo's tables, in a headless Chromium that draws on the processor (a graphics card is
faster): the time until the first tiles are on the page and until all have pictures, how smoothly they scroll, the time
from moving a slider to the new mesh on the stage, and the memory of the studio's processes.
"""

from __future__ import annotations

import argparse
import json
import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests" / "helpers"))

from shapewright.demo.meshes import write  # noqa: E402
from studio_browser import Visit, chromium  # noqa: E402
from studio_client import ready, studio  # noqa: E402

SLIDE = """async slides => {
    const slider = document.querySelector("[data-parameter=height] input[type=range]");
    const times = [];
    for (let i = 0; i < slides; i++) {
        const before = window.shapewright.shown(), start = performance.now();
        slider.value = Number(slider.min) + (slider.max - slider.min) * (0.1 + 0.8 * (i % 17) / 17);
        slider.dispatchEvent(new Event("input", { bubbles: true }));
        while (window.shapewright.shown() === before && performance.now() - start < 5000) {
            await new Promise(done => setTimeout(done, 1));
        }
        const mesh = performance.now() - start;
        await new Promise(requestAnimationFrame);
        await new Promise(done => setTimeout(done));
        times.push([mesh, performance.now() - start]);
        await new Promise(done => setTimeout(done, 250));
    }
    return times;
}"""
SCROLL = """async () => {
    const page = document.querySelector("main"), times = [];
    let last = performance.now();
    for (let at = 0; at < page.scrollHeight; at += 60) {
        page.scrollTop = at;
        await new Promise(requestAnimationFrame);
        times.push(performance.now() - last);
        last = performance.now();
    }
    return times;
}"""


def collection(folder: Path, count: int) -> None:
    """Copies of the demo's tables under other names."""
    bundled = [path for path in write(folder / "bundled") if "truncated" not in path.name]
    (folder / "references").mkdir()
    for i in range(count):
        path = bundled[i % len(bundled)]
        shutil.copy(path, folder / "references" / f"{path.stem}-{i // len(bundled)}{path.suffix}")
    shutil.copy(ROOT / "examples" / "tables" / "v4.py", folder / "procedure.py")


def memory(process: int) -> dict[str, float]:
    """Resident megabytes of a process and of those that it started, by their module."""
    found = {}
    for status in Path("/proc").glob("[0-9]*/status"):
        try:
            fields = dict(line.split(":", 1) for line in status.read_text().splitlines() if ":" in line)
            command = status.with_name("cmdline").read_text().split("\0")
        except OSError:
            continue
        if process in (int(fields["Pid"]), int(fields["PPid"])):
            module = next((part for part in command if part.startswith("shapewright")), "server")
            found[f"{module} {fields['Pid'].strip()}"] = int(fields["VmRSS"].split()[0]) / 1024
    return found


def measure(folder: Path, slides: int) -> dict[str, Any]:
    with studio(folder, "--no-auto-fit", "--workers", "1") as started, chromium() as browser:
        started_at = time.perf_counter()
        visit = Visit.of(started, browser)
        visit.page.wait_for_selector(".tile")
        first = time.perf_counter() - started_at
        visit.page.wait_for_selector(".tile .picture:not(.missing)", timeout=120_000)
        pictured = time.perf_counter() - started_at
        started.wait_for(lambda state: ready(state) and all(tile["reference"] for tile in state["collection"]["tiles"]))
        complete = time.perf_counter() - started_at
        visit.page.wait_for_timeout(500)
        frames = visit.page.evaluate(SCROLL)
        visit.open(started.get("/api/state")["collection"]["tiles"][0]["slug"])
        meshes, drawn = zip(*visit.page.evaluate(SLIDE, slides)[3:], strict=True)
        used = memory(started.process.pid)
        visit.end()
    return {
        "first_tiles_seconds": round(first, 2),
        "first_picture_seconds": round(pictured, 2),
        "all_pictures_seconds": round(complete, 2),
        "scroll_frame_ms": spread(frames),
        "slider_to_mesh_ms": spread(meshes),
        "slider_to_picture_ms": spread(drawn),
        "memory_mb": {name: round(size) for name, size in used.items()},
    }


def spread(values: Sequence[float]) -> dict[str, float]:
    ordered = sorted(values)
    return {
        "median": round(statistics.median(ordered), 1),
        "p95": round(ordered[min(len(ordered) - 1, len(ordered) * 95 // 100)], 1),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--references", type=int, default=400)
    parser.add_argument("--slides", type=int, default=60)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        collection(Path(scratch), arguments.references)
        print(json.dumps(measure(Path(scratch), arguments.slides), indent=1))


if __name__ == "__main__":
    main()
