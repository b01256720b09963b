"""The report of a recorded iteration: one static HTML file that needs nothing but itself."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined

from shapewright.judging.paper import Metric
from shapewright.judging.target import Measures
from shapewright.judging.verdict import Grade
from shapewright.report.axes_sheet import SHEET, draw_sheet
from shapewright.report.division import FOLDER, Page, divided
from shapewright.report.explained import boxes, embedded, outlines, quiet, read_explanation, told_cause
from shapewright.report.figures import cameras, curves, frame
from shapewright.report.scale import GRADES, Scale
from shapewright.runs.changes import compare
from shapewright.runs.folder import read_record
from shapewright.runs.packed import is_packed, read
from shapewright.runs.result import grade_in
from shapewright.storage import write_file


def write_report(folder: str | Path, previous: str | Path | None = None, explanation: Path | None = None) -> Path:
    """Write ``folder/report.html`` from ``folder/iteration.json`` and ``folder/thumbnails``; return its path.

    The page holds its pictures, so that one can move or send the file; only its links to replicas (GLB) point into the
    folder. Of more than 1,000 references the first page shows one of each group, and pages in ``folder/report`` show
    all. A missing thumbnail stays blank. Raises RunError for a folder without a record, or with one of another
    format.

    Args:
        folder: of the run.
        previous: the folder of an earlier run to compare with.
        explanation: the folder of ``explanation.json``, if it is another one; without that file nothing is explained.
    """
    folder = Path(folder).expanduser()
    previous = Path(previous).expanduser() if previous else None
    record = read_record(folder)
    earlier = read_record(previous) if previous else None
    environment = Environment(
        loader=PackageLoader("shapewright.report", "."),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= {"number": _number, "duration": _duration, "value": _value}
    template = environment.get_template("report.html.jinja")
    told = read_explanation(explanation or folder)
    shared = {
        "run": folder.resolve().name,
        "before": previous.resolve().name if previous else None,
        "comparison": compare(earlier, record) if earlier else None,
        "previous": earlier,
    }
    references = {reference["name"]: reference for reference in record["references"]}
    whole = _Whole.of(record, references)
    pages = divided(whole.groups, whole.ungrouped, whole.replicated, record.get("worth_marking", []))
    if record["collection"].get("axes"):
        sheet = io.BytesIO()
        draw_sheet(folder, record["references"], record["collection"]["axes"]).save(sheet, "PNG")
        write_file(folder / SHEET, sheet.getvalue())
    for page in reversed(pages):
        (folder / page.file).parent.mkdir(exist_ok=True)
        contents = _contents(record, folder, told if page.number == 0 else told and _of_references(told), whole, page)
        write_file(folder / page.file, template.render(**shared, **contents, **_linked(pages, page)))
    for left in (folder / FOLDER).glob("*.html"):
        if int(left.stem) >= len(pages):
            left.unlink()
    return folder / pages[0].file


@dataclass(frozen=True)
class _Whole:
    """What the first page says of all references."""

    scale: Scale
    references: Mapping[str, dict[str, Any]]
    groups: Sequence[Sequence[str]]  # members, the representative first
    ungrouped: Sequence[str]
    replicated: Sequence[str]
    grades: Mapping[str, Grade]

    @classmethod
    def of(cls, record: Mapping[str, Any], references: Mapping[str, dict[str, Any]]) -> _Whole:
        scale = Scale.of(record)

        def ordered(names: Iterable[str]) -> list[str]:
            return scale.ordered([references[name] for name in names])

        groups = [
            [group["representative"], *ordered(name for name in group["members"] if name != group["representative"])]
            for group in record["groups"]
        ]
        grouped = {name for group in groups for name in group}
        grades = {name: grade_in(reference) for name, reference in references.items()}
        replicated = ordered(name for name in references if grades[name] == "replicated")
        ungrouped = ordered(name for name in references if name not in grouped and grades[name] != "replicated")
        return cls(scale, references, groups, ungrouped, replicated, grades)


def _of_references(told: dict[str, Any]) -> dict[str, Any]:
    """Of an explanation what pages but the first show."""
    return {"references": told["references"], "suggestions": [], "tried": [], "sought": None, "summary": []}


def _linked(pages: Sequence[Page], page: Page) -> dict[str, Any]:
    """The links of a page to all others."""
    up = "../" if page.number else ""
    at = {name: f"{up}{each.file}" for each in pages[1:] for group in each.groups for name in group}
    return {
        "pages": [{"number": each.number, "file": f"{up}{each.file}"} for each in pages] if len(pages) > 1 else [],
        "page": page.number,
        "page_of": at,
        "up": up,
    }


def _contents(
    record: dict[str, Any], folder: Path, explanation: dict[str, Any] | None, whole: _Whole, page: Page
) -> dict[str, Any]:
    """What the template shows. A pair is known by its index in the order of the page."""
    scale, metric, references = whole.scale, Metric.of_record(record), whole.references
    index = {name: i for i, name in enumerate(page.names)}
    told = explanation["references"] if explanation else {}
    parameters = record["procedure"]["parameters"]
    pairs = [_pair(references[name], folder, scale, parameters, told.get(name)) for name in page.names]
    criterion = metric.criterion if "metric" in record else f"distance at most {_value(record['threshold'])}"
    grades = whole.grades.values()
    return {
        "record": record,
        "created": _date(record["created"]),
        "pairs": pairs,
        "explanation": explanation,
        "index": index,
        "groups": [[index[name] for name in group] for group in page.groups],
        "ungrouped": [index[name] for name in page.ungrouped],
        "no_replica": all(scale.value(references[name]) is None for name in whole.ungrouped),
        "replicated": [index[name] for name in page.replicated],
        "total": len(references),
        "of_all": {
            "groups": len(whole.groups),
            "misfits": len(references) - len(whole.replicated) - len(whole.ungrouped),
            "ungrouped": len(whole.ungrouped),
            "replicated": len(whole.replicated),
            "sizes": {group[0]: len(group) for group in whole.groups},
            "noted": [reference for reference in references.values() if reference.get("notes")],
        },
        "counts": {grade: sum(of == grade for of in grades) for grade in GRADES},
        "compatible": sum(reference["compatible"] for reference in references.values()),
        "strip": [index[name] for name in scale.ordered([references[name] for name in page.names])],
        "scale": scale,
        "asked": [index[name] for name in record.get("worth_marking", []) if name in index],
        "papers": criterion,
        "criterion": criterion if scale.judge == "paper" else f"fidelity at least {_value(scale.cuts['replicated'])}",
        "measures": _measures(list(references.values()), whole.grades),
        "frame": frame([picture for pair in pairs for picture in pair["pictures"]]),
        "at_limit": {
            parameter["name"]: sum(parameter["name"] in reference["at_limit"] for reference in references.values())
            for parameter in parameters
        },
        "curves": curves(record["metrics"]["curve"]),
        "cameras": cameras(record["metrics"].get("cameras")),
        "data": {"parameters": [_parameter(p) for p in parameters], "pairs": _details(pairs)},
    }


def _pair(
    reference: dict[str, Any],
    folder: Path,
    scale: Scale,
    parameters: list[dict[str, Any]],
    told: dict[str, Any] | None,
) -> dict[str, Any]:
    names = [f"thumbnails/{reference['slug']}.{kind}.png" for kind in ("reference", "replica")]
    pictures = [read(folder, name) for name in names]
    causes, grade = told["causes"] if told else [], grade_in(reference)
    regions = outlines(told) if told else boxes(reference)
    return {
        "follows": None,
        "notes": [],
        **reference,
        "points": reference.get("points"),
        "grade": grade,
        "value": scale.value(reference),
        "title": scale.title(reference),
        "regions": [
            {"kind": kind, "sizes": [f"{region['size']:.0%}".replace("%", " %") for region in reference.get(kind, ())]}
            for kind in ("missing", "surplus")
        ],
        "causes": [told_cause(cause) for cause in causes],
        "quiet": quiet(told, grade),
        "outlines": regions if grade != "replicated" else ([], []),
        "colour": scale.colour(reference),
        "tint": scale.tint(reference),
        "pictures": pictures,
        "sources": [picture and embedded(picture) for picture in pictures],
        "link": (replica := reference["replica"]) and (None if is_packed(folder, replica) else quote(replica)),
        "values": [_shown(p, reference) for p in parameters],
    }


def _measures(
    references: Sequence[Mapping[str, Any]], grades: Mapping[str, Grade]
) -> list[tuple[str, float, float | None]]:
    """What each measure is, its mean over all references with a replica and over the replicated; not unknown ones."""
    rows = []
    replicated = [reference for reference in references if grades[reference["name"]] == "replicated"]
    for name, words in Measures.words().items():
        every = _mean([reference.get(name) for reference in references])
        if every is not None:
            rows.append((words, every, _mean([reference.get(name) for reference in replicated])))
    return rows


def _shown(parameter: dict[str, Any], reference: dict[str, Any]) -> list[Any] | None:
    """A parameter's value in words, its place, whether it has an effect, and whether it is at its limit."""
    name, values = parameter["name"], reference["parameters"] or {}
    if name not in values:
        return None
    words, place = _value(values[name]), _place(parameter, values[name])
    return [words, place, *(name in reference[key] for key in ("active", "at_limit"))]


def _details(pairs: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """What the page's script shows of each pair when it is opened."""
    facts = ("name", "causes", "quiet", "title", "regions", "error", "path", "triangles", "points", "values")
    kept = (*facts, "follows", "notes", "colour", "tint", "link")
    return [
        {key: pair[key] for key in kept}
        | {"value": _number(pair["value"])}
        | {
            "measures": [
                [words, _number(pair[name], 4)]
                for name, words in Measures.words().items()
                if pair.get(name) is not None
            ]
        }
        for pair in pairs
    ]


def _parameter(parameter: dict[str, Any]) -> dict[str, Any]:
    options = [False, True] if parameter["kind"] == "binary" else parameter["options"]
    ends = None if options else [_value(parameter["low"]), _value(parameter["high"])]
    return {"name": parameter["name"], "options": options and [_value(option) for option in options], "ends": ends}


def _place(parameter: dict[str, Any], value: Any) -> float | None:
    """Where a value stands: its part of the range, or its index among the options."""
    if parameter["kind"] == "binary":
        return float(bool(value))
    if parameter["options"]:
        return parameter["options"].index(value) if value in parameter["options"] else None
    span = parameter["high"] - parameter["low"]
    return round(min(max((value - parameter["low"]) / span, 0.0), 1.0), 3) if span else 0.5


def _mean(numbers: list[float | None]) -> float | None:
    known = [number for number in numbers if number is not None]
    return sum(known) / len(known) if known else None


def _date(text: str) -> str:
    date = datetime.fromisoformat(text)
    return f"{date.day} {date:%B %Y, %H:%M} {date.tzname() or ''}".strip()


def _number(number: float | None, digits: int = 3) -> str:
    return "–" if number is None else f"{number:.{digits}f}"


def _value(value: Any) -> str:
    """A parameter's value or a setting, as people write it."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.4g}" if abs(value) < 1e4 else f"{value:.0f}"
    return "–" if value is None else str(value)


def _duration(seconds: float) -> str:
    if seconds < 100.0:
        return f"{seconds:.1f} s"
    return f"{int(seconds // 60)} min {int(seconds % 60)} s"
