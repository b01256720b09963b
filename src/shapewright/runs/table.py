"""The references of a large run as a Parquet file: a row for each, which DuckDB and polars read as it is.

``parameters`` is a column of structs: ``select parameters.height from 'references.parquet'``.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import Any

from shapewright.judging.target import Measures
from shapewright.runs.lazy import Lazy

TABLE = "references.parquet"
LARGE = 2000
"""References above which a run has a table and tars in place of thousands of files, where pyarrow is installed."""
ROWS = 1000
"""Of the table that are in memory at the same time."""
Entry = Mapping[str, Any]


def is_large(count: int) -> bool:
    """Whether a run of so many references is written as a large one."""
    return count > LARGE and find_spec("pyarrow") is not None


def write(run: Path, entries: Iterable[Entry], parameters: Sequence[Mapping[str, Any]]) -> None:
    """Write the entries of a run's record, some at a time. parameters: the procedure's, as the record has them."""
    from pyarrow import Table, parquet

    rows, schema, texts = iter(entries), _schema(parameters), _as_text(parameters)
    with parquet.ParquetWriter(run / TABLE, schema) as writer:
        while some := list(islice(rows, ROWS)):
            plain = [{"places": None, **entry, "parameters": _written(entry["parameters"], texts)} for entry in some]
            writer.write_table(Table.from_pylist(plain, schema))


def entries(run: Path, parameters: Sequence[Mapping[str, Any]]) -> Sequence[dict[str, Any]]:
    """The entries of a large run, each read when it is asked for, with the thousand that it is among.

    Raises OSError, and pyarrow's errors for a damaged table.
    """
    from pyarrow import parquet

    path = run / TABLE
    texts = _as_text(parameters)
    with parquet.ParquetFile(path) as file:
        ends = [0]
        for number in range(file.num_row_groups):
            ends.append(ends[-1] + file.metadata.row_group(number).num_rows)

    @lru_cache(maxsize=2)
    def group(number: int) -> list[dict[str, Any]]:
        with parquet.ParquetFile(path) as file:
            return [_entry(row, texts) for row in file.read_row_group(number).to_pylist()]

    def entry(place: int) -> dict[str, Any]:
        number = min(place // ROWS, len(ends) - 2)  # all but the last have as many rows
        return group(number)[place - ends[number]]

    return Lazy(ends[-1], entry)


def _schema(parameters: Sequence[Mapping[str, Any]]) -> Any:
    import pyarrow as pa

    number, text, whole, truth = pa.float64(), pa.string(), pa.int64(), pa.bool_()
    of_kind = {"scalar": number, "integer": whole, "binary": truth}
    values = [(p["name"], of_kind.get(p["kind"]) or (text if _is_text(p) else _options(p, pa))) for p in parameters]
    region = pa.struct([("size", number), ("low", pa.list_(number)), ("high", pa.list_(number)), ("share", number)])
    fields = {"name": text, "slug": text, "path": text, "parameters": pa.struct(values)}
    fields |= {"active": pa.list_(text), "at_limit": pa.list_(text)}
    fields |= dict.fromkeys(Measures.words(), number)
    fields |= {"grade": text, "missing": pa.list_(region), "surplus": pa.list_(region)}
    fields |= {"places": pa.list_(pa.list_(number)), "compatible": truth, "group": whole, "error": text}
    fields |= {"replica": text, "triangles": whole, "points": whole, "notes": pa.list_(text), "follows": text}
    return pa.schema(fields)


def _options(parameter: Mapping[str, Any], pa: Any) -> Any:
    return pa.int64() if isinstance(parameter["options"][0], int) else pa.float64()


def _is_text(parameter: Mapping[str, Any]) -> bool:
    """Whether the values of a choice are written as text: words, and what is not all of one kind of number."""
    kinds = {type(option) for option in parameter["options"] or ()}
    return parameter["kind"] == "choice" and kinds not in ({int}, {float})


def _as_text(parameters: Sequence[Mapping[str, Any]]) -> frozenset[str]:
    """Names of choices between values of several kinds: their texts are JSON."""
    mixed = (p for p in parameters if _is_text(p) and {type(option) for option in p["options"]} != {str})
    return frozenset(p["name"] for p in mixed)


def _written(values: Mapping[str, Any] | None, texts: frozenset[str]) -> dict[str, Any] | None:
    if values is None:
        return None
    return {name: json.dumps(value) if name in texts else value for name, value in values.items()}


def _entry(row: dict[str, Any], texts: frozenset[str]) -> dict[str, Any]:
    if (values := row["parameters"]) is not None:
        row["parameters"] = {name: json.loads(value) if name in texts else value for name, value in values.items()}
    if row["places"] is None:
        del row["places"]
    return row
