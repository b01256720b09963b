"""References, read in processes that a file may take down with it; small files of plain formats in this one.

What a stranger sends may hang a decoder, fill the memory or break a library written in C. Then only that file is lost.
A process takes a quarter of a second to start, which a folder of a few small meshes should not wait for. So files that
Python and numpy alone read are read here, as long as they are small.
"""

from __future__ import annotations

from collections.abc import Sequence

from shapewright.processes import Limits, Loss
from shapewright.processes.calls import Calls
from shapewright.references.errors import UnreadableError
from shapewright.references.reference import Reference, read_reference
from shapewright.references.sources import Source
from shapewright.threads import cores

_PLAIN = frozenset([".obj", ".off", ".ply", ".stl", ".xyz", ".xyzn", ".xyzrgb", ".pts"])
"""Formats whose readers use Python and numpy, and no other library but manifold3d to cut polygons: the memory and the
time that they take are in proportion to the file."""
_SMALL, _IN_ALL = 2 * 2**20, 16 * 2**20
"""Bytes of a plain file that is read here, and of all that are. Text takes .1 s of CPU a megabyte."""
_SECONDS, _MORE, _MOST = 20.0, 5.0, 60.0
"""That a file may take, what it may take more for each megabyte, and at most. The first of all compiles kernels, which
takes 6 s of CPU; no other small file took 5 (benchmarks/fuzzing.py). The largest text that fits in the memory, 1.5 GB
of STL, takes 50."""
_MEMORY, _TIMES = 1024, 12
"""Megabytes that a file may take, and times its size besides. A million triangles take 200 to 560 MB, at most 11 times
the size of their file."""
_FILES, _BYTES = 32, 4 * 2**20
"""Files and bytes for which a further process is worth its start."""


class Readers:
    """Reads references; a context manager, which keeps its processes until its end.

    count: processes at most; one a core by default. The references do not depend on it.
    """

    def __init__(self, count: int | None = None) -> None:
        self._count = count or cores()
        self._calls = Calls(attempt, self._count)

    def __enter__(self) -> Readers:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """End the processes."""
        self._calls.close()

    def read(self, sources: Sequence[Source]) -> list[Reference | UnreadableError]:
        """The reference of each source, or the reason why there is none."""
        results: dict[int, Reference | UnreadableError] = {}
        away: list[tuple[int, int]] = []
        here = 0
        for number, source in enumerate(sources):
            size = _size(source)
            if size == 0 or (source.path.suffix.lower() in _PLAIN and size <= _SMALL and here + size <= _IN_ALL):
                results[number] = attempt(source)
                here += size
            else:
                away.append((number, size))
        calls = [(sources[number], _limits(size)) for number, size in away]
        most = 1 + len(away) // _FILES + sum(size for _, size in away) // _BYTES
        answers = self._calls.results(calls, most)
        for (number, _), (_, limits), answer in zip(away, calls, answers, strict=True):
            results[number] = UnreadableError(_reason(answer, limits)) if isinstance(answer, Loss) else answer
        return [results[number] for number in range(len(sources))]


def attempt(source: Source) -> Reference | UnreadableError:
    """The reference of a source, or the reason why there is none; raises MemoryError."""
    try:
        return read_reference(source)
    except UnreadableError as error:
        return UnreadableError(str(error))
    except MemoryError:
        raise
    except Exception as error:  # noqa: BLE001 - a shape at the ends of what numbers hold can make anything fail
        return UnreadableError(f"broken: {type(error).__name__}: {error}")


def _size(source: Source) -> int:
    """Of a file, in bytes; 0 where there is nothing to read."""
    try:
        return 0 if source.refusal else source.path.stat().st_size
    except OSError:
        return 0


def _limits(size: int) -> Limits:
    return Limits(min(_SECONDS + _MORE * (size // 2**20), _MOST), _MEMORY + _TIMES * size // 2**20)


def _reason(loss: Loss, limits: Limits) -> str:
    match loss.kind:
        case "time":
            return f"reading it took more than {limits.seconds:g} s"
        case "memory":
            return f"reading it needs more than {limits.memory_mb / 1024:.3g} GB of memory"
        case "crash":
            return f"reading {loss.message}; export it again, or in another format"
