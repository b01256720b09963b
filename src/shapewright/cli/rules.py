"""Commands for the library of rules that suggestions draw on."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.markup import escape

from shapewright.cli.console import out, print_json
from shapewright.cli.options import Json

rules = typer.Typer(no_args_is_help=True, help="The library of rules that suggestions draw on.")


@rules.command("list")
def listed(json: Json = False) -> None:
    """List all rules: the published ones and those that come with shapewright."""
    from shapewright.rules.library import library

    every = [
        {"name": rule.name, "stance": rule.stance, "parameters": list(rule.space.names), "text": _text(rule.function)}
        for rule in library()
    ]
    if json:
        print_json({"rules": every})
        return
    for one in every:
        out.print(f"[bold]{one['name']}[/]({', '.join(one['parameters'])}) {escape(str(one['text']))}", highlight=False)


@rules.command()
def add(file: Annotated[Path, typer.Argument(help="A Python file with functions under @rule(...).")]) -> None:
    """Publish the rules of a file: suggestions for every project may use them from now on."""
    from shapewright.procedures import ProcedureError
    from shapewright.rules.library import publish, published_folder

    if not file.is_file():
        raise ProcedureError(f"{file}: no such file")
    names = ", ".join(rule.name for rule in publish(file))
    out.print(f"published {escape(names)} in {escape(str(published_folder() / file.name))}", highlight=False)


def _text(function: object) -> str:
    return (getattr(function, "__doc__", "") or "").partition("\n")[0]
