"""The example shelves: spaces, soundness at random and at the corners of the space, labels, and every rule in use."""

from pathlib import Path

import numpy as np
import pytest

from shapewright import Infeasible, load_procedure
from shapewright.modelling.grammar import Grammar

FOLDER = Path(__file__).resolve().parents[1] / "examples" / "shelf"
VERSIONS = ("v1", "v2", "v3")
PROCEDURES = {version: load_procedure(FOLDER / f"{version}.py") for version in VERSIONS}


def built(procedure, vectors):
    """The shapes of these parameters but for those that contradict each other."""
    for values in vectors:
        try:
            yield values, procedure(**values)
        except Infeasible:
            continue


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
    shapes = list(built(procedure, vectors))
    assert len(shapes) > 60
    for values, mesh in shapes:
        assert mesh.soundness().sound, (values, str(mesh.soundness()))


@pytest.mark.parametrize("version", VERSIONS)
def test_parameters_say_how_large_a_shelf_is(version):
    procedure = PROCEDURES[version]
    for values, mesh in built(procedure, procedure.space.sample(30, seed=2)):
        size = np.ptp(mesh.bounds, axis=0)
        np.testing.assert_allclose(size[:2], [1 - values["upright"], values["upright"]], atol=1e-9)
        assert 0.6 * values["depth"] < size[2] <= values["depth"] + 1e-9


def test_combinations_that_cannot_be_are_few():
    space = PROCEDURES["v3"].space
    assert sum(1 for _ in built(PROCEDURES["v3"], space.sample(300, seed=3))) > 0.85 * 300


def test_labels_tell_what_a_shelf_is_made_of():
    shelves = PROCEDURES["v3"]
    assert set(shelves().labels) == {"board", "panel", "back", "plinth"}
    assert set(shelves(sides=False, back=False, stand="floor").labels) == {"board", "post"}
    assert set(shelves(front="closed", stand="legs", crown=True).labels) == {"top", "carcase", "door", "handle", "leg"}
    assert "drawer" in shelves(front="closed", upright=0.4).labels
    assert {"door", "board"} <= set(shelves(front="half").labels)


def test_open_compartments_are_seen_through_without_a_back():
    mesh = PROCEDURES["v3"](upright=0.5, board=0.02, columns=2, rows=2, back=False, stand="floor")
    # Euler characteristic 2 - 2g: a hole a compartment.
    edges = len(mesh.faces) * 3 // 2
    assert len(mesh.vertices) - edges + len(mesh.faces) == 2 - 2 * 4


@pytest.mark.parametrize("version", VERSIONS)
def test_every_rule_is_used(version):
    procedure = PROCEDURES[version]
    grammar = next(v for v in procedure.function.__globals__.values() if isinstance(v, Grammar))

    def derivations():
        for values in procedure.space.sample(150, seed=4):
            try:
                yield procedure.function(**values)
            except Infeasible:
                continue

    assert min(grammar.check(derivations()).values()) > 0
