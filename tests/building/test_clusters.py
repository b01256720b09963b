"""Clusters by name."""

import sys

import pytest

from shapewright.building import ExecutorError
from shapewright.building.clusters import ClusterName, opened


def test_names_say_what_is_meant():
    assert ClusterName.parse("dask:local:3") == ClusterName("dask", count=3)
    assert ClusterName.parse("dask:tcp://10.0.0.7:8786") == ClusterName("dask", "tcp://10.0.0.7:8786")
    assert ClusterName.parse("dask:10.0.0.7:8786") == ClusterName("dask", "10.0.0.7:8786")


@pytest.mark.parametrize(
    "text", ["", "dask", "dask:", "dask:local", "dask:local:", "dask:local:0", "dask:local:x", "ray"]
)
def test_what_names_no_cluster_is_refused(text):
    with pytest.raises(ValueError, match="is no cluster: write dask:ADDRESS of a scheduler, dask:local:N"):
        ClusterName.parse(text)


def test_without_dask_it_is_told_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(ExecutorError, match=r"needs dask: pip install 'shapewright\[dask\]'"),
        opened(ClusterName.parse("dask:local:2")),
    ):
        pass


def test_slurm_is_told_of_its_jobs():
    assert ClusterName.parse("slurm:local:3") == ClusterName("slurm", count=3)
    plain = ClusterName.parse("slurm:")
    assert plain.count == 100 and plain.jobs == {"timeout_min": 60, "slurm_array_parallelism": 100}
    asked = ClusterName.parse("slurm:partition=cpu,array=20,time=30,memory=4,account=lab")
    assert asked.count == asked.jobs["slurm_array_parallelism"] == 20
    assert (asked.jobs["slurm_partition"], asked.jobs["slurm_account"]) == ("cpu", "lab")
    assert (asked.jobs["timeout_min"], asked.jobs["mem_gb"]) == (30, 4)


@pytest.mark.parametrize("said", ["queue=cpu", "array=0", "array=many", "partition="])
def test_what_slurm_does_not_know_is_told(said):
    with pytest.raises(ValueError, match=f"{said!r} says nothing of a job: there are array, partition"):
        ClusterName.parse(f"slurm:{said}")
