"""The library of rules: those that come with shapewright, those that authors published, and those of a folder."""

from __future__ import annotations

import importlib
import os
import pkgutil
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path
from types import ModuleType

from platformdirs import user_data_path

from shapewright.procedures import ProcedureError
from shapewright.procedures.loading import executed
from shapewright.rules import bundled
from shapewright.rules.rule import Rule
from shapewright.storage import write_file

PUBLISHED = "SHAPEWRIGHT_RULES"
"""The environment variable that names another folder of published rules."""
_MARK = "@rule("  # in the text of a file that has rules: other files of a folder are not run


def library(folder: Path | None = None, without: Iterable[str] = ()) -> tuple[Rule, ...]:
    """All rules, of equal names the first: those of the files in a folder, published ones, bundled ones.

    without: names of bundled modules to leave out, such as "vessels".
    Files that fail have no rules here; whoever loads them as a procedure hears why.
    """
    folders = [published_folder()] if folder is None else [folder, published_folder()]
    files = [path for place in folders if place.is_dir() for path in sorted(place.glob("*.py"))]
    rules = [rule for path in files for rule in _of_file(path)]
    rules += [rule for kind in kinds() if kind not in set(without) for rule in bundled_rules(kind)]
    return tuple({rule.name: rule for rule in reversed(rules)}.values())[::-1]


def published_folder() -> Path:
    """Where the rules lie that ``shapewright rules add`` publishes."""
    return Path(os.environ.get(PUBLISHED) or user_data_path("shapewright") / "rules")


def rules_in(path: Path) -> tuple[Rule, ...]:
    """The rules of an author's file. Raises ProcedureError, pointing at the line that fails."""
    return _of_module(executed(path.resolve()))


def kinds() -> tuple[str, ...]:
    """The names of the bundled modules."""
    return tuple(module.name for module in pkgutil.iter_modules(bundled.__path__))


@lru_cache
def bundled_rules(kind: str) -> tuple[Rule, ...]:
    """Those of one bundled module."""
    return _of_module(importlib.import_module(f"{bundled.__name__}.{kind}"))


def _of_file(path: Path) -> tuple[Rule, ...]:
    try:
        return rules_in(path) if _MARK in path.read_text("utf-8") else ()
    except (OSError, UnicodeDecodeError, ProcedureError):
        return ()


def _of_module(module: ModuleType) -> tuple[Rule, ...]:
    return tuple(value for value in vars(module).values() if isinstance(value, Rule))


def publish(path: Path) -> tuple[Rule, ...]:
    """Put a file of rules where every project finds it, under its name; these rules.

    Raises ProcedureError when the file fails, or has no rule.
    """
    if not (rules := rules_in(path)):
        raise ProcedureError(f"{path}: no rule in this file; write @rule(...) above a function of a size")
    folder = published_folder()
    folder.mkdir(parents=True, exist_ok=True)
    write_file(folder / path.name, path.read_bytes())
    return rules
