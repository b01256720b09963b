"""The report of a recorded iteration: one static HTML file that needs nothing but itself."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable
from datetime import datetime
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jinja2 import Environment, PackageLoader, StrictUndefined
from PIL import Image

from shapewright.judging.paper import Metric
from shapewright.judging.target import Measures
from shapewright.report.axes_sheet import SHEET, draw_sheet
from shapewright.report.explained import boxes, embedded, outlines, quiet, read_explanation, told_cause
from shapewright.report.scale import GRADES, Scale
from shapewright.runs.changes import compare
from shapewright.runs.folder import read_record
from shapewright.runs.result import grade_in
from shapewright.storage import write_file


def write_report(folder: str | Path, previous: str | Path | None = None, explanation: Path | None = None) -> Path:
    """Write ``folder/report.html`` from ``folder/iteration.json`` and ``folder/thumbnails``; return its path.

    The page holds its pictures, so that one can move or send the file; only its links to replicas (GLB) point into the
    folder. A missing thumbnail stays blank. Raises RunError for a folder without a record, or with one of another
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
    page = environment.get_template("report.html.jinja").render(
        run=folder.resolve().name,
        before=previous.resolve().name if previous else None,
        comparison=compare(earlier, record) if earlier else None,
        previous=earlier,
        **_contents(record, folder, read_explanation(explanation or folder)),
    )
    if record["collection"].get("axes"):
        sheet = io.BytesIO()
        draw_sheet(folder, record["references"], record["collection"]["axes"]).save(sheet, "PNG")
        write_file(folder / SHEET, sheet.getvalue())
    path = folder / "report.html"
    write_file(path, page)
    return path


def _contents(record: dict[str, Any], folder: Path, explanation: dict[str, Any] | None) -> dict[str, Any]:
    """What the template shows. A pair is known by its index in the order of the page."""
    scale, metric = Scale.of(record), Metric.of_record(record)
    references = {reference["name"]: reference for reference in record["references"]}

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
    order = [*(name for group in groups for name in group), *ungrouped, *replicated]
    index = {name: i for i, name in enumerate(order)}
    told = explanation["references"] if explanation else {}
    parameters = record["procedure"]["parameters"]
    pairs = [_pair(references[name], folder, scale, parameters, told.get(name)) for name in order]
    criterion = metric.criterion if "metric" in record else f"distance at most {_value(record['threshold'])}"
    return {
        "record": record,
        "created": _date(record["created"]),
        "pairs": pairs,
        "explanation": explanation,
        "index": index,
        "groups": [[index[name] for name in group] for group in groups],
        "ungrouped": [index[name] for name in ungrouped],
        "no_replica": all(scale.value(references[name]) is None for name in ungrouped),
        "replicated": [index[name] for name in replicated],
        "counts": {grade: sum(of == grade for of in grades.values()) for grade in GRADES},
        "compatible": sum(reference["compatible"] for reference in references.values()),
        "strip": [index[name] for name in ordered(references)],
        "scale": scale,
        "asked": [index[name] for name in record.get("worth_marking", []) if name in index],
        "papers": criterion,
        "criterion": criterion if scale.judge == "paper" else f"fidelity at least {_value(scale.cuts['replicated'])}",
        "measures": _measures(pairs),
        "frame": _frame([picture for pair in pairs for picture in pair["pictures"]]),
        "at_limit": {
            parameter["name"]: sum(parameter["name"] in reference["at_limit"] for reference in references.values())
            for parameter in parameters
        },
        "curves": _curves(record["metrics"]["curve"]),
        "cameras": _cameras(record["metrics"].get("cameras")),
        "data": {"parameters": [_parameter(p) for p in parameters], "pairs": _details(pairs)},
    }


def _pair(
    reference: dict[str, Any],
    folder: Path,
    scale: Scale,
    parameters: list[dict[str, Any]],
    told: dict[str, Any] | None,
) -> dict[str, Any]:
    files = [folder / "thumbnails" / f"{reference['slug']}.{kind}.png" for kind in ("reference", "replica")]
    pictures = [file.read_bytes() if file.is_file() else None for file in files]
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
        "link": reference["replica"] and quote(reference["replica"]),
        "values": [_shown(p, reference) for p in parameters],
    }


def _measures(pairs: list[dict[str, Any]]) -> list[tuple[str, float, float | None]]:
    """What each measure is, its mean over all references with a replica and over the replicated; not unknown ones."""
    rows = []
    for name, words in Measures.words().items():
        every = _mean([pair.get(name) for pair in pairs])
        if every is not None:
            rows.append((words, every, _mean([pair.get(name) for pair in pairs if pair["grade"] == "replicated"])))
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


def _frame(pictures: list[bytes | None]) -> dict[str, float]:
    """The part of the thumbnails that any shape covers, as a box of fractions; pages show no more than that."""
    boxes = []
    for picture in pictures:
        if picture:
            image = Image.open(io.BytesIO(picture))
            box = image.getchannel("A").getbbox() if "A" in image.getbands() else None
            boxes.append([edge / image.width for edge in box or (0, 0, image.width, image.height)])
    if not boxes:
        return {"left": 0.0, "top": 0.0, "width": 1.0, "height": 1.0}
    margin = 0.03
    left, top = (max(0.0, min(box[i] for box in boxes) - margin) for i in (0, 1))
    right, bottom = (min(1.0, max(box[i] for box in boxes) + margin) for i in (2, 3))
    return {"left": left, "top": top, "width": right - left, "height": bottom - top}


def _curves(curve: list[dict[str, Any]]) -> dict[str, Any] | None:
    """Training and validation loss as paths in a box of 100 x 100, 0 at the bottom."""
    lines = {
        key: [(row["epoch"], row[key]) for row in curve if row.get(key) is not None] for key in ("train", "validation")
    }
    points = [point for line in lines.values() for point in line]
    if len({epoch for epoch, _ in points}) < 2:
        return None
    (first, last), highest = (min(points)[0], max(points)[0]), max(loss for _, loss in points) or 1.0
    paths = {
        key: "M" + "L".join(f"{(e - first) / (last - first) * 100:.2f} {100 - y / highest * 100:.2f}" for e, y in line)
        for key, line in lines.items()
        if line
    }
    return {
        "paths": paths,
        "ends": {key: line[-1][1] for key, line in lines.items() if line},
        "first": first,
        "last": last,
        "highest": highest,
    }


def _mean(numbers: list[float | None]) -> float | None:
    known = [number for number in numbers if number is not None]
    return sum(known) / len(known) if known else None


def _cameras(places: dict[str, Any] | None) -> list[dict[str, Any]]:
    """Where each camera stood before and after training: as seen from above, the front at the bottom, and in words."""
    if not places or "after" not in places:
        return []

    def above(place: list[float]) -> tuple[float, float]:
        azimuth, elevation, distance = math.radians(place[0]), math.radians(place[1]), place[2]
        return distance * math.cos(elevation) * math.sin(azimuth), distance * math.cos(elevation) * math.cos(azimuth)

    return [
        {"from": above(before), "to": above(after), "before": before, "after": after, "moved": before != after}
        for before, after in zip(places["before"], places["after"], strict=True)
    ]


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
