"""References that the procedure builds nothing for."""

from shapewright.building import Build, Failure
from shapewright.building.outcomes import describe_failures
from shapewright.feedback.causes.failures import failures
from shapewright.procedures import Place

HERE, THERE = Place("table.py", 12, "box((a, b, c))"), Place("table.py", 30, "return top / 0")


def builds():
    thin = [Build({"a": a}, None, Failure("raised", f"ValueError: {a} is too thin", HERE)) for a in (0.1, 0.2, 0.3)]
    return [*thin, Build({"a": 1.0}, None, Failure("raised", "ZeroDivisionError", THERE)), Build({"a": 2.0}, None)]


def test_failures_of_one_line_are_one_entry():
    line, other = failures(["a", "b", "c", "d", "e"], builds())
    assert line.references == ("a", "b", "c") and line.kind == "not built"
    assert line.text.startswith("raised: table.py:12: ValueError: 0.1 is too thin") and line.text.endswith(
        "3 references"
    )
    assert other.references == ("d",) and other.text.endswith(": 1 reference")


def test_in_words_they_are_one_as_well():
    said = describe_failures(builds())
    assert said.startswith("3 x raised: table.py:12: ValueError: 0.1 is too thin") and said.count("table.py:12") == 1
    assert "; 1 x raised: table.py:30" in said
