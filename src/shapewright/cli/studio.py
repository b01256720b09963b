"""The command ``shapewright studio``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from shapewright.cli.options import PRESET, Front, Keep, Up, with_settings
from shapewright.settings import Preset
from shapewright.studio.project.preferences import SHAPE_SECONDS, Preferences


@with_settings(
    *("samples", "epochs", "refine", "shape_seconds", "shape_memory_mb", "workers"), shape_seconds=SHAPE_SECONDS
)
def studio(
    chosen: Mapping[str, Any],
    folder: Annotated[
        Path, typer.Argument(help="The project: a folder as [bold]shapewright new[/] makes it.")
    ] = Path(),
    port: Annotated[
        int | None, typer.Option(min=1, max=65535, help="Port to listen on.  [dim]default: 8470, or any free one[/]")
    ] = None,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
    procedure: Annotated[str, typer.Option(help="The procedure's file in the project.")] = "procedure.py",
    references: Annotated[
        str | None,
        typer.Option(help="A folder, glob or CSV manifest anywhere.  [dim]default: the project's references[/]"),
    ] = None,
    up: Up = "y",
    front: Front = None,
    keep: Keep = None,
    preset: Annotated[Preset | None, PRESET] = None,
    auto_fit: Annotated[bool | None, typer.Option(help="Fit after every save; the page can change that.")] = None,
    host: Annotated[str, typer.Option(help="Address to listen on; others than this machine's own need the next.")] = (
        "127.0.0.1"
    ),
    allow_remote: Annotated[
        bool, typer.Option("--allow-remote", help="Let others reach the studio: who has its token runs code as you.")
    ] = False,
    keep_token: Annotated[
        bool,
        typer.Option(
            "--keep-token",
            help="Keep the token for the next start, in a file that only you can read: open pages connect again.",
        ),
    ] = False,
) -> None:
    """Open the project as a page in the browser: the loop of editing, fitting and looking, live."""
    from shapewright.studio.project.workspace import Project
    from shapewright.studio.server.launch import serve

    project = Project.of(folder, procedure, references, up, front, tuple(keep or ()))
    named = {"auto_fit": auto_fit, "preset": preset, **chosen}
    usual = {"shape_seconds": SHAPE_SECONDS}
    given = {name: value for name, value in named.items() if value not in (None, usual.get(name))}
    serve(
        project,
        Preferences.at_start(project.kept_settings(), given),
        host,
        port,
        allow_remote,
        browser,
        lambda address: typer.echo(address),
        keep_token,
    )
