"""Public names and commands: they exist, and so does every one that a message or a page of the docs names."""

import ast
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from typer.main import get_command

import shapewright as sw
from shapewright.cli.main import app

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "src" / "shapewright"
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
COMMANDS = get_command(app).commands
PROSE = {"again", "as", "import", "reads"}
"""Words that follow the project's name where no command is meant: "this version of shapewright reads"."""
FILES = {"csv"}
"""Endings of files that have the project's name: ``shapewright.csv``."""


def texts(path):
    """The strings of a module without its docstrings, f-strings with their holes; or the code of a page."""
    if path.suffix == ".md":
        return re.findall(r"`[^`\n]+`|```.*?```", path.read_text(encoding="utf-8"), re.DOTALL)
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    alone = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}  # docstrings
    found = []
    for node in nodes:
        if isinstance(node, ast.JoinedStr):
            found.append("".join(str(part.value) if isinstance(part, ast.Constant) else "HOLE" for part in node.values))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in alone:
            found.append(node.value)
    return found


def exists(dotted):
    """Whether ``shapewright.a.b`` is a public name, an attribute of one, or a module."""
    value = sw
    for name in dotted.split("."):
        if not hasattr(value, name):
            return find_spec(f"shapewright.{dotted}") is not None
        value = getattr(value, name)
    return True


def wrong_names(text):
    """Commands, their options, and names of the package that the text names and that are not there."""
    for command, rest in re.findall(r"\bshapewright ([a-z]+)\b([^\n`;]*)", text):
        if command in PROSE:
            continue
        if command not in COMMANDS:
            yield f"shapewright {command}"
            continue
        called = COMMANDS[command]
        inner = re.match(r" ([a-z]+)", rest)
        if commands := getattr(called, "commands", None):  # of a group the next word is the command
            if inner is None or inner[1] not in commands:
                yield f"shapewright {command}{inner[0] if inner else ''}"
                continue
            called = commands[inner[1]]
        offered = {flag for option in called.params for flag in (*option.opts, *option.secondary_opts)}
        flags = re.findall(r"--[a-z-]+", re.split(r"[.)#] ", rest)[0])  # another sentence may be about another command
        yield from (f"{command} {flag}" for flag in flags if flag not in offered | {"--help"})
    for dotted in re.findall(r"\b(?:shapewright|sw)\.([A-Za-z_]+(?:\.[a-z_]+)*)", text):
        if dotted not in FILES and not exists(dotted):
            yield f"shapewright.{dotted}"


@pytest.mark.parametrize("path", [*sorted(PACKAGE.rglob("*.py")), *PAGES], ids=lambda path: str(path.relative_to(ROOT)))
def test_what_is_named_exists(path):
    assert [name for text in texts(path) for name in wrong_names(text)] == []


def test_a_name_that_is_not_there_is_noticed():
    text = "call shapewright.explane or sw.fitt, or: shapewright repair RUN; shapewright fit P R --explian"
    text += "; shapewright samples merge A --out B; shapewright samples join; shapewright samples merge --into B"
    wrong = [
        "shapewright repair",
        "fit --explian",
        "shapewright samples join",
        "samples --into",
        "shapewright.explane",
        "shapewright.fitt",
    ]
    assert list(wrong_names(text)) == wrong


@pytest.mark.parametrize("name", sw.__all__)
def test_public_names_exist(name):
    assert getattr(sw, name) is not None


def test_importing_the_package_loads_no_torch_and_no_numba():
    code = "import sys, shapewright; sys.exit(any(name in sys.modules for name in ('torch', 'numba', 'sklearn')))"
    assert subprocess.run([sys.executable, "-c", code], timeout=120).returncode == 0


def test_public_functions_are_no_modules_once_their_rooms_are_loaded():
    import shapewright.report

    names = ("compare", "evaluate", "explain", "fit", "sample", "train", "write_report")
    assert all(callable(getattr(sw, name)) for name in names) and shapewright.report
