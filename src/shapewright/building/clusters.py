"""Clusters by their names on the command line: ``dask:ADDRESS`` and ``dask:local:N``."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass

from shapewright.building.executors import Cluster, ExecutorError

_PATIENCE = 30.0
"""Seconds in which a scheduler has to answer."""


@dataclass(frozen=True)
class ClusterName:
    """The name of a cluster, taken apart.

    address: of a dask scheduler, as ``tcp://10.0.0.7:8786``; None for a cluster of this machine.
    count: processes of a cluster of this machine.
    """

    address: str | None
    count: int = 0

    @classmethod
    def parse(cls, text: str) -> ClusterName:
        """Raises ValueError when it names none."""
        kind, _, rest = text.partition(":")
        if kind == "dask" and rest.startswith("local:"):
            count = rest.removeprefix("local:")
            if count.isdecimal() and int(count) > 0:
                return cls(None, int(count))
        elif kind == "dask" and rest and rest != "local":
            return cls(rest)
        raise ValueError(f"{text!r} is no cluster: write dask:ADDRESS of a scheduler, or dask:local:N for N processes")


def where(name: ClusterName | None) -> AbstractContextManager[Cluster | None]:
    """The cluster of that name, ``opened``; None for this machine."""
    return opened(name) if name else nullcontext()


@contextmanager
def opened(name: ClusterName) -> Iterator[Cluster]:
    """A cluster, to be used in the block. One of this machine is started, and ends with it.

    Raises ExecutorError when dask is not installed, or no scheduler with workers is there.
    """
    try:
        from distributed import Client, LocalCluster
    except ImportError:
        raise ExecutorError("a dask cluster needs dask: pip install 'shapewright[dask]'") from None
    with ExitStack() as stack:
        if name.address is None:
            local = LocalCluster(
                n_workers=name.count, threads_per_worker=1, dashboard_address=":0", silence_logs=logging.CRITICAL
            )
            client = stack.enter_context(Client(stack.enter_context(local)))
        else:
            try:
                client = stack.enter_context(Client(name.address, timeout=_PATIENCE))
                client.wait_for_workers(1, timeout=_PATIENCE)
            except (OSError, ValueError) as error:
                raise ExecutorError(
                    f"dask:{name.address}: no scheduler with workers answers there within {_PATIENCE:g} s ({error}); "
                    "start one with: dask scheduler, and on each machine: dask worker ADDRESS"
                ) from error
        yield Cluster(client.get_executor(pure=False), sum(client.nthreads().values()))
