"""The command line: each command, and what a failure prints."""

from __future__ import annotations

import io
import sys

import typer
from rich.markup import escape

from shapewright.building import ExecutorError
from shapewright.cli.checks import check
from shapewright.cli.console import err, print_json
from shapewright.cli.evaluations import evaluate
from shapewright.cli.fits import fit
from shapewright.cli.projects import demo, new
from shapewright.cli.rules import rules
from shapewright.cli.runs import compare, explain, mark, parameters, report
from shapewright.cli.shape_files import describe, sample, samples, silhouettes
from shapewright.cli.studio import studio
from shapewright.procedures import ProcedureError
from shapewright.references.errors import CollectionError
from shapewright.runs.folder import RunError
from shapewright.studio.project.workspace import ProjectError

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode="rich",
    help="Find the parameters that replicate a collection of shapes, and see what the procedure cannot make yet.",
    epilog="Start with [bold]shapewright demo[/], or with [bold]shapewright new chairs[/] for a project of your own.",
)
_SHAPES = (describe, sample, silhouettes)
for command in (new, check, fit, explain, mark, evaluate, *_SHAPES, report, parameters, compare, studio, demo):
    app.command()(command)
app.add_typer(rules, name="rules")
app.add_typer(samples, name="samples")


def main() -> None:
    """Run a command; a failure prints one message that says what to do, and the exit status is not 0."""
    for stream in (sys.stdout, sys.stderr):  # names of files may hold what no terminal can show
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    try:
        app()
    except KeyboardInterrupt:
        sys.exit(130)
    except (ProcedureError, CollectionError, RunError, ProjectError, ExecutorError, ValueError, OSError) as error:
        err.print(f"[bold red]error:[/] {escape(str(error))}", highlight=False, soft_wrap=True)
        if "--json" in sys.argv:
            print_json({"error": str(error)})
        sys.exit(1)
