"""A fit goes over its references chunk after chunk: whatever their size, the result is the same to the bit."""

from dataclasses import replace
from typing import Annotated

import numpy as np
import pytest

import shapewright as sw
from shapewright.fitting.chunks.judges import Judges
from shapewright.modelling import drawing
from shapewright.modelling.solids import box

STOOL = """
from typing import Annotated, Literal
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
    legs: Annotated[int, Range(1, 3)] = 1,
):
    if legs == 2 and seat == "round":
        raise Infeasible("it falls over")
    top = (cylinder if seat == "round" else box)((1, 0.1, 1), at=(0, height, 0))
    return top | box((0.15, height, 0.15), at=(0, height / 2, 0)).array(legs, (0.2, 0, 0))
"""
SETTINGS = sw.Settings(seed=1, samples=160, epochs=2, image_size=32, workers=2, refine_shapes=40)
_TIMES = ("seconds", "build_seconds", "created", "first_answer", "notices")


@pytest.fixture(scope="module")
def stool(tmp_path_factory):
    file = tmp_path_factory.mktemp("stool") / "stool.py"
    file.write_text(STOOL)
    return sw.load_procedure(file)


@pytest.fixture(scope="module")
def shapes(stool):
    heights = np.linspace(0.35, 0.95, 7)
    shapes = {f"square{i}": stool(height=height, legs=1 + i % 3) for i, height in enumerate(heights)}
    shapes |= {f"round{i}": stool(height=height, seat="round") for i, height in enumerate(heights[:3])}
    blocks = {f"block{i}": box((1, size, 1)) | box((0.2, 1, 0.2)) for i, size in enumerate((0.3, 0.5, 0.9))}
    return sw.Collection.of(shapes | blocks)


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(each) for key, each in value.items() if key not in _TIMES}
    return [without_times(each) for each in value] if isinstance(value, list) else value


def same(one, other):
    assert without_times(one.record) == without_times(other.record)
    assert one.pictures == other.pictures
    for result in one:
        assert np.array_equal(result.replica.vertices, other[result.name].replica.vertices)
        assert np.array_equal(result.replica.faces, other[result.name].replica.faces)
        assert result.replica.labels == other[result.name].replica.labels


@pytest.mark.parametrize(
    "changes",
    [{}, {"rounds": 1, "round_samples": 40}, {"judge": "paper"}, {"facing": "found"}, {"refine": "off"}],
    ids=["", "rounds", "paper", "facing", "off"],
)
def test_chunks_find_what_one_finds(stool, shapes, changes):
    settings = replace(SETTINGS, **changes)
    whole = sw.fit(stool, shapes, settings)
    assert whole.misfits
    same(sw.fit(stool, shapes, settings, chunk=4), whole)


def test_chunks_resume_an_iteration_as_one_does(stool, shapes):
    earlier = sw.fit(stool, shapes, replace(SETTINGS, refine_shapes=8))
    settings = replace(SETTINGS, warm_samples=60, warm_epochs=1)
    known = {"square1": [earlier["square0"].parameters], "square5": [{"height": 0.8, "seat": "square", "legs": 3}]}
    whole = sw.fit(stool, shapes, settings, previous=earlier, known=known)
    same(sw.fit(stool, shapes, settings, previous=earlier, known=known, chunk=5), whole)


def test_sizes_that_count_are_found_alike(tmp_path, shapes):
    (tmp_path / "sized.py").write_text(STOOL.replace("@procedure", '@procedure(unit="m", size="given")'))
    sized = sw.load_procedure(tmp_path / "sized.py")
    settings = replace(SETTINGS, refine_shapes=16)
    same(sw.fit(sized, shapes, settings, chunk=6), sw.fit(sized, shapes, settings))


def test_few_shapes_are_all_built_whatever_the_chunks(tmp_path, shapes):
    (tmp_path / "few.py").write_text(
        STOOL.replace("height: Annotated[float, Range(0.3, 1.0)]", "height: Literal[0.6, 0.8]")
    )
    few = sw.load_procedure(tmp_path / "few.py")
    settings = replace(SETTINGS, samples=20)
    same(sw.fit(few, shapes, settings, chunk=3), sw.fit(few, shapes, settings))


def test_drawings_are_fitted_alike():
    @sw.procedure
    def frame(height: Annotated[float, sw.Range(0.3, 1.0)] = 0.6, bar: bool = False):
        shape = drawing.box((1, 0.1), at=(0, height - 0.05)) | drawing.box((0.1, height), at=(0, height / 2))
        return shape | drawing.box((0.6, 0.05), at=(0, height / 3)) if bar else shape

    rings = {f"ring{i}": drawing.circle(1, width=0.05 * i) for i in (1, 2)}
    frames = {f"frame{i}": frame(height=0.4 + 0.1 * i, bar=i % 2 == 0) for i in range(4)}
    drawn = sw.Collection.of(rings | frames)
    settings = replace(SETTINGS, workers=1)
    whole, parts = sw.fit(frame, drawn, settings), sw.fit(frame, drawn, settings, chunk=4)
    assert without_times(parts.record) == without_times(whole.record)
    for result in whole:
        assert result.replica.geometry.equals_exact(parts[result.name].replica.geometry, 0.0)


def test_chunks_are_even_and_one_judge_is_there(shapes):
    judges = Judges(shapes, SETTINGS, chunk=5)
    assert [len(rows) for rows in judges.chunks] == [4, 5, 4]
    assert [row for rows in judges.chunks for row in rows] == list(range(13))
    first = judges.of(judges.chunks[0])
    assert judges.of(judges.chunks[0]) is first and len(first.targets) == 4
    assert judges.of(judges.chunks[1]) is not first
