"""What the command line prints at its end: summaries and JSON on standard output."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from shlex import quote
from typing import TYPE_CHECKING, Any

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from shapewright.settings import Settings

if TYPE_CHECKING:
    from shapewright.fitting.evaluation import Evaluation
    from shapewright.judging.calibration import Calibration
    from shapewright.judging.target import Measures
    from shapewright.judging.verdict import Grade
    from shapewright.runs.changes import Comparison
    from shapewright.runs.iteration import Iteration

out, err = Console(), Console(stderr=True)
_MOST = 10  # lines of remarks on references


def print_json(value: Any) -> None:
    """One JSON object as one line on standard output."""
    typer.echo(json.dumps(value, allow_nan=False))


def print_iteration(iteration: Iteration, folder: Path) -> None:
    """Counts, groups, held-out metrics, and where the report is."""
    out.print(f"\n{_counts(iteration)}", highlight=False)
    skipped = iteration.collection["skipped"]
    if skipped:
        out.print(f"[yellow]{len(skipped)} {'file' if len(skipped) == 1 else 'files'} could not be read:[/]")
        for path, reason in list(skipped.items())[:5]:
            out.print(f"  {escape(path)}: {escape(reason)}", highlight=False, soft_wrap=True)
    for line in iteration.remarks[:_MOST]:
        out.print(f"[yellow]{escape(line)}[/]", highlight=False, soft_wrap=True)
    if iteration.metrics["failed"]:
        out.print(f"[yellow]{iteration.metrics['failed']} samples failed:[/] {escape(iteration.metrics['failures'])}")
    print_means([result.measured for result in iteration], [result.grade for result in iteration])
    if iteration.groups:
        value = "fidelity" if iteration.settings.judge == "fidelity" else "distance"
        table = Table("group", "references", value, box=None, header_style="dim", title_justify="left")
        for group in iteration.groups[:10]:
            measured = iteration[group.representative].measures[value]
            table.add_row(escape(group.representative), str(len(group)), f"{measured:.2f}")
        out.print("\nmisfits that look alike, by the one in their middle:")
        out.print(table)
        if len(iteration.groups) > 10:
            out.print(f"  and {len(iteration.groups) - 10} more groups")
    asked = iteration.head["worth_marking"]
    if asked:
        out.print("\nthe judge is least sure of these; mark what you see, and it learns your eye:")
        for name in asked:
            command = f"shapewright mark {quote(os.path.relpath(folder))} {quote(name)} same|different"
            out.print(f"  {escape(command)}", highlight=False, soft_wrap=True)
    out.print(
        f"\n[dim]{sum(iteration.seconds.values()):.0f} s[/]   report: {escape(str(folder / 'report.html'))}",
        soft_wrap=True,
    )


def _counts(iteration: Iteration) -> str:
    """How many references are replicated, close, different; and how many by the paper's measure."""
    total, criterion = len(iteration), iteration.metric.criterion
    if iteration.settings.judge == "paper":
        iou = f"{iteration.means['iou']:.3f}"
        return (
            f"[bold]{len(iteration.compatible)} of {total}[/] references are compatible ({criterion}); mean IoU {iou}"
        )
    close, different = len(iteration.close), len(iteration.different)
    return (
        f"[bold]{len(iteration.replicated)} of {total}[/] references are replicated, "
        f"{close} close, {different} different\n"
        f"[dim]paper's measure: {len(iteration.compatible)} of {total} ({criterion})[/]"
    )


def print_means(measured: Sequence[Measures], grades: Sequence[Grade]) -> None:
    """The mean of each measure, of all references and of the replicated ones."""
    from shapewright.judging.target import Measures, means

    found = [of.by_name() for of in means(measured, grades).values()]
    table = Table("mean measure", "all", "replicated", box=None, header_style="dim")
    for name, words in Measures.words().items():
        if not math.isnan(found[0][name]):
            table.add_row(words, *("" if math.isnan(of[name]) else f"{of[name]:.3f}" for of in found))
    if table.rows:
        out.print(table)


def means_record(measured: Sequence[Measures], grades: Sequence[Grade]) -> dict[str, dict[str, float | None]]:
    """The same for JSON; NaN becomes null."""
    from shapewright.judging.target import means

    return {
        which: {name: None if math.isnan(value) else value for name, value in of.by_name().items()}
        for which, of in means(measured, grades).items()
    }


def iteration_record(iteration: Iteration, folder: Path) -> dict[str, Any]:
    """What ``fit --json`` prints."""
    from shapewright.runs.result import MEASURES

    record = iteration.head
    return {
        "run": str(folder),
        "report": str(folder / "report.html"),
        "references": len(iteration),
        "metric": record["metric"],
        "judge": iteration.settings.judge,
        "replicated": len(iteration.replicated),
        "close": len(iteration.close),
        "different": len(iteration.different),
        "compatible": len(iteration.compatible),
        "incompatible": len(iteration) - len(iteration.compatible),
        "axes": record["collection"]["axes"],
        "skipped": record["collection"]["skipped"],
        "left_out": record["collection"].get("left_out", {}),
        "notes": {result.name: list(result.notes) for result in iteration if result.notes},
        "follows": {result.name: result.follows for result in iteration if result.follows},
        "groups": record["groups"],
        "worth_marking": record["worth_marking"],
        "means": means_record([result.measured for result in iteration], [result.grade for result in iteration]),
        "metrics": record["metrics"]["validation"],
        "failed_samples": record["metrics"]["failed"],
        "seconds": record["seconds"],
        "results": {
            entry["name"]: {key: entry[key] for key in ("parameters", "grade", *MEASURES, "compatible", "group")}
            for entry in iteration.entries()
        },
    }


def print_explanation(record: Mapping[str, Any], folder: Path) -> None:
    """What the misfits have in common, and what to write next."""
    if record.get("sample"):
        out.print(f"{escape(record['sample']['text'])}\n", highlight=False, soft_wrap=True)
    if not record["summary"]:
        out.print("every reference that has a replica is replicated")
    for shared in record["summary"]:
        like = f"  [dim]like {escape(shared['representative'])}[/]"
        out.print(f"{escape(shared['text'])}{like}", highlight=False, soft_wrap=True)
    for number, suggestion in enumerate(record["suggestions"], start=1):
        title = f"\n[bold]{number}. {escape(suggestion['title'])}[/]  +{suggestion['gain']}"
        out.print(title, highlight=False, soft_wrap=True)
        out.print(escape(suggestion["text"]), highlight=False, soft_wrap=True)
    if record.get("unsuggested"):
        out.print(escape(record["unsuggested"]), highlight=False, soft_wrap=True)
    spent = sum(record["seconds"].values())
    out.print(f"\n[dim]{spent:.0f} s[/]   report: {escape(str(folder / 'report.html'))}", soft_wrap=True)


def print_calibration(path: Path, found: Calibration) -> None:
    """What the marks say so far."""
    out.print(f"{found.marks} marks in {escape(str(path))}", highlight=False, soft_wrap=True)
    learned = (
        ("fidelity", found.replicated, found.fidelity_accuracy, Settings.replicated, found.default_fidelity_accuracy),
        ("paper's threshold", found.threshold, found.accuracy, Settings.threshold, found.default_accuracy),
    )
    for what, cut, accuracy, usual, default in learned:
        sure = "" if accuracy is None else f", right for {accuracy:.0%} of marks that it has not seen"
        was = "" if default is None else f" ({usual:g} is right for {default:.0%})"
        out.print(f"{what} {cut:.3f}{sure}{was}", highlight=False)
    if found.metric and found.metric_accuracy is not None:
        out.print(f"distance, IoU and depth together: right for {found.metric_accuracy:.0%}", highlight=False)
    out.print("[dim]use it with: shapewright fit PROCEDURE REFERENCES --marks[/]")


def print_evaluations(evaluations: Sequence[Evaluation]) -> None:
    """Errors by parameter, of the network alone and after the search; with several seeds their range as well."""
    from shapewright.fitting.evaluation import summary

    first = evaluations[0].metrics
    table = Table(
        "parameter", "kind", "measure", "network", "refined", "within 50 %, 90 %", box=None, header_style="dim"
    )
    for name, ranges in summary(evaluations).items():
        measure = "MAE" if first[name]["kind"] == "scalar" else "F1"
        cells = [_range(*ranges[label]) if label in ranges else "" for label in ("network", "refined")]
        shares = [f"{first[name][key]:.2f}" for key in ("within50", "within90") if key in first[name]]
        table.add_row(escape(name), first[name]["kind"], measure, *cells, ", ".join(shares))
    out.print(table)
    print_means(*_refined_replicas(evaluations))
    out.print(f"[dim]{sum(e.seconds for e in evaluations) / len(evaluations):.0f} s to train[/]", highlight=False)


def evaluation_means(evaluations: Sequence[Evaluation]) -> dict[str, dict[str, float | None]]:
    """Of the refined replicas of held-out samples, see ``means_record``."""
    return means_record(*_refined_replicas(evaluations))


def _refined_replicas(evaluations: Sequence[Evaluation]) -> tuple[list[Measures], list[Grade]]:
    return [m for each in evaluations for m in each.measured], [g for each in evaluations for g in each.grades]


def _range(mean: float, low: float, high: float) -> str:
    return f"{mean:.4f}" if low == high else f"{mean:.4f} ({low:.4f} to {high:.4f})"


def print_comparison(before: Path, after: Path, comparison: Comparison) -> None:
    """What changed between two runs, and how far each reference moved."""
    by = "fidelity" if comparison.judge == "fidelity" else "the paper's distance"
    out.print(f"from {escape(str(before))} to {escape(str(after))}, by {by}", highlight=False)
    word = "replicated" if comparison.judge == "fidelity" else "compatible"
    for title, moves in (
        (f"newly {word}", comparison.gained),
        ("lost", comparison.lost),
        (f"closer, and {word} both times or neither time", comparison.closer),
        (f"further, and {word} both times or neither time", comparison.further),
    ):
        out.print(f"\n[bold]{len(moves)}[/] {title}", highlight=False)
        for move in moves:
            out.print(f"  {_distance(move.before)} -> {_distance(move.after)}  {escape(move.name)}", highlight=False)
    for title, names in (("only in the new run", comparison.added), ("only in the old run", comparison.removed)):
        if names:
            out.print(f"\n[bold]{len(names)}[/] {title}: {escape(', '.join(names))}", highlight=False)


def _distance(value: float | None) -> str:
    return "  none" if value is None else f"{value:6.3f}"
