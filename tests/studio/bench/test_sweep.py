"""Replicas of a whole collection: guesses that are worse than what is there already are not told."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from shapewright.judging.judge import target_of
from shapewright.judging.target import Target
from shapewright.procedures import load_procedure
from shapewright.processes import Limits
from shapewright.settings import Settings
from shapewright.shapes import Shape
from shapewright.studio.bench.messages import Measured, News, SweepEnded, Swept
from shapewright.studio.bench.sweep import Sweep
from shapewright.studio.bench.workshop import Workshop
from studio_client import PROCEDURE

GOOD, BAD = {"height": 0.6, "leg": 0.1}, {"height": 1.2, "leg": 0.05}


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("sweep") / "procedure.py"
    file.write_text(PROCEDURE)
    return file


def told(path: Path, items: dict[str, Any], least: dict[str, Any] | None, unlike: str | None = None) -> list[News]:
    workshop = Workshop()
    defaults = workshop.load(path, Limits(5.0, 1000)).defaults
    reference = load_procedure(path)(**GOOD)
    target: Target = target_of(reference, Settings())
    news: list[News] = []

    def measure(slug: str, shape: Shape) -> tuple[float, float]:
        return target.nearest(shape.normalised())[0], target.fidelity(shape.normalised())

    def whole(some: dict[str, Any]) -> dict[str, Any]:
        return {slug: {**defaults, **values} for slug, values in some.items()}

    for _ in Sweep(
        1, whole(items), list, path.parent, workshop, lambda slug, shape: unlike, measure,
        lambda message, payload: news.append(message), whole(least) if least is not None else None,
    ).run():  # fmt: skip
        pass
    workshop.close()
    return news


def test_only_guesses_that_are_no_worse_are_told_with_their_measure(path: Path) -> None:
    news = told(path, {"near": GOOD, "far": BAD, "same": BAD}, {"near": BAD, "far": GOOD, "same": BAD})
    assert [one.slug for one in news if isinstance(one, Swept)] == ["near", "same"]
    assert [one.slug for one in news if isinstance(one, Measured)] == ["near", "same"]
    assert isinstance(news[-1], SweepEnded) and not news[-1].given_up


def test_all_are_told_where_nothing_has_to_be_better(path: Path) -> None:
    news = told(path, {"near": GOOD, "far": BAD}, None)
    assert [one.slug for one in news if isinstance(one, Swept)] == ["near", "far"]
    near, far = (one.fidelity for one in news if isinstance(one, Measured))
    assert near is not None and far is not None and near > far


def test_a_replica_of_another_kind_than_its_reference_is_a_problem(path: Path) -> None:
    swept = [one for one in told(path, {"near": GOOD}, None, "give it meshes") if isinstance(one, Swept)]
    assert swept[0].problem is not None and swept[0].problem.message == "give it meshes"
