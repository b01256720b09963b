"""Samples like the references of a run: the distribution that these showed, drawn with a seed."""

import json
from collections import Counter
from itertools import islice
from typing import Annotated, Literal

import numpy as np
import pytest

import shapewright as sw
from shapewright import Range, procedure
from shapewright.fitting.samples import write_samples
from shapewright.fitting.sampling.likeness import Likeness
from shapewright.fitting.sampling.merging import merge
from shapewright.fitting.sampling.shards import Shard
from shapewright.modelling.solids import box
from shapewright.runs.folder import RunError


@procedure
def stool(
    height: Annotated[float, Range(0.0, 1.0)] = 0.5,
    depth: Annotated[float, Range(0.1, 10.0, steps=(0.1, 1.0, 10.0), log=True)] = 1.0,
    legs: Annotated[int, Range(1, 4)] = 4,
    kind: Literal["square", "round", "odd"] = "square",
    tilt: Annotated[float, Range(0.0, 1.0, when=lambda p: p.kind == "odd")] = 0.25,
):
    return box((1, 0.1 + height, depth))


def run_of(folder, *references):
    """A run's folder, as far as its parameters go: (parameters, fidelity) of each reference."""
    folder.mkdir()
    entries = [
        {"parameters": values, "fidelity": fidelity, "compatible": True, "grade": "close"}
        for values, fidelity in references
    ]
    (folder / "iteration.json").write_text(json.dumps({"format": 1, "references": entries}))
    return folder


def values(height, legs, kind, depth=1.0, tilt=0.25):
    return {"height": height, "depth": depth, "legs": legs, "kind": kind, "tilt": tilt}


@pytest.fixture
def run(tmp_path):
    low = [(values(0.2 + 0.001 * i, 3, "round"), 0.9) for i in range(30)]
    high = [(values(0.8 + 0.001 * i, 4, "square"), 0.9) for i in range(10)]
    return run_of(tmp_path / "run", *low, *high, (values(0.5, 1, "odd"), 0.0), (None, None))


def test_draws_have_the_shares_and_the_company_that_the_references_showed(run):
    drawn = list(Likeness.of_run(run, stool.space).draw(4000, seed=0))
    kinds = Counter(vector["kind"] for vector in drawn)
    assert 0.71 < kinds["round"] / 4000 < 0.78 and 0.21 < kinds["square"] / 4000 < 0.28
    round_ones = np.array([vector["height"] for vector in drawn if vector["kind"] == "round" and vector["legs"] == 3])
    square_ones = np.array([vector["height"] for vector in drawn if vector["kind"] == "square" and vector["legs"] == 4])
    assert abs(np.median(round_ones) - 0.2145) < 0.02 and abs(np.median(square_ones) - 0.8045) < 0.02
    assert {vector["depth"] for vector in drawn} == {1.0}  # the nearest step, far from the others
    assert min(vector["height"] for vector in drawn) >= 0.0


def test_what_mattered_to_no_reference_is_drawn_from_its_whole_range(tmp_path):
    known = run_of(tmp_path / "run", (values(0.5, 2, "odd", tilt=0.9), 1.0))
    assert {v["tilt"] > 0.6 for v in Likeness.of_run(known, stool.space).draw(200, seed=1) if v["kind"] == "odd"} == {
        True
    }
    before = {
        key: value for key, value in values(0.5, 2, "odd").items() if key != "tilt"
    }  # a run of an earlier version
    unknown = run_of(tmp_path / "before", (before, 1.0))
    tilts = [v["tilt"] for v in Likeness.of_run(unknown, stool.space).draw(400, seed=1) if v["kind"] == "odd"]
    assert min(tilts) < 0.05 and max(tilts) > 0.95


def test_a_reference_weighs_its_fidelity(tmp_path):
    low, high = values(0.1, 4, "square"), values(0.9, 4, "square")
    for weight in (0.9, 0.1):
        run = run_of(tmp_path / str(weight), (low, weight), (high, 1.0 - weight))
        heights = np.array([vector["height"] for vector in Likeness.of_run(run, stool.space).draw(2000, seed=0)])
        assert abs((heights < 0.5).mean() - weight) < 0.06


def test_the_same_seed_draws_the_same_and_never_one_vector_twice(run):
    likeness = Likeness.of_run(run, stool.space)
    drawn = list(likeness.draw(300, seed=5))
    assert drawn == list(islice(Likeness.of_run(run, stool.space).draw(500, seed=5), 300))
    assert drawn != list(likeness.draw(300, seed=6))
    assert len({tuple(vector.values()) for vector in drawn}) == 300


def test_a_space_without_more_vectors_ends_the_draws(tmp_path):
    @procedure
    def few(legs: Annotated[int, Range(1, 4)] = 4):
        return box((1, legs, 1))

    run = run_of(tmp_path / "run", ({"legs": 2}, 1.0))
    assert {vector["legs"] for vector in Likeness.of_run(run, few.space).draw(100, seed=0)} == {1, 2, 3, 4}


def test_samples_in_memory_in_files_and_in_shards_are_the_same(run, tmp_path):
    builds = sw.sample(stool, 6, seed=2, workers=1, like=run)
    assert [build.parameters for build in builds] == list(Likeness.of_run(run, stool.space).draw(6, seed=2))
    write_samples(stool, 6, tmp_path / "all", seed=2, workers=1, like=run)
    for k in (1, 2):
        write_samples(stool, 6, tmp_path / str(k), seed=2, workers=1, like=run, shard=Shard(k, 2))
    merge([tmp_path / "1", tmp_path / "2"], tmp_path / "joined")
    for path in (tmp_path / "all").iterdir():
        assert path.read_bytes() == (tmp_path / "joined" / path.name).read_bytes()
    with pytest.raises(RunError, match="other like"):
        write_samples(stool, 6, tmp_path / "all", seed=2, workers=1)


def test_a_run_that_shows_nothing_is_refused(tmp_path):
    with pytest.raises(RunError, match="none of its references is replicated"):
        Likeness.of_run(run_of(tmp_path / "none", (None, None), (values(0.1, 4, "square"), 0.0)), stool.space)
    with pytest.raises(RunError, match="it is of another procedure: there is no parameter height, depth, "):
        Likeness.of_run(run_of(tmp_path / "other", ({"width": 1.0}, 0.9)), stool.space)
    with pytest.raises(RunError, match="no run here"):
        Likeness.of_run(tmp_path, stool.space)
