"""Runs of thousands of references: a table and tars, which other programs read as they are."""

import json
import tarfile

import numpy as np
import pytest

import shapewright as sw
from shapewright.runs import packed, table
from shapewright.runs.changes import compare
from shapewright.runs.folder import RunError, read_record
from shapewright.runs.iteration import Iteration
from shapewright.studio.project.stores.picture_store import Pictures

pytest.importorskip("pyarrow", reason="the extra scale is not installed")

STOOL = """
from typing import Annotated, Literal
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box, cylinder

@procedure
def stool(
    height: Annotated[float, Range(0.3, 1.0)] = 0.6,
    seat: Literal["square", "round"] = "square",
    legs: Annotated[int, Range(1, 3)] = 1,
    taper: Literal[1, 0.5, "none"] = 1,
    bar: bool = False,
):
    top = (cylinder if seat == "round" else box)((1, 0.1, 1), at=(0, height, 0))
    return top | box((0.15, height, 0.15), at=(0, height / 2, 0)).array(legs, (0.2, 0, 0))
"""
SETTINGS = sw.Settings(seed=1, samples=80, epochs=1, image_size=32, workers=1, refine_shapes=10)


@pytest.fixture(scope="module")
def iteration(tmp_path_factory):
    file = tmp_path_factory.mktemp("stool") / "stool.py"
    file.write_text(STOOL)
    stool = sw.load_procedure(file)
    shapes = {f"stool {i}": stool(height=0.4 + 0.05 * i, legs=1 + i % 3) for i in range(7)}
    shapes["line"] = sw.Mesh([(0, 0, 0), (1, 0, 0), (0.5, 1e-9, 0)], [(0, 1, 2)])
    shapes["twin"] = shapes["stool 3"]
    return sw.fit(stool, sw.Collection.of(shapes), SETTINGS, chunk=3)


@pytest.fixture
def small(iteration, tmp_path):
    """The run in the form of before, a file for each shape."""
    return iteration.save(tmp_path / "small")


@pytest.fixture
def large(iteration, tmp_path, monkeypatch):
    monkeypatch.setattr(table, "LARGE", 3)
    monkeypatch.setattr(table, "ROWS", 4)
    return iteration.save(tmp_path / "large")


def plain(record):
    return json.loads(json.dumps({**record, "references": list(record["references"]), "format": 0}))


def test_it_holds_a_few_files(large, iteration):
    names = {path.name for path in large.iterdir()}
    assert names >= {"iteration.json", "references.parquet", "files.parquet", "replicas.tar", "thumbnails.tar"}
    assert not names & {"replicas", "thumbnails", "parameters.json"}
    assert "references" not in json.loads((large / "iteration.json").read_text())


def test_it_says_what_the_small_form_says(small, large):
    assert plain(read_record(large)) == plain(read_record(small))
    assert len(read_record(large)["references"]) == 9
    assert read_record(large)["references"][-1]["name"] == read_record(small)["references"][-1]["name"]


def test_it_is_loaded_as_the_small_form_is(small, large):
    one, other = Iteration.load(small), Iteration.load(large)
    assert other.names == one.names and other.replicated == one.replicated and other.groups == one.groups
    assert plain(other.record) == plain(one.record) and other.means == pytest.approx(one.means, nan_ok=True)
    for result in one:
        twin = other[result.name]
        assert twin.measures == pytest.approx(result.measures, nan_ok=True)
        assert twin.parameters == result.parameters and twin.missing == result.missing
        assert dict(other.pictures)[result.name] == one.pictures[result.name]
        if result.replica is None:
            assert twin.replica is None
        else:
            assert np.array_equal(twin.replica.vertices, result.replica.vertices)
            assert twin.replica.labels == result.replica.labels


def test_replicas_are_read_when_they_are_asked_for(large):
    loaded = Iteration.load(large)
    (large / "replicas.tar").rename(large / "elsewhere.tar")
    assert loaded["stool 1"].grade
    with pytest.raises(FileNotFoundError):
        _ = loaded["stool 1"].replica


def test_it_is_saved_again_from_disk(large, iteration, tmp_path):
    again = Iteration.load(large).save(tmp_path / "again")
    unknown = {"triangles": None}  # of references whose shapes are not there
    records = [plain(read_record(run)) for run in (again, large)]
    assert [{**each, **unknown} for each in records[0]["references"]] == [
        {**each, **unknown} for each in records[1]["references"]
    ]
    for name in ("replicas.tar", "thumbnails.tar"):
        assert (again / name).read_bytes() == (large / name).read_bytes()


def test_other_programs_unpack_it(small, large, tmp_path):
    with tarfile.open(large / "replicas.tar") as tar:
        tar.extractall(tmp_path / "out", filter="data")
    written = {path.name: path.read_bytes() for path in (small / "replicas").iterdir()}
    assert {path.name: path.read_bytes() for path in (tmp_path / "out" / "replicas").iterdir()} == written


def test_duckdb_and_polars_read_it_as_it_is(large):
    duckdb = pytest.importorskip("duckdb", reason="only tests need it")
    polars = pytest.importorskip("polars", reason="only tests need it")
    found = duckdb.sql(
        f"select name, parameters.legs, fidelity from '{large}/references.parquet' where parameters.legs = 3"
    )
    frame = polars.read_parquet(large / "references.parquet").unnest("parameters")
    assert len(found.fetchall()) == frame.filter(polars.col("legs") == 3).height
    assert frame["seat"].dtype == polars.String and frame["height"].dtype == polars.Float64
    index = duckdb.sql(f"select tar, count(*) from '{large}/files.parquet' group by tar order by tar").fetchall()
    assert [tar for tar, _ in index] == ["replicas.tar", "thumbnails.tar"]


def test_an_old_run_of_many_references_is_read(iteration, tmp_path, monkeypatch):
    monkeypatch.setattr(table, "is_large", lambda count: False)
    run = iteration.save(tmp_path / "old")
    monkeypatch.setattr(table, "LARGE", 3)
    assert read_record(run)["format"] == 1 and Iteration.load(run).names == iteration.names


def test_it_is_compared_and_resumed_as_any_other(large, small, iteration):
    changes = compare(large, small)
    assert not (changes.gained or changes.lost or changes.closer or changes.further)
    stool = sw.load_procedure(iteration.procedure["path"])
    shapes = sw.Collection.of({"stool 0": stool(height=0.4)})
    settings = sw.Settings(seed=1, samples=40, warm_samples=20, epochs=1, warm_epochs=1, image_size=32, refine_shapes=4)
    before = [sw.fit(stool, shapes, settings, previous=Iteration.load(run)) for run in (small, large)]
    assert before[0]["stool 0"].parameters == before[1]["stool 0"].parameters


def test_the_studio_finds_its_pictures(large, tmp_path):
    pictures = Pictures(tmp_path)
    address = pictures.add_file(large / "thumbnails" / "stool-1.replica.png")
    digest = address.rpartition("/")[2].removesuffix(".png")
    assert pictures.read(digest) == packed.read(large, "thumbnails/stool-1.replica.png")
    assert pictures.add_file(large / "thumbnails" / "nobody.replica.png") is None
    assert Pictures(tmp_path / "another").add_file(large / "thumbnails" / "stool-1.replica.png") is None


def test_a_damaged_table_is_told(large):
    (large / "references.parquet").write_bytes(b"PAR1 and nothing else")
    with pytest.raises(RunError, match=r"references.parquet: cannot be read"):
        read_record(large)
