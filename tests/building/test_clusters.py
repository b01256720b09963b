"""Clusters by name."""

import sys

import pytest

from shapewright.building import ExecutorError
from shapewright.building.clusters import ClusterName, opened


def test_names_say_what_is_meant():
    assert ClusterName.parse("dask:local:3") == ClusterName(None, 3)
    assert ClusterName.parse("dask:tcp://10.0.0.7:8786") == ClusterName("tcp://10.0.0.7:8786")
    assert ClusterName.parse("dask:10.0.0.7:8786") == ClusterName("10.0.0.7:8786")


@pytest.mark.parametrize(
    "text", ["", "dask", "dask:", "dask:local", "dask:local:", "dask:local:0", "dask:local:x", "ray"]
)
def test_what_names_no_cluster_is_refused(text):
    with pytest.raises(ValueError, match="is no cluster: write dask:ADDRESS of a scheduler, or dask:local:N"):
        ClusterName.parse(text)


def test_without_dask_it_is_told_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(ExecutorError, match=r"needs dask: pip install 'shapewright\[dask\]'"),
        opened(ClusterName.parse("dask:local:2")),
    ):
        pass
