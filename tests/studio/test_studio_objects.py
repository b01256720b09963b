"""Several objects in one file, in the studio: each has a tile of its own where the author says so."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
from PIL import Image

from studio_client import PROCEDURE, Studio, ready, studio

FIT = ("--samples", "60", "--epochs", "1", "--refine", "off", "--workers", "1", "--no-auto-fit")
APART = {"up": None, "front": None, "split": "apart", "unit": None}
PARTS = ["room/box", "room/can"]


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("rooms")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    room = trimesh.Scene()
    room.add_geometry(trimesh.creation.box((1, 0.5, 1)), node_name="box")
    move = trimesh.transformations.translation_matrix((4, 0, 0))
    room.add_geometry(trimesh.creation.cylinder(0.3, 1.2), node_name="can", transform=move)
    room.export(folder / "references" / "room.glb")
    trimesh.creation.box((1, 2, 1)).export(folder / "references" / "room-box.stl")
    with studio(folder, *FIT) as started:
        started.wait_for(lambda s: names(s) == ["room", "room-box"] and drawn(s))
        yield started


def names(state: dict[str, Any]) -> list[str]:
    return [tile["name"] for tile in state["collection"]["tiles"]]


def drawn(state: dict[str, Any]) -> bool:
    return ready(state) and all(tile["reference"] for tile in state["collection"]["tiles"])


def covered(running: Studio, name: str) -> float:
    """Share of the picture of a tile that shows its shape."""
    tiles = running.get("/api/state")["collection"]["tiles"]
    shown = running.request("GET", next(tile["reference"] for tile in tiles if tile["name"] == name))[1]
    return float((np.asarray(Image.open(io.BytesIO(shown)).convert("RGBA"))[..., 3] > 0).mean())


def say(running: Studio, slug: str, told: dict[str, Any], wanted: list[str]) -> dict[str, Any]:
    running.send("PATCH", "/api/references", {"slugs": [slug], "told": told})
    return running.wait_for(lambda s: names(s) == wanted and drawn(s))


def test_each_object_has_a_tile_as_soon_as_the_author_says_so_and_the_file_again_when_not(running: Studio) -> None:
    whole = covered(running, "room")
    state = say(running, "room", APART, [*PARTS, "room-box"])
    slugs = {tile["name"]: tile["slug"] for tile in state["collection"]["tiles"]}
    assert slugs["room-box"] == "room-box" and len({*slugs.values()}) == 3  # no address changes
    assert min(covered(running, name) for name in PARTS) > 1.5 * whole
    for name, size in ((PARTS[0], [1, 0.5, 1]), (PARTS[1], [0.6, 0.6, 1.2])):
        about = running.get(f"/api/references/{slugs[name]}")
        assert about["units"]["size"] == pytest.approx(size, abs=0.02) and about["told"] == APART
    state = say(running, slugs[PARTS[1]], APART | {"split": None}, ["room", "room-box"])
    assert covered(running, "room") == whole


def test_a_file_that_is_told_to_be_one_shape_is_shown_whole(running: Studio) -> None:
    size = running.get("/api/references/room")["units"]["size"]
    say(running, "room", APART | {"split": "off"}, ["room", "room-box"])
    assert running.get("/api/references/room")["units"]["size"] == size


def test_a_fit_fills_their_tiles_and_so_does_a_studio_that_is_opened_later(running: Studio, tmp_path: Path) -> None:
    wanted = [*PARTS, "room-box"]
    say(running, "room", APART, wanted)
    running.send("POST", "/api/fit", {}, 202)

    def fitted(state: dict[str, Any]) -> bool:
        tiles = state["collection"]["tiles"]
        return names(state) == wanted and all(t["replica"] and t["fidelity"] is not None for t in tiles)

    state = running.wait_for(lambda s: s["jobs"]["fit"]["state"] == "done" and fitted(s), 120)
    assert state["collection"]["run"] == "001"
    with studio(running.folder, *FIT) as again:
        again.wait_for(lambda s: drawn(s) and fitted(s))
