import sys

import pytest

from shapewright.references.errors import UnreadableError
from shapewright.references.readers.formats import read

STEP = (
    "ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n#1=CARTESIAN_POINT('it''s #9',(0.,0.,0.));\n"
    "#2=VERTEX_POINT('',#1);\nENDSEC;\nEND-ISO-10303-21;\n"
)


def reason(tmp_path, name: str, text: str) -> str:
    (tmp_path / name).write_text(text)
    with pytest.raises(UnreadableError) as error:
        read(tmp_path / name)
    return str(error.value)


def iges(*sections: str, told: str) -> str:
    lines = [f"{'':72}{section}{i:7}" for i, section in enumerate(sections, 1)]
    return "\n".join([*lines, f"{told:72}T{1:7}"]) + "\n"


@pytest.mark.parametrize(
    ("name", "text"), [("a.stp", STEP), ("a.igs", iges("S", "G", told="S0000001G0000001D0000000P0000000"))]
)
def test_without_the_library_the_way_to_it_is_told(tmp_path, monkeypatch, name, text):
    monkeypatch.setitem(sys.modules, "cascadio", None)
    assert "pip install 'shapewright[cad]'" in reason(tmp_path, name, text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (STEP[:-20], "cut short"),
        (STEP.replace("#1=", "#7="), "it refers to #1, not there"),
        ("solid box\n", "no STEP"),
    ],
)
def test_a_step_file_that_is_not_whole_is_refused(tmp_path, text, said):
    assert said in reason(tmp_path, "a.step", text)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (iges("S", "G", told="S0000001G0000002D0000000P0000000"), "announces 2 lines of section G, but has 1"),
        (iges("S", "G", told="")[:80], "cut short"),
    ],
)
def test_an_iges_file_that_is_not_whole_is_refused(tmp_path, text, said):
    assert said in reason(tmp_path, "a.iges", text)
