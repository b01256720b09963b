"""A procedure that builds Z up, and whose lengths mean what they say, in the studio."""

from collections.abc import Iterator

import pytest
import trimesh

from studio_client import Studio, ready, studio

PROCEDURE = """
from typing import Annotated
import trimesh
from shapewright import Range, procedure

@procedure(up="z", unit="mm", size="given")
def lamp(
    foot: Annotated[float, Range(100, 300)] = 200,
    height: Annotated[float, Range(300, 900)] = 600,
):
    move = trimesh.transformations.translation_matrix
    base = trimesh.creation.box((foot, foot, 40), transform=move((0, 0, 20)))
    return [base, trimesh.creation.box((40, 80, height), transform=move((0, 0, height / 2)))]
"""
VALUES = {"foot": 200.0, "height": 600.0}


@pytest.fixture(scope="module")
def running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Studio]:
    folder = tmp_path_factory.mktemp("lamps")
    (folder / "references").mkdir()
    (folder / "procedure.py").write_text(PROCEDURE)
    move = trimesh.transformations.translation_matrix
    base = trimesh.creation.box((200, 200, 40), transform=move((0, 0, 20)))
    lamp = trimesh.util.concatenate([base, trimesh.creation.box((40, 80, 600), transform=move((0, 0, 300)))])
    lamp.export(folder / "references" / "same.stl")
    lamp.apply_scale(1.5)
    lamp.export(folder / "references" / "larger.stl")
    with studio(folder, "--no-auto-fit", "--workers", "1") as started:
        started.wait_for(ready)
        started.listen()
        yield started


def verdict(running: Studio, number: int, slug: str) -> dict:
    running.say(type="evaluate", id=number, slug=slug, parameters=VALUES)
    return running.next(lambda m: m["type"] == "verdict" and m["id"] == number)


def test_references_stand_as_the_procedure_builds_and_their_size_counts(running: Studio) -> None:
    same, larger = verdict(running, 1, "same"), verdict(running, 2, "larger")
    assert same["fidelity"] > 0.9 and same["grade"] == "replicated"
    assert larger["fidelity"] < 0.1 and larger["distance"] == pytest.approx(same["distance"], abs=0.01)


def test_the_procedure_may_change_its_mind_about_sizes(running: Studio) -> None:
    running.edit(PROCEDURE.replace(', size="given"', ""))
    assert verdict(running, 3, "larger")["fidelity"] > 0.9
    running.edit(PROCEDURE)
    assert verdict(running, 4, "larger")["fidelity"] < 0.1


def test_pictures_are_drawn_again_where_references_stand_otherwise(running: Studio) -> None:
    def pictures() -> list[str]:
        state = running.wait_for(lambda s: all(tile["reference"] for tile in s["collection"]["tiles"]))
        return [tile["reference"] for tile in state["collection"]["tiles"]]

    before = pictures()
    running.edit(PROCEDURE.replace('up="z", ', ""))
    running.wait_for(lambda s: all(t["reference"] not in before for t in s["collection"]["tiles"]))
