"""The command ``shapewright check``: what a collection is, before any procedure exists."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.markup import escape
from rich.table import Table

from shapewright.cli.console import out, print_json
from shapewright.cli.options import Front, Json, Up, with_settings
from shapewright.settings import Settings

if TYPE_CHECKING:
    from shapewright.survey.survey import Survey


@with_settings("drop", "split", "duplicates", "leave_out", "workers")
def check(
    references: Annotated[str, typer.Argument(help="A folder, a glob in quotes, a CSV manifest, or a file.")],
    chosen: Mapping[str, Any],
    out_dir: Annotated[Path, typer.Option("--out", help="Folder of the page check.html.")] = Path("check"),
    up: Up = "y",
    front: Front = None,
    json: Json = False,
) -> None:
    """Say what was read, how, and what is odd, with a picture of each reference; no procedure is needed."""
    from shapewright.survey.page import write_page
    from shapewright.survey.survey import check as look

    settings = Settings(**chosen)
    survey = look(references, settings, up=up, front=front, threads=settings.workers)
    page = write_page(survey, out_dir)
    if json:
        print_json({"page": str(page.absolute()), **survey.record()})
    else:
        _print(survey, page)


def _print(survey: Survey, page: Path) -> None:
    from shapewright.survey.page import dimensions

    columns = ("reference", "format", "triangles", "pieces", "size", "up, front", "seems", "")
    table = Table(*columns, box=None, header_style="dim")
    for facts in survey.facts:
        told = [*(f"[yellow]{escape(words)}[/]" for words in facts.odd), *map(escape, facts.notes)]
        axes = f"{facts.up}, {facts.front}" if facts.up else ""
        numbers = ("" if number is None else f"{number:,}" for number in (facts.count, facts.pieces))
        size = dimensions(facts.size, facts.unit)
        table.add_row(escape(facts.name), facts.format, *numbers, size, axes, facts.seems, "\n".join(told))
    out.print(table)
    if any(facts.seems for facts in survey.facts):
        out.print("\n[dim]--up auto turns references as they seem to stand[/]", highlight=False)
    for title, some in (("could not be read", survey.skipped), ("left out", survey.references.left_out)):
        if some:
            out.print(f"\n[yellow]{len(some)} {title}:[/]", highlight=False)
            for name, reason in some.items():
                out.print(f"  {escape(name)}: {escape(reason)}", highlight=False, soft_wrap=True)
    out.print(f"\n[dim]pictures:[/] {escape(str(page))}", highlight=False, soft_wrap=True)
