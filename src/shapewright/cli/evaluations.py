"""The command ``shapewright evaluate``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal

import typer

from shapewright.cli.bars import progress_bars
from shapewright.cli.console import evaluation_means, out, print_evaluations, print_json
from shapewright.cli.options import ClusterOption, Json, PresetOption, ProcedureArgument, with_settings
from shapewright.procedures import load_procedure
from shapewright.settings import Settings


@with_settings("samples", "epochs", "cameras", "views", "augment", "refine", "device", "workers", "verbose")
def evaluate(
    procedure: ProcedureArgument,
    chosen: Mapping[str, Any],
    seeds: Annotated[int, typer.Option(min=1, help="Trainings, each with another seed.")] = 1,
    preset: PresetOption = "fast",
    refined: Annotated[int, typer.Option(min=1, help="Held-out samples that the search is measured on.")] = 100,
    compare: Annotated[
        Literal["cameras", "views", "both"] | None,
        typer.Option(help="cameras: fixed against learned; views: 1, 2, 3 and 5 cameras; both: all combinations."),
    ] = None,
    cluster: ClusterOption = None,
    json: Json = False,
) -> None:
    """Measure how well the parameters of a procedure are predicted, on samples that were held out."""
    from shapewright.building.clusters import where
    from shapewright.fitting.evaluation import evaluate as train_and_measure
    from shapewright.fitting.evaluation import summary, variants

    settings = Settings.preset(preset, **chosen)
    author = load_procedure(procedure)
    records = []
    for variant in variants(settings, compare):
        with where(cluster) as there, progress_bars() as listen:
            results = train_and_measure(author, variant, range(seeds), listen, refined, there)
        seconds = [result.seconds for result in results]
        table = summary(results)
        record = {"cameras": variant.cameras, "views": variant.views, "parameters": table, "seconds": seconds}
        records.append(record | {"means": evaluation_means(results)})
        if not json:
            if compare:
                out.print(f"\n[bold]{variant.cameras} cameras, {variant.views}[/]", highlight=False)
            print_evaluations(results)
    if json:
        print_json({"variants": records} if compare else records[0])
