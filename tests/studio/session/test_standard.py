import pytest

from shapewright.settings import Settings
from shapewright.studio.session.standard import Standard


def test_the_grade_goes_by_the_fidelity_and_its_cuts():
    standard = Standard.of(Settings(replicated=0.6, close=0.3), 3)
    grades = [standard.judged(fidelity, 0.0)["grade"] for fidelity in (0.6, 0.59, 0.3, 0.29, None)]
    assert grades == ["replicated", "close", "close", "different", "different"]


def test_the_papers_judge_goes_by_the_distance_alone():
    standard = Standard.of(Settings(judge="paper"), 3)
    assert standard.judged(0.0, 0.18) == {"compatible": True, "grade": "replicated"}
    assert standard.judged(1.0, 0.19) == {"compatible": False, "grade": "different"}
    assert standard.judged(None, None) == {"compatible": False, "grade": "different"}


def test_a_colour_is_the_grades_and_what_is_not_measured_has_none():
    standard = Standard.of(Settings(), 3)
    seen = {standard.colour(grade, 0.5, 0.1) for grade in ("replicated", "close", "different")}
    assert len(seen) == 3 and standard.colour("different", None, 0.1) is None
    paper = standard.by("paper")
    assert paper.colour("different", None, None) is None
    assert paper.colour("replicated", None, 0.1) != paper.colour("replicated", None, 0.17)


@pytest.mark.parametrize(("fidelity", "judge"), [(0.7, "fidelity"), (None, "paper")])
def test_cuts_that_the_author_chose_need_a_fidelity(fidelity, judge):
    old = Settings(judge="paper").record() if fidelity is None else Settings().record()
    record = {"settings": old, "threshold": 0.18, "references": [{"fidelity": fidelity, "distance": 0.1}]}
    standard = Standard.of_run(record, {"judge": "fidelity", "replicated": 0.8, "close": 0.1})
    assert standard.judge == judge
    assert standard.grade(fidelity, True) == ("close" if fidelity else "replicated")
