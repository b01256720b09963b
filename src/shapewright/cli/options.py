"""Options that several commands of the command line share."""

from pathlib import Path
from typing import Annotated, Literal

import typer

ProcedureArgument = Annotated[
    Path, typer.Argument(help="The Python file with the @procedure; file.py:name for one of several.")
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object as the last line of standard output.")]
Seed = Annotated[int, typer.Option(help="Of everything random: the same seed gives the same result.")]
Preset = Annotated[
    Literal["fast", "paper"], typer.Option(help="fast is made for laptops; paper is the paper's, made for a GPU.")
]
Samples = Annotated[
    int | None, typer.Option(min=20, help="Parameter vectors to learn from.  [dim]default: the preset's[/]")
]
Epochs = Annotated[int | None, typer.Option(min=1, help="Passes over them.  [dim]default: the preset's[/]")]
Cameras = Annotated[
    Literal["fixed", "learned"] | None, typer.Option(help="Whether they move.  [dim]default: the preset's[/]")
]
Views = Annotated[int | None, typer.Option(min=1, max=32, help="Number of cameras.  [dim]default: the preset's[/]")]
Augment = Annotated[
    bool,
    typer.Option("--augment", help="Train on shapes turned, stretched and jittered a little."),
]
Refine = Annotated[
    Literal["off", "quick", "thorough"] | None,
    typer.Option(help="Search on from the prediction.  [dim]default: the preset's[/]"),
]
Device = Annotated[Literal["auto", "cpu", "cuda", "mps"], typer.Option(help="What to train on.")]
Up = Annotated[str, typer.Option(help="The axis of the files that points up: x, y, z, -x, -y, -z.")]
Front = Annotated[
    str | None, typer.Option(help="The axis that points to the front.  [dim]default: z, or -y where up is z[/]")
]
Workers = Annotated[int | None, typer.Option(min=1, help="Processes and threads.  [dim]default: all cores[/]")]
