"""The manifest of samples in Parquet: the rows of the CSV, with types."""

import csv
from typing import Annotated, Literal

import pytest

from shapewright import Infeasible, Range, procedure
from shapewright.fitting.samples import write_samples
from shapewright.fitting.sampling import parquet
from shapewright.fitting.sampling.merging import merge
from shapewright.fitting.sampling.shards import Shard
from shapewright.modelling.solids import box
from shapewright.runs.folder import RunError

tables = pytest.importorskip("pyarrow.parquet", reason="needs the extra scale; run `make test-adapters`")


@procedure
def stool(
    height: Annotated[float, Range(0.3, 0.8)] = 0.5,
    teeth: Annotated[int, Range(3, 900)] = 30,
    legs: Annotated[int, Range(1, 4)] = 4,
    round_top: bool = False,
    kind: Literal["1", "2", ""] = "1",
    size: Literal[1, 2.5] = 1,
):
    if legs == 2:
        raise Infeasible('it "falls",\nover')
    return box((1, height, 1))


def test_rows_are_those_of_the_csv_and_have_types(tmp_path):
    write_samples(stool, 30, tmp_path / "out", workers=1, parquet=True)
    table = tables.read_table(tmp_path / "out" / "manifest.parquet")
    with (tmp_path / "out" / "manifest.csv").open(newline="") as file:
        listed = list(csv.DictReader(file))
    vectors = stool.space.sample(30, seed=0)
    for row, text, vector in zip(table.to_pylist(), listed, vectors, strict=True):
        assert {name: row[name] for name in vector} == vector
        assert [type(row[name]) for name in vector] == [float, int, int, bool, str, float]
        assert row["path"] == text["path"] and row["failure"] == text["failure"].replace("\r\n", "\n")
        assert row["triangles"] == (12 if row["path"] else None) and row["sound"] is (True if row["path"] else None)
    assert any("\n" in row["failure"] for row in table.to_pylist())


def test_joined_shards_have_the_same_table_to_the_bit(tmp_path):
    write_samples(stool, 5, tmp_path / "all", workers=1, parquet=True)
    folders = [tmp_path / str(k) for k in range(1, 8)]
    for k, folder in enumerate(folders, 1):
        write_samples(stool, 5, folder, workers=1, parquet=True, shard=Shard(k, 7))
    merge(folders, tmp_path / "joined")
    assert (tmp_path / "joined" / "manifest.parquet").read_bytes() == (
        tmp_path / "all" / "manifest.parquet"
    ).read_bytes()


def test_the_table_grows_with_its_folder(tmp_path):
    write_samples(stool, 2, tmp_path / "out", workers=1, parquet=True)
    write_samples(stool, 4, tmp_path / "out", workers=1)
    assert tables.read_table(tmp_path / "out" / "manifest.parquet").num_rows == 4


def test_without_pyarrow_nothing_is_begun(tmp_path, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(RunError, match=r"needs pyarrow: pip install 'shapewright\[scale\]'"):
        write_samples(stool, 4, tmp_path / "out", workers=1, parquet=True)
    assert not (tmp_path / "out").exists() and parquet.PARQUET == "manifest.parquet"
