"""How long the stages of work took last, kept in the project: so the next time can say how long it takes still."""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Mapping
from contextlib import suppress
from typing import Any, Literal, NamedTuple, TypeAlias

from shapewright.runs.folder import RunError, read_record
from shapewright.storage import write_file
from shapewright.studio.project.workspace import SCRATCH, Project, ProjectError
from shapewright.studio.wire.work import JobKind, JobStage

Timed: TypeAlias = JobKind | Literal["sweep"]
_FILE = "timings.json"


class Took(NamedTuple):
    """What a stage took."""

    seconds: float
    total: int  # steps that it had; 0 where that is not known


class Timings:
    """Those of one project."""

    def __init__(self, project: Project) -> None:
        self._project = project
        self._known = {kind: _stages(stages) for kind, stages in self._read().items()}

    def of(self, kind: Timed) -> Mapping[str, Took]:
        """What each stage took last, in order; empty where nobody knows. A fit of the command line tells it, too."""
        return self._known.get(kind) or (self._of_newest_run() if kind == "fit" else {})

    def note(self, kind: Timed, stages: Iterable[JobStage]) -> None:
        """Keep what the stages of finished work took; where that cannot be written it holds until the studio ends."""
        took: dict[str, Took] = {}
        for stage in stages:
            before = took.get(stage.name, Took(0.0, 0))
            took[stage.name] = Took(round(before.seconds + stage.seconds, 2), before.total + stage.total)
        self._known[kind] = took
        with suppress(OSError, ProjectError):
            write_file(self._project.scratch() / _FILE, json.dumps(self._known, indent=1) + "\n")

    def _read(self) -> dict[str, Any]:
        try:
            content: Any = json.loads((self._project.folder / SCRATCH / _FILE).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return content if isinstance(content, dict) else {}

    def _of_newest_run(self) -> dict[str, Took]:
        try:
            seconds = read_record(self._project.runs[-1])["seconds"]
            return {stage: Took(float(took), 0) for stage, took in seconds.items()}
        except (IndexError, RunError, KeyError, TypeError, ValueError, AttributeError):
            return {}


def _stages(stages: Any) -> dict[str, Took]:
    """What a file says; nothing where it says something else."""
    try:
        took = {str(name): Took(float(seconds), int(total)) for name, (seconds, total) in stages.items()}
    except (AttributeError, TypeError, ValueError, OverflowError):
        return {}
    return {name: one for name, one in took.items() if math.isfinite(one.seconds) and one.seconds >= 0}
