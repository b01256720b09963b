"""The example shelves: spaces, soundness at random and at the corners of the space, labels, and every rule in use."""

from pathlib import Path

import numpy as np
import pytest

from shapewright import load_procedure
from shapewright.modelling.grammar import Grammar

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "categories" / "shelf"
VERSIONS = ("v1", "v2", "v3")
PROCEDURES = {version: load_procedure(FOLDER / f"{version}.py") for version in VERSIONS}


def corners(space, count, seed=0):
    """Parameters at the ends of their ranges, chosen at random."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        yield {p.name: p.decode(rng.integers(p.classes) if p.classes else rng.integers(2)) for p in space}


def test_the_last_version_has_the_parameters_of_the_paper_and_more():
    kinds = [type(parameter).__name__ for parameter in PROCEDURES["v3"].space]
    assert kinds.count("Scalar") >= 4
    assert kinds.count("Integer") >= 1
    assert kinds.count("Binary") >= 3


@pytest.mark.parametrize("version", VERSIONS)
def test_shelves_are_sound(version):
    procedure = PROCEDURES[version]
    vectors = [procedure.space.defaults, *procedure.space.sample(40, seed=1), *corners(procedure.space, 60)]
    for values in vectors:
        state = procedure(**values).soundness()
        assert state.sound, (values, str(state))


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_say_how_large_a_shelf_is(version):
    procedure = PROCEDURES[version]
    for values in procedure.space.sample(30, seed=2):
        size = np.ptp(procedure(**values).bounds, axis=0)
        np.testing.assert_allclose(size[:2], [1 - values["upright"], values["upright"]], atol=1e-9)
        assert 0.6 * values["depth"] < size[2] <= values["depth"] + 1e-9


def test_labels_tell_what_a_shelf_is_made_of():
    shelves = PROCEDURES["v3"]
    assert set(shelves().labels) == {"board", "panel", "back", "plinth"}
    assert set(shelves(sides=False, back=False, stand="floor").labels) == {"board", "post"}
    assert set(shelves(front="closed", stand="legs", crown=True).labels) == {"top", "carcase", "door", "handle", "leg"}
    assert "drawer" in shelves(front="closed", upright=0.4).labels
    assert {"drawer", "board"} <= set(shelves(front="half").labels)
    assert {"door", "board"} <= set(shelves(front="half", upright=0.75).labels)


def test_there_are_more_compartments_along_the_longer_side():
    shelves = PROCEDURES["v1"]
    for upright, (columns, rows) in {0.7: (2, 5), 0.3: (5, 2)}.items():
        leaves = shelves.function(**{**shelves.space.defaults, "upright": upright, "along": 5, "across": 2}).leaves
        labels = [leaf.label for leaf in leaves]
        assert (labels.count("panel"), labels.count("board")) == (columns + 1, rows + 1)


def test_open_compartments_are_seen_through_without_a_back():
    mesh = PROCEDURES["v3"](upright=0.5, board=0.02, along=2, across=2, back=False, stand="floor")
    # Euler characteristic 2 - 2g: a hole a compartment.
    edges = len(mesh.faces) * 3 // 2
    assert len(mesh.vertices) - edges + len(mesh.faces) == 2 - 2 * 4


@pytest.mark.parametrize("version", VERSIONS)
def test_every_rule_is_used(version):
    procedure = PROCEDURES[version]
    grammar = next(v for v in procedure.function.__globals__.values() if isinstance(v, Grammar))
    counts = grammar.check(procedure.function(**values) for values in procedure.space.sample(150, seed=4))
    assert min(counts.values()) > 0
