from typing import Annotated, Literal

import numpy as np
import pytest

import shapewright as sw
from shapewright import Binary, Choice, Infeasible, Integer, Range, Scalar, When
from shapewright.procedures import describe, place_of, source_digest

TRIANGLE = ([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def sketch(
    height: Annotated[float, Range(0.5, 1.0, steps=8)] = 0.7,
    count: Annotated[int, Range(0, 3)] = 1,
    wide: Annotated[bool, When(lambda p: p.count > 0)] = True,
    kind: Literal["plain", "fancy"] = "fancy",
    free: Annotated[float, Range(-1, 1, when=lambda p: p.wide)] = 0.0,
):
    return np.array(TRIANGLE[0]) * height, TRIANGLE[1]


def test_the_signature_is_the_parameter_space():
    space = sw.procedure(sketch).space
    assert list(space) == [
        Scalar("height", 0.5, 1.0, 0.7, 8),
        Integer("count", 0, 3, 1),
        Binary("wide", True),
        Choice("kind", ("plain", "fancy"), "fancy"),
        Scalar("free", -1.0, 1.0, 0.0),
    ]
    assert "free" not in space.active({**space.defaults, "wide": False})
    assert "wide" not in space.active({**space.defaults, "count": 0})


def test_a_procedure_builds_at_given_and_at_default_parameters():
    table = sw.procedure(sketch)
    assert table(height=1.0).vertices.max() == 1.0
    assert table().vertices.max() == pytest.approx(0.7)
    mesh = table.random(seed=3)
    assert mesh.vertices.dtype == np.float64 and mesh.faces.dtype == np.int64
    assert np.array_equal(mesh.vertices, table.random(seed=3).vertices)


def test_random_passes_over_infeasible_parameters():
    @sw.procedure
    def picky(a: Annotated[float, Range(0, 1)] = 0.5):
        if a < 0.9:
            raise Infeasible("too small")
        return TRIANGLE

    assert isinstance(picky.random(seed=0), sw.Mesh)


@pytest.mark.parametrize(
    ("annotation", "message"),
    [
        (float, r"parameter 'x' needs a Range: Annotated\[float, Range\(low, high\)\]"),
        (int, "parameter 'x' needs a Range"),
        (str, "annotation str is not supported"),
        (Annotated[str, Range(0, 1)], "annotation str is not supported"),
        (list[float], "is not supported"),
        (Annotated[int, Range(0.5, 2)], "needs whole ends"),
        (Annotated[float, Range(2, 1)], "the lower one first"),
        (Literal["only"], "at least two options"),
    ],
)
def test_an_unsupported_annotation_names_the_parameter_and_the_line(annotation, message):
    def bad(x):
        return TRIANGLE

    bad.__annotations__["x"] = annotation
    with pytest.raises(sw.ProcedureError, match=message) as error:
        sw.procedure(bad)
    assert f"{__file__}:" in str(error.value) and "bad()" in str(error.value)


def test_other_signatures_without_a_space_are_refused():
    with pytest.raises(sw.ProcedureError, match="it has no parameters"):
        sw.procedure(lambda: TRIANGLE)
    with pytest.raises(sw.ProcedureError, match="none of its arguments has a Range"):
        sw.procedure(lambda *x: TRIANGLE)
    with pytest.raises(sw.ProcedureError, match="has no annotation"):
        sw.procedure(lambda x: TRIANGLE)
    with pytest.raises(sw.ProcedureError, match="has no annotation"):
        sw.procedure(lambda x, /: TRIANGLE)


def test_parameters_may_be_called_as_the_methods_call_themselves():
    @sw.procedure
    def part(self: Annotated[float, Range(0, 1)] = 0.5, args: Annotated[float, Range(0, 1)] = 0.5, cls: bool = True):
        return [[0, 0, 0], [1, 0, 0], [0, 1, self + args]], [[0, 1, 2]]

    assert part(self=1.0, args=1.0, cls=False).vertices.max() == 2.0
    assert part.random(seed=1) and part.space.canonical(part.space.defaults) == part.space.defaults


HEAD = "from typing import Annotated\nfrom shapewright import Range, procedure\n"
BODY = """
@procedure
def {name}(x: Annotated[float, Range(0, 1)] = 0.5):
    return [[0, 0, 0], [1, 0, 0], [0, 1, x]], [[0, 1, 2]]
"""


def write(folder, name, text):
    folder.mkdir(exist_ok=True, parents=True)
    path = folder / name
    path.write_text(text)
    return path


def test_a_file_is_loaded_with_imports_of_its_own_folder(tmp_path):
    found = []
    for folder, value in (("one", 1.0), ("two", 2.0)):
        write(tmp_path / folder, "helper.py", f"VALUE = {value}\n")
        text = HEAD + "from helper import VALUE\n" + BODY.format(name="part").replace("x]]", "VALUE]]")
        found.append(sw.load_procedure(write(tmp_path / folder, "model.py", text)))
    assert [p().vertices.max() for p in found] == [1.0, 2.0]
    assert found[0].path == tmp_path / "one" / "model.py"
    assert "VALUE" in found[0].source
    assert found[0].digest == source_digest(found[0].path.read_text())


def test_a_file_with_the_name_of_a_module_of_python_hides_nothing_and_is_named_where_it_is_meant(tmp_path):
    for name in ("colorsys", "this"):
        write(tmp_path, f"{name}.py", "raise RuntimeError\nVALUE = 1\n")
    write(tmp_path, "helper.py", "VALUE = 2.0\n")
    text = HEAD + "import colorsys\nfrom helper import VALUE\n" + BODY.format(name="part").replace("x]]", "VALUE]]")
    assert sw.load_procedure(write(tmp_path, "model.py", text))().vertices.max() == 2.0
    with pytest.raises(sw.ProcedureError, match=r"colorsys\.py has the name of one of Python's modules: rename it"):
        sw.load_procedure(write(tmp_path, "other.py", "from colorsys import VALUE\n"))


def test_the_digest_of_a_text_stays_the_same_in_every_version():
    assert source_digest("def f(): ...\n") == "b1a68332ee6c1635"


def test_an_edited_helper_is_read_anew(tmp_path):
    text = HEAD + "from helper import VALUE\n" + BODY.format(name="part").replace("x]]", "VALUE]]")
    path = write(tmp_path, "model.py", text)
    for value in (1.0, 22.0):
        write(tmp_path, "helper.py", f"VALUE = {value}\n")
        assert sw.load_procedure(path)().vertices.max() == value


def test_one_of_several_procedures_is_picked_by_name(tmp_path):
    path = write(tmp_path, "both.py", HEAD + BODY.format(name="first") + BODY.format(name="second"))
    with pytest.raises(sw.ProcedureError, match=r"several procedures \(first, second\)"):
        sw.load_procedure(path)
    assert sw.load_procedure(f"{path}:second").name == "second"
    with pytest.raises(sw.ProcedureError, match="no procedure 'third'"):
        sw.load_procedure(f"{path}:third")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def broken(:\n", r"bad\.py:1: .*\(def broken\(:\)"),
        ("x = 1\ny = x / 0\n", r"bad\.py:2: ZeroDivisionError: .*\(y = x / 0\)"),
        ("import nothing_like_this\n", r"bad\.py:1: ModuleNotFoundError"),
        ("x = 1\n", "no procedure in this file; write @procedure"),
        ("import sys\nsys.exit(3)\n", "ended the program"),
        (HEAD + "@procedure\ndef f(x: str): ...\n", r"bad\.py:3, f\(\): parameter 'x'"),
        ("from shapewright import procedure\n@procedure\ndef f(): ...\n", r"bad\.py:2, f\(\): it has no parameters"),
        ("\x00", "bad.py"),
        ("# \xff\n".encode("latin-1"), "bad.py"),
    ],
)
def test_a_file_that_cannot_be_used_says_where_and_why(tmp_path, text, message):
    path = tmp_path / "bad.py"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    with pytest.raises(sw.ProcedureError, match=message):
        sw.load_procedure(path)


def test_a_missing_file_and_a_folder_are_said_to_be_that(tmp_path):
    with pytest.raises(sw.ProcedureError, match=r"none\.py: no such file"):
        sw.load_procedure(tmp_path / "none.py")
    with pytest.raises(sw.ProcedureError, match="this is a folder"):
        sw.load_procedure(tmp_path)


def test_author_line_is_the_deepest_line_in_the_authors_folder(tmp_path):
    text = HEAD + BODY.format(name="part").replace("    return", "    import math; math.sqrt(-1)\n    return")
    part = sw.load_procedure(write(tmp_path, "model.py", text))
    with pytest.raises(ValueError) as error:
        part()
    place = place_of(error.value, part.path)
    assert place and place.says(describe(error.value)).startswith(f"{tmp_path}/model.py:6: ValueError:")


def test_what_a_generator_raises_is_the_authors_own():
    @sw.procedure
    def parts(size: Annotated[float, Range(0.5, 2.0)] = 1.0):
        yield [[0, 0, 0], [size, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        if size > 1.0:
            raise ValueError("too long")
        if size < 1.0:
            raise Infeasible("too short")

    assert len(parts().faces) == 1
    with pytest.raises(ValueError, match="too long"):
        parts(size=2.0)
    with pytest.raises(Infeasible):
        parts(size=0.5)
