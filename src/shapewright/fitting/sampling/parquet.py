"""The manifest as a Parquet file beside the CSV: the same rows, each column with its type."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

from shapewright.fitting.sampling.making import MEASURES
from shapewright.fitting.sampling.manifest import COLUMNS, MANIFEST
from shapewright.parameters import Binary, Integer, Parameter, ParameterSpace, Scalar
from shapewright.runs.folder import RunError
from shapewright.shapes.soundness import Soundness
from shapewright.storage import remove_leftovers, whole_file

PARQUET = "manifest.parquet"
Types = Mapping[str, Any]
"""The type of each column, pyarrow's."""


def check_installed() -> None:
    """Raise RunError when there is no pyarrow."""
    try:
        import pyarrow  # noqa: F401
    except ImportError:
        raise RunError(f"{PARQUET}: it needs pyarrow: pip install 'shapewright[scale]'") from None


def types_of(space: ParameterSpace) -> Types:
    """The types of a manifest's columns. A cell that is empty in a column of numbers or truths is null."""
    import pyarrow

    named = {"float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_(), "str": pyarrow.string()}
    measured = {field.name: str(field.type) for field in fields(Soundness)}
    measures = {name: named[measured.get(name, "bool")] for name in MEASURES}
    parameters = {parameter.name: named[_kind(parameter)] for parameter in space}
    return {COLUMNS[0]: named["str"], **parameters, **measures, COLUMNS[-1]: named["str"]}


def types_in(folder: Path) -> Types:
    """The types of a Parquet manifest that is there."""
    from pyarrow import parquet

    schema = parquet.read_schema(folder / PARQUET)
    return dict(zip(schema.names, schema.types, strict=True))


def write(folder: Path, types: Types) -> None:
    """Write the folder's manifest as Parquet, whole or not at all; the same CSV gives the same bytes."""
    from pyarrow import csv as tables
    from pyarrow import parquet

    table = tables.read_csv(
        folder / MANIFEST,
        tables.ReadOptions(use_threads=False),
        tables.ParseOptions(newlines_in_values=True),
        tables.ConvertOptions(
            column_types=types,
            null_values=[""],
            true_values=["True"],
            false_values=["False"],
            strings_can_be_null=False,
        ),
    )
    remove_leftovers(folder, PARQUET)
    with whole_file(folder / PARQUET) as partial:
        parquet.write_table(table.combine_chunks(), partial)


def _kind(parameter: Parameter) -> str:
    if isinstance(parameter, Scalar):
        return "int" if parameter.whole else "float"
    if isinstance(parameter, Integer):
        return "int"
    if isinstance(parameter, Binary):
        return "bool"
    kinds = {type(option).__name__ for option in parameter.options}
    return kinds.pop() if len(kinds) == 1 else "float" if kinds == {"int", "float"} else "str"
