"""Shards of samples: all of them together are to the bit the samples that one command writes."""

import itertools
import json
import tarfile
from dataclasses import replace

import pytest

from shapewright import load_procedure
from shapewright.fitting.samples import write_samples
from shapewright.fitting.sampling import merging, packing
from shapewright.fitting.sampling.merging import merge
from shapewright.fitting.sampling.shards import Shard
from shapewright.runs.folder import RunError

SOURCE = """
from typing import Annotated
from shapewright import Infeasible, Range, procedure
from shapewright.modelling.solids import box

@procedure
def stool(height: Annotated[float, Range(0.3, 0.8)] = 0.5, legs: Annotated[int, Range(1, 4)] = 4):
    if legs == 2:
        raise Infeasible("it falls\\nover")
    seat = box((0.5, 0.1, 0.5), at=(0, height, 0)).label("seat")
    return seat | box((0.1, height, 0.1), at=(-0.1, height / 2, 0)).label("legs").array(legs, (0.05, 0, 0))
"""


@pytest.fixture
def stool(tmp_path):
    (tmp_path / "stool.py").write_text(SOURCE)
    return load_procedure(tmp_path / "stool.py")


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def shards_of(procedure, folder, count, of, *arguments, **more):
    folders = [folder / str(number) for number in range(1, of + 1)]
    for number, place in enumerate(folders, 1):
        write_samples(procedure, count, place, *arguments, workers=1, shard=Shard(number, of), **more)
    return folders


@pytest.mark.parametrize("of", [1, 2, 3, 7, 40])
@pytest.mark.parametrize("count", [0, 1, 12, 1000])
def test_shards_have_each_sample_once_and_in_order(count, of):
    parts = [Shard(number, of).part(count) for number in range(1, of + 1)]
    assert list(itertools.chain(*parts)) == list(range(count))
    assert max(map(len, parts)) - min(map(len, parts)) <= 1


@pytest.mark.parametrize("text", ["0/3", "4/3", "1/0", "1", "a/b", "-1/3", "1/2/3"])
def test_what_is_no_shard_is_refused(text):
    with pytest.raises(ValueError, match="shard"):
        Shard.parse(text)
    assert str(Shard.parse(" 17/200 ")) == "17/200"


def test_shards_joined_are_what_one_command_writes_whatever_their_number(stool, tmp_path):
    write_samples(stool, 11, tmp_path / "all", workers=1, seed=3)
    for of in (1, 4):
        folders = shards_of(stool, tmp_path / f"of-{of}", 11, of, seed=3)
        before = [contents(folder) for folder in folders]
        assert merge(folders[::-1], tmp_path / f"joined-{of}") == 11
        assert contents(tmp_path / f"joined-{of}") == contents(tmp_path / "all")
        assert [contents(folder) for folder in folders] == before
    write_samples(stool, 12, tmp_path / "joined-4", workers=1, seed=3)  # it is a folder of samples as any other
    write_samples(stool, 12, tmp_path / "all", workers=1, seed=3)
    assert contents(tmp_path / "joined-4") == contents(tmp_path / "all")


def test_a_disk_without_links_gets_copies(stool, tmp_path, monkeypatch):
    folders = shards_of(stool, tmp_path / "shards", 4, 2)

    def refused(*_):
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(merging.os, "link", refused)
    merge(folders, tmp_path / "joined")
    write_samples(stool, 4, tmp_path / "all", workers=1)
    assert contents(tmp_path / "joined") == contents(tmp_path / "all")


def test_samples_of_tars_are_as_web_dataset_reads_them(stool, tmp_path, monkeypatch):
    monkeypatch.setattr(packing, "TARS", replace(packing.TARS, size=5))
    write_samples(stool, 12, tmp_path / "tars", "wds", workers=1)
    write_samples(stool, 12, tmp_path / "files", "glb", workers=1)
    found = {}
    for tar in sorted((tmp_path / "tars").glob("*.tar")):
        with tarfile.open(tar) as archive:
            members = archive.getmembers()
            for shape, about in zip(members[::2], members[1::2], strict=True):
                stem, _, extension = shape.name.partition(".")
                assert about.name == f"{stem}.json" and shape.mtime == 0
                assert archive.extractfile(shape).read() == (tmp_path / "files" / shape.name).read_bytes()
                found[f"{tar.name}/{stem}.{extension}"] = json.load(archive.extractfile(about))
    lines = (tmp_path / "tars" / "manifest.csv").read_text(), (tmp_path / "files" / "manifest.csv").read_text()
    assert len(found) == sum("stool-" in line for line in lines[1].splitlines()) > 5
    assert all(path in lines[0] for path in found)
    vectors = stool.space.sample(12, seed=0)
    for path, about in found.items():
        assert about["parameters"] == vectors[int(path[-9:-4])] and about["sound"] is True and about["seed"] == 0
    assert {path.name for path in (tmp_path / "tars").glob("*.tar")} == {f"stool-0000{i}.tar" for i in range(3)}


def test_tars_that_shards_cut_through_are_joined_to_the_bit(stool, tmp_path, monkeypatch):
    monkeypatch.setattr(packing, "TARS", replace(packing.TARS, size=5))
    write_samples(stool, 13, tmp_path / "all", "wds", workers=1)
    merge(shards_of(stool, tmp_path / "shards", 13, 5, "wds"), tmp_path / "joined")
    assert contents(tmp_path / "joined") == contents(tmp_path / "all")


def test_tars_are_gone_on_with_where_they_were_stopped(stool, tmp_path, monkeypatch):
    monkeypatch.setattr(packing, "TARS", replace(packing.TARS, size=4))

    def stop(done, total):
        if done > 6:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_samples(stool, 11, tmp_path / "out", "wds", workers=1, progress=stop)
    write_samples(stool, 11, tmp_path / "out", "wds", workers=1)
    write_samples(stool, 14, tmp_path / "out", "wds", workers=1)
    write_samples(stool, 14, tmp_path / "all", "wds", workers=1)
    assert contents(tmp_path / "out") == contents(tmp_path / "all")


def test_a_shard_is_gone_on_with_and_is_not_mixed_with_others(stool, tmp_path):
    def stop(done, total):
        raise KeyboardInterrupt

    (folder,) = shards_of(stool, tmp_path / "whole", 12, 1)
    with pytest.raises(KeyboardInterrupt):
        write_samples(stool, 12, tmp_path / "out", workers=1, shard=Shard(1, 1), progress=stop)
    write_samples(stool, 12, tmp_path / "out", workers=1, shard=Shard(1, 1))
    assert contents(tmp_path / "out") == contents(folder)
    kinds = (12, Shard(1, 2), "shard, rows"), (13, Shard(1, 1), "count, rows"), (12, None, "shard")
    for count, shard, other in kinds:
        with pytest.raises(RunError, match=f"samples of another kind here .other {other}"):
            write_samples(stool, count, tmp_path / "out", workers=1, shard=shard)


def test_more_shards_than_samples_are_joined_as_well(stool, tmp_path):
    folders = shards_of(stool, tmp_path / "shards", 2, 4)
    assert merge(folders, tmp_path / "joined") == 2
    write_samples(stool, 2, tmp_path / "all", workers=1)
    assert contents(tmp_path / "joined") == contents(tmp_path / "all")


def test_listed_parameters_may_be_cut_into_shards(stool, tmp_path):
    given = {"low": {"height": 0.3, "legs": 3}, "high": {"height": 0.8, "legs": 4}, "mid": {"height": 0.5, "legs": 1}}
    merge(shards_of(stool, tmp_path / "shards", 3, 2, given=given), tmp_path / "joined")
    write_samples(stool, 3, tmp_path / "all", workers=1, given=given)
    assert contents(tmp_path / "joined") == contents(tmp_path / "all")
    assert (tmp_path / "all" / "mid.glb").exists()


def test_shards_that_do_not_belong_together_are_named(stool, tmp_path):
    one, two, three = shards_of(stool, tmp_path / "shards", 6, 3)
    (other,) = shards_of(stool, tmp_path / "other", 6, 3, seed=1)[1:2]
    write_samples(stool, 6, tmp_path / "all", workers=1)
    (tmp_path / "stool.py").write_text(SOURCE.replace("0.1", "0.2"))
    edited = shards_of(load_procedure(tmp_path / "stool.py"), tmp_path / "edited", 6, 3)[1]
    for folders, message in (
        ([one, three], r"1 of 3 shards are missing: 2/3"),
        ([two], r"2 of 3 shards are missing: 1/3, 3/3"),
        ([one, two, two, three], r"shards/2: shard 2/3 is there twice"),
        ([one, other, three], r"other/2: its samples are not those of .*shards/1 \(seed: 1, not 0\)"),
        ([one, edited, three], r"edited/2: its samples are not those of .*shards/1 \(source: "),
        ([one, tmp_path / "all"], "all: it holds all samples of its command"),
        ([one, tmp_path], r"no samples here: it holds no manifest\.samples\.json"),
        ([], "no shards are named"),
    ):
        with pytest.raises(RunError, match=message):
            merge(folders, tmp_path / "joined")
        assert not (tmp_path / "joined").exists()
    with pytest.raises(RunError, match="there is something here already"):
        merge([one, two, three], tmp_path / "all")


def test_a_shard_that_is_not_finished_or_lost_a_file_is_named(stool, tmp_path):
    one, two = shards_of(stool, tmp_path / "shards", 8, 2)
    lines = (two / "manifest.csv").read_text().splitlines(keepends=True)
    (two / "manifest.csv").write_text("".join(lines[:2]))
    with pytest.raises(RunError, match=r"shards/2: shard 2/2 is not finished: 1 of 4 .*repeat its command"):
        merge([one, two], tmp_path / "joined")
    write_samples(stool, 8, two, workers=1, shard=Shard(2, 2))
    lost = next(one.glob("*.glb"))
    lost.unlink()
    with pytest.raises(RunError, match=rf"{lost.name}: no such file, though manifest.csv lists it"):
        merge([one, two], tmp_path / "joined")
    assert not (tmp_path / "joined").exists()
