"""The secrets of a studio, kept for its next start: pages that are open then connect again by themselves."""

from __future__ import annotations

import json
import os
import re
import stat
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from shapewright.studio.project.workspace import SCRATCH, Project
from shapewright.studio.server.security import Access

_FILE = "access.json"
_SECRET = re.compile(r"[\w-]{40,100}")
_FIELDS = ("token", "cookie", "key")


@dataclass(frozen=True)
class Kept:
    """What a studio had before."""

    port: int
    secrets: dict[str, str]

    def access(self, host: str, port: int) -> Access:
        """For a server that listens there."""
        return Access(host, port, **self.secrets)


def kept(project: Project) -> Kept | None:
    """What the last studio of a project kept; None where it kept nothing, or others could have read or written it."""
    flags = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        number = os.open(_place(project), flags)
    except OSError:
        return None
    with os.fdopen(number, encoding="utf-8", errors="replace") as file:
        if not _own(os.fstat(number)):
            return None
        try:
            content: Any = json.loads(file.read(10_000))
            port, secrets = int(content["port"]), {name: str(content[name]) for name in _FIELDS}
        except (OSError, ValueError, KeyError, TypeError, RecursionError, OverflowError):
            return None
    sound = all(_SECRET.fullmatch(secret) for secret in secrets.values()) and len({*secrets.values()}) == len(_FIELDS)
    return Kept(port, secrets) if sound and 0 < port < 2**16 else None


def keep(project: Project, access: Access) -> None:
    """Keep the secrets, readable for this user alone. Raises ProjectError for a folder that is a link."""
    place = project.scratch() / _FILE
    partial = place.with_name(f".{_FILE}.{os.urandom(4).hex()}.partial")
    number = os.open(partial, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600)
    with os.fdopen(number, "w", encoding="utf-8") as file:
        json.dump({"port": access.port, **{name: getattr(access, name) for name in _FIELDS}}, file)
    partial.replace(place)


def forget(project: Project) -> None:
    """Keep them no longer."""
    with suppress(OSError):
        _place(project).unlink()


def _place(project: Project) -> Path:
    return project.folder / SCRATCH / _FILE


def _own(state: os.stat_result) -> bool:
    """Whether a file is this user's own, and closed to others."""
    if not stat.S_ISREG(state.st_mode):
        return False
    return os.name != "posix" or (state.st_uid == os.geteuid() and state.st_mode & 0o077 == 0)
