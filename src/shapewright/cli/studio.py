"""The command ``shapewright studio``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from shapewright.cli.options import Epochs, Preset, Refine, Samples, Workers
from shapewright.settings import Settings


def studio(
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
    up: Annotated[str, typer.Option(help="The axis of the files that points up: x, y, z, -x, -y, -z.")] = "y",
    front: Annotated[
        str | None, typer.Option(help="The axis that points to the front.  [dim]default: z, or -y where up is z[/]")
    ] = None,
    preset: Preset = "fast",
    samples: Samples = None,
    epochs: Epochs = None,
    refine: Refine = None,
    time_limit: Annotated[float, typer.Option(help="Seconds that building one shape may take.")] = 5.0,
    memory_limit: Annotated[int, typer.Option(help="Megabytes that building one shape may take.")] = 2048,
    auto_fit: Annotated[bool, typer.Option(help="Fit after every save; the page can change that.")] = True,
    host: Annotated[str, typer.Option(help="Address to listen on; others than this machine's own need the next.")] = (
        "127.0.0.1"
    ),
    allow_remote: Annotated[
        bool, typer.Option("--allow-remote", help="Let others reach the studio: who has its token runs code as you.")
    ] = False,
    workers: Workers = None,
) -> None:
    """Open the project as a page in the browser: the loop of editing, fitting and looking, live."""
    from shapewright.studio.project.preferences import Preferences
    from shapewright.studio.project.workspace import Project
    from shapewright.studio.server.launch import serve

    options = {"samples": samples, "epochs": epochs, "refine": refine}
    given = {name: value for name, value in options.items() if value is not None}
    settings = Settings.preset(preset, **given, shape_seconds=time_limit, shape_memory_mb=memory_limit, workers=workers)
    serve(
        Project.of(folder, procedure, references, up, front),
        Preferences(auto_fit=auto_fit, preset=preset, settings=settings),
        host,
        port,
        allow_remote,
        browser,
        lambda address: typer.echo(address),
    )
