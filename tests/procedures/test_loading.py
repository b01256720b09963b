"""Where a procedure may live."""

import sys
import textwrap

import pytest

import shapewright as sw

HEAD = "from typing import Annotated\nfrom shapewright import Range, procedure\n"
BUILD = "return [[0, 0, 0], [1, 0, 0], [0, 1, w]], [[0, 1, 2]]"
PART = f"@procedure\ndef part(w: Annotated[float, Range(1, 2)] = 1.5):\n    {BUILD}\n"


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(HEAD + textwrap.dedent(text))
    return path


@pytest.fixture
def package(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(tmp_path)
    write(tmp_path / "mypackage" / "models.py", PART)
    (tmp_path / "mypackage" / "__init__.py").write_text("")
    yield tmp_path
    for name in [name for name in sys.modules if name.partition(".")[0] in ("mypackage", "adapter")]:
        del sys.modules[name]


def test_a_module_that_can_be_imported(package):
    part = sw.load_procedure("mypackage.models:part")
    assert part.name == "part" and part.path == package / "mypackage" / "models.py"
    assert [b.shape is not None for b in sw.sample(part, 2, workers=1)] == [True, True]


def test_a_module_below_the_working_folder(package, monkeypatch, tmp_path):
    write(tmp_path / "work" / "adapter.py", PART)
    monkeypatch.chdir(tmp_path / "work")
    assert sw.load_procedure("adapter:part").space.names == ("w",)


@pytest.mark.parametrize(
    ("source", "message"),
    [
        ("mypackage.nothing:part", "there is no module mypackage.nothing, and no such file"),
        ("nopackage:part", "there is no module nopackage"),
        ("mypackage.models:other", "no procedure 'other' in this file; there is part"),
        ("mypackage.broken:part", "ModuleNotFoundError: No module named 'missing_library'"),
    ],
)
def test_a_module_that_is_not_there_is_named(package, source, message):
    write(package / "mypackage" / "broken.py", "import missing_library\n")
    with pytest.raises(sw.ProcedureError, match=message):
        sw.load_procedure(source)


def test_what_another_modules_decorator_or_factory_made(package, tmp_path):
    adapter = f"""
        import functools
        def timed(function):
            @functools.wraps(function)
            def inner(*args, **kwargs):
                return function(*args, **kwargs)
            return inner
        def made(name):
            def part(w: Annotated[float, Range(1, 2)] = 1.5):
                {BUILD}
            part.__name__ = name
            return procedure(part)
    """
    write(tmp_path / "adapter.py", adapter)
    decorated = PART.replace("@procedure", "from adapter import timed\n@procedure\n@timed")
    assert sw.load_procedure(write(tmp_path / "decorated.py", decorated)).place.file.endswith("decorated.py")
    path = write(tmp_path / "factory.py", 'from adapter import made\nbracket = made("bracket")\n')
    bracket = sw.load_procedure(path)
    assert bracket.name == "bracket" and bracket.path == path
    assert [b.shape is not None for b in sw.sample(bracket, 2, workers=1)] == [True, True]


def test_one_that_the_file_imports_counts_where_the_file_defines_none(package, tmp_path):
    imported = "from mypackage.models import part\n"
    assert sw.load_procedure(write(tmp_path / "imports.py", imported)).name == "part"
    own = PART.replace("def part", "def other")
    assert sw.load_procedure(write(tmp_path / "both.py", imported + own)).name == "other"


def test_a_function_without_the_decorator_that_is_named(tmp_path):
    path = write(tmp_path / "plain.py", PART.replace("@procedure\n", ""))
    assert sw.load_procedure(f"{path}:part").space.names == ("w",)
    with pytest.raises(sw.ProcedureError, match="no procedure in this file"):
        sw.load_procedure(path)


def test_helpers_of_the_own_folder_are_known(tmp_path):
    (tmp_path / "shared.py").write_text("WIDTH = 1.0\n")
    text = "import json\nimport trimesh\nimport shared\n" + PART
    assert sw.load_procedure(write(tmp_path / "model.py", text)).helpers == (tmp_path / "shared.py",)
