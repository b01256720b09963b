"""Options that several commands share; those of settings are made from the settings' fields."""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import typer

from shapewright.building.clusters import ClusterName
from shapewright.settings import Preset, Settings, described

Parsed = TypeVar("Parsed")
FLAGS = {"shape_seconds": "--time-limit", "shape_memory_mb": "--memory-limit", "verbose": "--verbose"}
"""Options that have another name than their setting."""


def option(name: str, default: Any = None) -> Any:
    """The option of a setting. default: its value where it is not given, if that is not the setting's own."""
    field = described()[name]
    default = field.default if default is None else default
    paper = getattr(Settings.preset("paper"), name)
    other = "" if paper == field.default else f"; of the preset paper: {paper}"
    text = "" if default is None or default is False else f"  [dim]default: {default}{other}[/]"
    flag = FLAGS.get(name, f"--{name.replace('_', '-')}")
    if name == "within":
        return typer.Option(flag, parser=seconds_of, metavar="TIME", help=f"{field.help}  [dim]90s, 10min, 1h[/]")
    return typer.Option(flag, min=field.within.least, max=field.within.most, help=field.help + text, show_default=False)


def seconds_of(text: str) -> float:
    """What ``90s``, ``10min``, ``1.5h`` or ``90`` means in seconds. Raises typer.BadParameter."""
    found = re.fullmatch(r"\s*(\d+(?:\.\d+)?|\.\d+)\s*(s|sec|min|m|h)?\s*", text)
    if not found or float(found[1]) == 0.0:
        raise typer.BadParameter(f"{text!r} is no time: write 90s, 10min or 1h")
    return float(found[1]) * {"m": 60.0, "min": 60.0, "h": 3600.0}.get(found[2], 1.0)


def parsed(parse: Callable[[str], Parsed]) -> Callable[[str], Parsed]:
    """A parser of an option's text, whose ValueError becomes an error of the command line."""

    def read(text: str) -> Parsed:
        try:
            return parse(text)
        except ValueError as error:
            raise typer.BadParameter(str(error)) from None

    return read


ProcedureArgument = Annotated[
    Path,
    typer.Argument(
        help="The Python file with the @procedure; file.py:name for one of several. "
        "Or a .scad, a .blend:Group or a spec.toml."
    ),
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object as the last line of standard output.")]
PRESET = typer.Option("--preset", help="fast is made for laptops; paper is the paper's, made for a GPU.")
PresetOption = Annotated[Preset, PRESET]
Seed = Annotated[int, option("seed")]
Workers = Annotated[int | None, option("workers")]
ClusterOption = Annotated[
    ClusterName | None,
    typer.Option(
        "--cluster",
        parser=parsed(ClusterName.parse),
        metavar="CLUSTER",
        help="Build, search and judge on other machines: dask:ADDRESS of a scheduler, slurm:partition=P,array=N for N "
        "jobs at a time; dask:local:N and slurm:local:N for N processes of this one.",
    ),
]
Up = Annotated[
    str, typer.Option(help="The axis of the files that points up: x, y, z, -x, -y, -z; auto finds up and front.")
]
Front = Annotated[
    str | None, typer.Option(help="The axis that points to the front.  [dim]default: z, or -y where up is z[/]")
]
Keep = Annotated[
    list[str] | None,
    typer.Option(help="What is left in scans: floor, strays or density; give it once for each.", show_default=False),
]
Command = TypeVar("Command", bound=Callable[..., None])


def with_settings(*names: str, **defaults: Any) -> Callable[[Command], Command]:
    """Give a command an option for each of these settings, in the place of its parameter ``chosen``.

    The command gets a mapping there: the settings whose options were given, and ``defaults`` for those that were not.
    """

    def decorate(command: Command) -> Command:
        signature = inspect.signature(command, eval_str=True)
        options = [_parameter(name, defaults.get(name)) for name in names]
        parameters: list[inspect.Parameter] = []
        for parameter in signature.parameters.values():
            parameters += options if parameter.name == "chosen" else [parameter]

        @functools.wraps(command)
        def run(**given: Any) -> None:
            chosen = {name: value for name in names if (value := given.pop(name)) is not None}
            command(**given, chosen=defaults | chosen)

        run.__signature__ = signature.replace(parameters=parameters)  # type: ignore[attr-defined]
        run.__annotations__ = {parameter.name: parameter.annotation for parameter in parameters}
        return run  # type: ignore[return-value]

    return decorate


def _parameter(name: str, default: Any) -> inspect.Parameter:
    """None where the option is not given, so that the preset decides."""
    field = described()[name]
    kind: Any = Literal[field.choices] if field.choices else field.kind
    annotation = Annotated[kind | None, option(name, default)]
    return inspect.Parameter(name, inspect.Parameter.POSITIONAL_OR_KEYWORD, default=None, annotation=annotation)
