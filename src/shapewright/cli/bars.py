"""Progress bars on standard error, and what is told once above them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import typer
from rich.markup import escape
from rich.progress import BarColumn, MofNCompleteColumn, Progress, ProgressColumn, Task, TextColumn, TimeRemainingColumn
from rich.text import Text

from shapewright.cli.console import err
from shapewright.progress import Listener, Notice
from shapewright.progress import Progress as Event

_DOING = {
    "axes": "finding up and front",
    "sample": "building samples",
    "render": "rendering",
    "train": "training",
    "describe": "describing",
    "predict": "predicting",
    "replicate": "building replicas",
    "refine": "refining",
    "compare": "comparing",
    "picture": "drawing pictures",
    "differences": "comparing surfaces",
    "causes": "looking for causes",
    "hypotheses": "looking for rules",
    "trials": "trying suggestions",
}

_OPTIONS = {"pace": "; fewer --samples are quicker, and --within 10min makes all of a fit last so long"}
"""What of the command line helps, behind notices."""


class _Rate(ProgressColumn):
    """Steps a second."""

    def render(self, task: Task) -> Text:
        return Text(f"{task.speed:,.1f}/s" if task.speed else "", style="dim")


@contextmanager
def interruptible(remains: str) -> Iterator[Listener]:
    """``progress_bars``, until the user interrupts: then the command ends, and says what remains of its work."""
    try:
        with progress_bars() as listen:
            yield listen
    except KeyboardInterrupt:
        err.print(f"stopped: {remains}")
        raise typer.Exit(130) from None


@contextmanager
def progress_bars() -> Iterator[Listener]:
    """A listener that draws one bar a stage; on a dumb terminal or in a file, one line a stage."""
    if not err.is_terminal:
        seen: set[str] = set()

        def write(event: Event) -> None:
            if event.notice:
                _print_notice(event.notice)
            elif event.stage not in seen:
                seen.add(event.stage)
                err.print(f"{_DOING.get(event.stage, event.stage)} ({event.total}) ...", highlight=False)

        yield write
        return
    columns = (TextColumn("{task.description:>18}"), BarColumn(), MofNCompleteColumn(), _Rate(), TimeRemainingColumn())
    with Progress(*columns, TextColumn("[dim]{task.fields[remark]}"), console=err) as bars:
        tasks: dict[str, Any] = {}

        def listen(event: Event) -> None:
            if event.notice:
                _print_notice(event.notice)
                return
            if event.stage not in tasks:
                tasks[event.stage] = bars.add_task(_DOING.get(event.stage, event.stage), total=event.total, remark="")
            left = "" if event.left is None else f"about {event.left:.0f} s left in all"
            remark = escape(event.remark or left)
            bars.update(tasks[event.stage], completed=event.done, total=event.total, remark=remark)

        yield listen


def _print_notice(notice: Notice) -> None:
    style = "yellow" if notice.kind in ("stochastic", "lying", "size") else "dim"
    text = escape(notice.text + _OPTIONS.get(notice.kind, ""))
    err.print(f"[{style}]{text}[/]", highlight=False, soft_wrap=True)
