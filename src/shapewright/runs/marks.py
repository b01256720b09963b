"""Pairs that the author marked as the same or as different: the project's ``marks.json``, beside its runs.

The file is a JSON list, in the order of marking, of objects

    {"a": name, "b": name, "same": true | false, "run": "003",
     "measures": {"distance": 0.21, "iou": 0.8, "depth": 0.1, "fidelity": 0.4}}

where ``a`` is a reference and ``b`` the reference whose replica it was compared with, which is ``a`` itself where an
author judges a reference and its own replica. ``run`` is the folder's name of the run that made the replica, and
``measures`` is what that run measured between the two. Both may be missing, and so may single measures; then the
current run says what they are. Other entries of an object stay unchanged. A file that cannot be read or written is a
RunError.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Hashable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from shapewright.judging.calibration import NOTED
from shapewright.judging.paper import Metric
from shapewright.runs.folder import RECORD, RunError, previous_run, read_record
from shapewright.runs.result import Result
from shapewright.settings import Settings
from shapewright.storage import write_file

MARKS = "marks.json"
DOUBTFUL = 0.35
"""Of a probability, from the cut: beyond, the judge is sure, and a mark seldom says anything new."""


@dataclass(frozen=True)
class Mark:
    """A judged pair."""

    name: str  # of the reference
    same: bool  # whether the author calls the two the same
    measures: Mapping[str, float]  # those of NOTED that are known


class Judged(Protocol):
    """Results and what judged them: an Iteration."""

    @property
    def results(self) -> Sequence[Result]:
        """One of each reference."""

    @property
    def metric(self) -> Metric:
        """The paper's measure."""

    @property
    def settings(self) -> Settings:
        """With the cuts of the fidelity."""


def marks_path(run: Path) -> Path:
    """Where the marks of a run's project are: beside the folder ``runs``, or beside the run where it is not in one."""
    run = run.absolute()
    return (run.parent.parent if run.parent.name == "runs" else run.parent) / MARKS


def mark(run: Path, name: str, same: bool) -> Path:
    """Add a mark for a reference and its replica in a run, in the place of an earlier one; return the file's path.

    Raises RunError for an unknown reference, and for one without a replica.
    """
    record = read_record(run)
    found = {entry["name"]: entry for entry in record["references"]}
    if name not in found:
        raise RunError(f"{run}: no reference {name!r} in this run; its report lists them")
    measures = _measures(found[name])
    if "distance" not in measures:
        raise RunError(f"{run}: {name} has no replica in this run, so there is no pair to mark")
    path = marks_path(run)
    entry = {"a": name, "b": name, "same": same, "run": run.absolute().name, "measures": measures}
    others = [other for other in _read(path) if not _replaces(entry, other)]
    _write(path, [*others, entry])
    return path


def pairs(project: Path) -> list[tuple[str, str, bool]]:
    """What a project's folder holds: a, b, and whether they are the same, of a pair that was judged twice the last."""
    judged = {(entry["a"], entry["b"]): bool(entry["same"]) for entry in _read(project / MARKS)}
    return [(a, b, same) for (a, b), same in judged.items()]


def mark_pair(project: Path, pair: tuple[str, str], same: bool | None, run: Path | None) -> None:
    """Mark a pair, in either order, in place of earlier marks; None takes these away. All other marks stay.

    run: that the pair is judged by, which notes what it measured. Raises RunError.
    """
    a, b = pair
    entries = _read(project / MARKS)
    earlier = [entry for entry in entries if {entry["a"], entry["b"]} == {a, b}]
    entries = [entry for entry in entries if entry not in earlier]
    if same is not None:
        found = {entry["name"]: entry for entry in read_record(run)["references"]} if run else {}
        noted = {"run": run.name, "measures": _measures(found[a])} if run and a == b and a in found else {}
        others = earlier[-1] if earlier else {}
        entries.append({**others, "a": a, "b": b, "same": same, **noted})
    _write(project / MARKS, entries)


def read_marks(run: Path, measured: bool = True) -> list[Mark]:
    """The marks of a run's project. measured: only those whose distance is known, from the file or from this run.

    run: it need not exist yet; the newest run before it says what is not in the file then.
    """
    beside: dict[str, Mapping[str, Any]] = {}
    source = run if (run / RECORD).exists() else previous_run(run)
    if source:
        beside = {entry["name"]: entry for entry in read_record(source)["references"]}
    marks = []
    for entry in _read(marks_path(run)):
        of_run = _measures(beside[entry["a"]]) if entry["a"] == entry["b"] and entry["a"] in beside else {}
        measures = {**of_run, **(entry.get("measures") or {})}
        if "distance" in measures or not measured:
            marks.append(Mark(entry["a"], bool(entry["same"]), measures))
    return marks


def worth_marking(iteration: Judged, count: int = 8, marked: AbstractSet[str] = frozenset()) -> tuple[str, ...]:
    """Names of up to ``count`` references that it would say most of to mark them: the judge is least sure of them.

    Their fidelity is nearest to the cut, or their distance to the threshold where the paper judges. They differ in
    kind: of a group, or of replicas with the same choices, a second one is named only when every kind has one. What the
    judge is sure of is left out, and so is what is ``marked`` already.
    """
    settings = iteration.settings

    def doubt(result: Result) -> float:
        if settings.judge == "paper":
            return abs(result.distance / iteration.metric.threshold - 1.0) / 2.0
        return abs(result.fidelity - settings.replicated)

    open_ones = [result for result in iteration.results if result.name not in marked and doubt(result) <= DOUBTFUL]
    open_ones.sort(key=doubt)
    seen: Counter[Hashable] = Counter()
    turns: list[tuple[int, int]] = []
    for place, result in enumerate(open_ones):
        kind = _kind(result)
        turns.append((seen[kind], place))
        seen[kind] += 1
    return tuple(open_ones[place].name for _, place in sorted(turns)[:count])


def _kind(result: Result) -> Hashable:
    """What a misfit has in common with its group, and a replica with others that have its choices."""
    if result.group is not None:
        return result.group
    values = result.parameters or {}
    return tuple((name, values[name]) for name in result.active if not isinstance(values[name], float))


def _measures(entry: Mapping[str, Any]) -> dict[str, float]:
    return {name: entry[name] for name in NOTED if entry.get(name) is not None}


def _replaces(new: Mapping[str, Any], old: Mapping[str, Any]) -> bool:
    return (new["a"], new["b"]) == (old["a"], old["b"]) and old.get("run", new["run"]) == new["run"]


def _read(path: Path) -> list[dict[str, Any]]:
    try:
        entries = json.loads(path.read_text(encoding="utf-8"))
        return [{**entry, "a": str(entry["a"]), "b": str(entry["b"]), "same": entry["same"]} for entry in entries]
    except FileNotFoundError:
        return []
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise RunError(f"{path}: these are no marks that can be read ({error}); mend the file or remove it") from error


def _write(path: Path, entries: Sequence[Mapping[str, Any]]) -> None:
    try:
        write_file(path, json.dumps(entries, indent=1) + "\n")
    except OSError as error:
        raise RunError(f"{path}: the mark cannot be written: {error.strerror or error}") from error
