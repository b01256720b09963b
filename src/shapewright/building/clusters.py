"""Clusters by their names on the command line: ``dask:ADDRESS``, ``dask:local:N``, ``slurm:partition=P,array=N``."""

from __future__ import annotations

import logging
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass, field
from pathlib import Path

from shapewright.building.executors import Cluster, ExecutorError

_PATIENCE = 30.0
"""Seconds in which a scheduler has to answer."""
_ARRAY = 100
"""Jobs of SLURM at the same time, where nobody says how many."""
_HOUR = 60
"""Minutes that a job may take, where nobody says it: it builds 2,000 shapes at most."""
_SLURM = {
    "array": "slurm_array_parallelism",
    "partition": "slurm_partition",
    "account": "slurm_account",
    "qos": "slurm_qos",
    "constraint": "slurm_constraint",
    "time": "timeout_min",
    "memory": "mem_gb",
}
"""What may be said of SLURM's jobs, and submitit's word for it; time in minutes, memory in GB."""
_NUMBERS = ("array", "time", "memory")
_KINDS = (
    "write dask:ADDRESS of a scheduler, dask:local:N for N processes, slurm:partition=P,array=N for N jobs at a time, "
    "or slurm:local:N to try that here"
)


@dataclass(frozen=True)
class ClusterName:
    """The name of a cluster, taken apart.

    kind: "dask" or "slurm".
    address: of a dask scheduler, as ``tcp://10.0.0.7:8786``; None for another cluster.
    count: processes of a cluster of this machine, or jobs at the same time.
    jobs: what is said of SLURM's jobs, in submitit's words; None for processes of this machine.
    """

    kind: str
    address: str | None = None
    count: int = 0
    jobs: Mapping[str, str | int] | None = field(default=None)

    @classmethod
    def parse(cls, text: str) -> ClusterName:
        """Raises ValueError when it names none."""
        kind, _, rest = text.partition(":")
        if kind in ("dask", "slurm") and rest.startswith("local:"):
            count = rest.removeprefix("local:")
            if count.isdecimal() and int(count) > 0:
                return cls(kind, count=int(count))
        elif kind == "dask" and rest and rest != "local":
            return cls(kind, rest)
        elif kind == "slurm" and rest != "local":
            return cls._of_jobs(text, rest)
        raise ValueError(f"{text!r} is no cluster: {_KINDS}")

    @classmethod
    def _of_jobs(cls, text: str, rest: str) -> ClusterName:
        jobs: dict[str, str | int] = {"timeout_min": _HOUR, "slurm_array_parallelism": _ARRAY}
        for said in rest.split(",") if rest else ():
            name, _, value = (part.strip() for part in said.partition("="))
            whole = value.isdecimal() and int(value) > 0
            if name not in _SLURM or not value or (name in _NUMBERS and not whole):
                raise ValueError(
                    f"{text!r}: {said!r} says nothing of a job: there are {', '.join(_SLURM)}, as in array=50"
                )
            jobs[_SLURM[name]] = int(value) if name in _NUMBERS else value
        return cls("slurm", count=int(jobs["slurm_array_parallelism"]), jobs=jobs)


def where(name: ClusterName | None) -> AbstractContextManager[Cluster | None]:
    """The cluster of that name, ``opened``; None for this machine."""
    return opened(name) if name else nullcontext()


@contextmanager
def opened(name: ClusterName) -> Iterator[Cluster]:
    """A cluster, to be used in the block. One of this machine is started, and ends with it.

    Raises ExecutorError when its library is not installed, or nobody answers.
    """
    opening: Callable[[ClusterName], AbstractContextManager[Cluster]] = _dask if name.kind == "dask" else _slurm
    with opening(name) as cluster:
        yield cluster


@contextmanager
def _dask(name: ClusterName) -> Iterator[Cluster]:
    try:
        import dask
        from distributed import Client, LocalCluster
    except ImportError:
        raise ExecutorError("a dask cluster needs dask: pip install 'shapewright[dask]'") from None
    with ExitStack() as stack:
        # A chunk of references of many triangles is large, and meant to be.
        stack.enter_context(dask.config.set({"distributed.admin.large-graph-warning-threshold": "1 GB"}))
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


@contextmanager
def _slurm(name: ClusterName) -> Iterator[Cluster]:
    """Jobs leave their files in the working folder, which all machines have to see, until the end."""
    try:
        import submitit
    except ImportError:
        raise ExecutorError("SLURM needs submitit: pip install 'shapewright[slurm]'") from None
    with tempfile.TemporaryDirectory(prefix=".shapewright-jobs-", dir=Path.cwd(), ignore_cleanup_errors=True) as folder:
        try:
            executor = submitit.AutoExecutor(folder, cluster="slurm" if name.jobs else "local")
        except RuntimeError as error:
            raise ExecutorError(f"slurm: {error}; run the command where sbatch is") from error
        executor.update_parameters(**(name.jobs or {"timeout_min": _HOUR}), name="shapewright", cpus_per_task=1)
        yield Cluster(executor, name.count)
