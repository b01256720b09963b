"""Messages of ours, taken apart for the page."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest

from shapewright.building.outcomes import Failure
from shapewright.procedures import Place, ProcedureError, describe, load_procedure, place_of
from shapewright.studio.wire.problems import Problem, of_error, of_failure, syntax_problem, together

HEAD = "from typing import Annotated\nfrom shapewright import Range, procedure\n\n@procedure\n"


@pytest.mark.parametrize(
    ("text", "line", "said", "quoted"),
    [
        (HEAD + "def p(x):\n    pass\n", 4, "parameter 'x' has no annotation", None),
        ("x = 1\ny = {}['a (b)']\n", 2, "KeyError: 'a (b)'", "y = {}['a (b)']"),
        ("import shapewright_nothing\n", 1, "No module named", "import shapewright_nothing"),
        ("x = 1\n", None, "no procedure in this file", None),
    ],
)
def test_errors_of_loading(tmp_path: Path, text: str, line: int | None, said: str, quoted: str | None) -> None:
    path = tmp_path / "a folder" / "procedure.py"
    path.parent.mkdir()
    path.write_text(text)
    with pytest.raises(ProcedureError) as raised:
        load_procedure(path)
    found = of_error(raised.value, "load", path.parent)
    assert said in found.message and found.line == line and found.text == quoted
    assert found.file == ("procedure.py" if line else None)


def test_error_of_a_shape(tmp_path: Path) -> None:
    path = tmp_path / "procedure.py"
    path.write_text(HEAD + "def p(x: Annotated[float, Range(0, 1)]):\n    return 1 / 0\n")
    procedure = load_procedure(path)
    with pytest.raises(ZeroDivisionError) as raised:
        procedure(x=0.5)
    found = of_failure(Failure("raised", describe(raised.value), place_of(raised.value, path)), tmp_path, {"x": 0.5})
    assert found == Problem(
        "raised", "ZeroDivisionError: division by zero", "procedure.py", 6, "return 1 / 0", (), {"x": 0.5}
    )
    assert msgspec.json.decode(msgspec.json.encode(found), type=Problem) == found


def test_place_inside_a_message(tmp_path: Path) -> None:
    message = f"every one of the first 8 shapes failed: 8 x raised: {tmp_path}/procedure.py:7: KeyError: 'x'  (a['x'])"
    place = Place(f"{tmp_path}/procedure.py", 7, "a['x']")
    error = ProcedureError(message, place, summary=True)
    found = of_error(error, "load", tmp_path)
    assert str(error) == message
    assert (found.file, found.line, found.message) == ("procedure.py", 7, message)


def test_message_without_a_place(tmp_path: Path) -> None:
    assert of_error(OSError("no space left"), "fit", tmp_path) == Problem("fit", "no space left")


def test_syntax(tmp_path: Path) -> None:
    path = tmp_path / "procedure.py"
    path.write_text("x = 1\nif x\n    y = 2\n")
    found = syntax_problem(path, tmp_path)
    assert found and (found.file, found.line, found.text) == ("procedure.py", 2, "if x")
    path.write_bytes(b"x = '\xff'\n")
    assert syntax_problem(path, tmp_path)
    path.write_text("raise SystemExit\n")
    assert syntax_problem(path, tmp_path) is None


def test_alike_problems_are_told_once() -> None:
    told = [
        Problem("infeasible", "no room", slugs=("a",)),
        Problem("infeasible", "no room", slugs=("b",)),
        Problem("raised", "x", "p.py", 3, slugs=("c",)),
        Problem("raised", "x", "p.py", 4, slugs=("d",)),
    ]
    found = together(told)
    assert [each.slugs for each in found] == [("c",), ("d",), ("a", "b")]
    assert found[2].count == 2


def test_those_of_one_line_differ_in_values_alone() -> None:
    told = [
        Problem("raised", "ValueError: leg 0.25 of 'wide' is too thin", "p.py", 3, slugs=("a",)),
        Problem("raised", "ValueError: leg -1.5e-3 of 'narrow' is too thin", "p.py", 3, slugs=("b",)),
        Problem("raised", "ValueError: leg nan of 'wide' is too thin", "p.py", 3, slugs=("c",)),
        Problem("raised", "ValueError: leg 0.25 of 'wide' is too long", "p.py", 3, slugs=("d",)),
        Problem("raised", "ValueError: leg 0.5 of 'wide' is too thin", "q.py", 3, slugs=("e",)),
        Problem("no shape", "a mesh of 3 parts", slugs=("f",)),
        Problem("no shape", "a mesh of 4 parts", slugs=("g",)),
    ]
    found = together(told)
    assert [each.slugs for each in found] == [("a", "b", "c"), ("d",), ("e",), ("f",), ("g",)]
    assert found[0].message == told[0].message and found[0].count == 3
