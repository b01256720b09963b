import pytest

from shapewright.modelling.solids import Solid, box
from shapewright.procedures import ProcedureError
from shapewright.rules.library import PUBLISHED, kinds, library, publish, rules_in

OWN = """
from typing import Annotated
from shapewright import Range, rule
from shapewright.modelling.solids import box, cylinder

THIN = 0.5

@rule("under", turns=2)
def bar(size, share: Annotated[float, Range(0.1, 0.9)] = 0.5):
    width, height, depth = size
    return box((width, height, depth)) - cylinder((THIN * share * width, 2 * height, share * depth))
"""


@pytest.fixture(autouse=True)
def published(tmp_path, monkeypatch):
    monkeypatch.setenv(PUBLISHED, str(tmp_path / "published"))
    return tmp_path / "published"


def test_rules_of_files_beside_the_procedure_come_first(tmp_path):
    (tmp_path / "mine.py").write_text(OWN)
    (tmp_path / "broken.py").write_text("@rule(\n")
    (tmp_path / "other.py").write_text("raise SystemExit('this file must not run')")
    first = library(tmp_path)[0]
    assert first.name == "bar" and first.stance == "under" and first.turns == 2 and first.space.names == ("share",)
    assert isinstance(first((1, 2, 3)), Solid)


def test_bundled_rules_of_a_kind_can_be_left_out():
    names = {rule.name for rule in library()}
    left = {rule.name for rule in library(without=["vessels"])}
    assert "vessels" in kinds() and "spout" in names - left and "turned_body" in left


def test_published_rules_are_found_everywhere(tmp_path, published):
    (tmp_path / "mine.py").write_text(OWN)
    assert [rule.name for rule in publish(tmp_path / "mine.py")] == ["bar"]
    assert (published / "mine.py").is_file() and library()[0].name == "bar"


def test_a_file_without_rules_is_not_published(tmp_path, published):
    (tmp_path / "plain.py").write_text("x = 1\n")
    with pytest.raises(ProcedureError, match="no rule"):
        publish(tmp_path / "plain.py")
    (tmp_path / "wrong.py").write_text("from shapewright import rule\n@rule('under')\ndef f(size, a: float): ...\n")
    with pytest.raises(ProcedureError, match="Range"):
        rules_in(tmp_path / "wrong.py")
    assert not published.exists()


def test_a_rule_is_a_plain_function_too():
    (legs,) = [rule for rule in library() if rule.name == "straight_legs"]
    assert legs.noun == "straight legs" and legs((1, 1, 1), thickness=0.1).volume < box(1).volume
