"""Files that a procedure imports from its own folder: a run keeps them beside its copy of the procedure."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path

from shapewright.procedures import Procedure

_LIST = "helpers.json"
_PROCEDURE = "procedure.py"


def helpers_of(procedure: Procedure) -> dict[str, str]:
    """Their texts, by their path in the folder; those that cannot be read as text are left out."""
    texts: dict[str, str] = {}
    for file in procedure.helpers if procedure.path else ():
        name = file.relative_to(procedure.path.parent).as_posix() if procedure.path else ""
        try:
            text = file.read_text("utf-8")
        except (OSError, UnicodeDecodeError):
            continue
        if file.suffix == ".py" and name != _PROCEDURE:
            texts[name] = text
    return texts


def write_helpers(run: Path, texts: Mapping[str, str]) -> None:
    """Put them where the run's copy of the procedure imports them from."""
    for name, text in texts.items():
        file = run / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
    if texts:
        (run / _LIST).write_text(json.dumps(sorted(texts), indent=1), encoding="utf-8")


def read_helpers(run: Path) -> dict[str, str]:
    """Those of a run; none of a run that keeps none, or where files are gone."""
    try:
        names = json.loads((run / _LIST).read_text("utf-8"))
        return {str(name): (run / name).read_text("utf-8") for name in names if ".." not in Path(name).parts}
    except (OSError, ValueError, TypeError):
        return {}
