"""A disk that fills up while something is written, and a process that is killed while it writes."""

import os
import resource
import signal
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def full_after(size):
    """No file can become larger than ``size`` bytes: writing more raises OSError (EFBIG)."""
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (size, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
        signal.signal(signal.SIGXFSZ, before)


def killed(write):
    """Call ``write`` in a process of its own that is killed (SIGKILL) when it is about to rename what it wrote."""
    child = os.fork()
    if not child:
        Path.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)
        try:
            write()
        finally:
            os._exit(0)
    assert os.WTERMSIG(os.waitpid(child, 0)[1]) == signal.SIGKILL


def shown(folder):
    """Every file below a folder that is not hidden, and what it holds."""
    found = {path.relative_to(folder): path for path in folder.rglob("*") if path.is_file()}
    return {str(place): path.read_bytes() for place, path in found.items() if not _is_hidden(place)}


def hidden(folder):
    """Names of all hidden files and folders in a folder."""
    return sorted(path.name for path in folder.rglob(".*"))


def _is_hidden(place):
    return any(part.startswith(".") for part in place.parts)
