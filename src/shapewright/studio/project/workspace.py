"""The author's project on disk: one folder with a procedure, references and runs. Nothing outside it is touched."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from shapewright.procedures import BINARY, source_digest, text_of
from shapewright.runs.folder import runs
from shapewright.storage import remove_leftovers, write_file
from shapewright.studio.project.listing import Origin
from shapewright.studio.project.revisions import Revisions
from shapewright.studio.wire.revisions import Writer

SCRATCH = ".shapewright"
"""Folder of a project for what the studio keeps: every version of the procedure that was replaced, exports."""
_REVISIONS, _SETTINGS = "revisions", "settings.json"
TEXTS = frozenset(
    [".py", ".scad", ".json", ".toml", ".yaml", ".yml", ".csv", ".txt", ".md", ".js", ".ts", ".cfg", ".ini"]
)
"""Suffixes of the files that the page's editor opens."""
MOST_TEXT = 2**19
"""Bytes of such a file: half of what a request may have, since JSON takes more room."""
_NEW = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]{0,80}")
_OWN = frozenset(["marks.json"])  # what the studio writes itself
_START = "shapewright new NAME makes one, and shapewright demo one with forty tables"


class ProjectError(Exception):
    """A folder is no project, or a file of it cannot be used; the message says what to do."""


class Missing(KeyError):
    """What was asked for is not there; the message says what."""

    def __str__(self) -> str:
        return str(self.args[0])


class Conflict(Exception):
    """The procedure was changed by someone else meanwhile.

    text: what is there now.
    digest: of that text.
    """

    def __init__(self, text: str, digest: str) -> None:
        super().__init__("the file has changed since; look at it before you write over it")
        self.text, self.digest = text, digest


@dataclass(frozen=True)
class Project:
    """A project on disk."""

    folder: Path  # absolute, links resolved
    procedure: Path  # the author's file, inside it
    origin: Origin  # where the references are
    undo: str = ""  # folder of the undo list, inside that of the procedure's

    @classmethod
    def of(
        cls,
        folder: Path,
        procedure: str = "procedure.py",
        references: str | None = None,
        up: str = "y",
        front: str | None = None,
        keep: tuple[str, ...] = (),
    ) -> Project:
        """The project in a folder. references: another source than its folder ``references``, which may lie anywhere.

        Raises ProjectError for a folder without a procedure.
        """
        home = folder.expanduser().resolve()
        if not home.is_dir():
            raise ProjectError(f"{folder}: no such folder; {_START}")
        path = home / procedure
        if not path.is_file():
            raise ProjectError(f"{folder}: no {procedure} here, so this is no project; {_START}")
        if not path.resolve().is_relative_to(home):
            raise ProjectError(f"{path}: a link that leads out of the project; put the file itself there")
        if references is None:
            (home / "references").mkdir(exist_ok=True)
            origin = Origin(str(home / "references"), up, front, confine=str(home), keep=keep)
        else:
            origin = Origin(str(Path(references).expanduser().absolute()), up, front, keep=keep)
        return cls(home, path, origin)

    @property
    def texts(self) -> list[str]:
        """Names of the text files in the procedure's folder, the procedure first: what the page's editor may open."""
        home = self.procedure.parent
        others = (path.name for path in home.iterdir() if path != self.procedure and self._is_text(path))
        return [self.procedure.name, *sorted(others)]

    def _is_text(self, path: Path) -> bool:
        try:
            inside = path.resolve().is_relative_to(self.folder)
            small = inside and path.is_file() and path.stat().st_size <= MOST_TEXT
        except OSError:
            return False
        return small and path.suffix.lower() in TEXTS and not path.name.startswith(".") and path.name not in _OWN

    def of_text(self, name: str | None) -> Project:
        """The same with another text file in the procedure's place, which has an undo list of its own.

        Raises Missing for a name that is not among ``texts``, and could not be that of a new one.
        """
        if name is None or name == self.procedure.name:
            return self
        if name not in self.texts and not self._may_be_new(name):
            raise Missing(f"there is no text file {name!r} beside {self.procedure.name}")
        return replace(self, procedure=self.procedure.parent / name, undo=name)

    def _may_be_new(self, name: str) -> bool:
        path = self.procedure.parent / name
        free = _NEW.fullmatch(name) is not None and not path.exists() and not path.is_symlink()
        return free and path.suffix.lower() in TEXTS and name not in _OWN

    @property
    def runs(self) -> list[Path]:
        """Folders of whole runs, oldest first; none that leads out of the project."""
        return [run for run in runs(self.folder / "runs") if run.resolve().is_relative_to(self.folder)]

    @property
    def is_new(self) -> bool:
        """Whether nothing was put into it yet: no run, and no file among its own references."""
        home = Path(self.origin.source)
        with suppress(OSError):
            return self.origin.confine is not None and not self.runs and not any(home.iterdir())
        return False

    def home_of_runs(self) -> Path:
        """The folder for new runs. Raises ProjectError for a link, which may lead out of the project."""
        folder = self.folder / "runs"
        if folder.is_symlink():
            raise ProjectError(f"{folder}: a link, so no run is written there; put a folder in its place")
        return folder

    def run(self, name: str) -> Path:
        """The folder of a run. Raises Missing when there is none of this name."""
        folder = next((run for run in self.runs if run.name == name), None)
        if folder is None:
            raise Missing(f"there is no run {name!r}")
        return folder

    def run_file(self, name: str, path: str) -> Path:
        """A file of a run. Raises Missing when it is not there, or lies outside the run's folder, links followed."""
        home = self.run(name).resolve()
        file = (home / path).resolve()
        if not home.is_relative_to(self.folder) or not file.is_relative_to(home) or not file.is_file():
            raise Missing(f"there is no file {path!r} in run {name}")
        return file

    def read_source(self) -> tuple[str, str]:
        """Text and digest of the procedure. Raises ProjectError when it cannot be read, or leads out of the project."""
        self._check_inside()
        try:
            text = text_of(self.procedure)
        except FileNotFoundError as error:
            raise ProjectError(f"{self.procedure.name} is not there any more") from error
        except (OSError, UnicodeDecodeError) as error:
            raise ProjectError(f"{self.procedure.name} cannot be read as UTF-8 text: {error}") from error
        return text, source_digest(text)

    def _check_inside(self) -> None:
        if not self.procedure.resolve().is_relative_to(self.folder):
            raise ProjectError(f"{self.procedure.name} has become a link that leads out of the project")

    def write_source(self, text: str, expected: str | None, writer: Writer = "editor", of: str = "") -> int | None:
        """Replace the procedure's text, whole or not at all, and return the number of this revision.

        A file that is not there any more is made anew. expected: digest of the text that the edit began from; None to
        write whatever is there. writer, of: see ``Revision``. None is returned where the text is this one already.
        Raises Conflict, ProjectError.
        """
        self._check_inside()
        there = self.procedure.exists()
        before, digest = self.read_source() if there or expected is not None else ("", "")
        if expected is not None and digest != expected:
            raise Conflict(before, digest)
        if self.procedure.suffix.lower() in BINARY:
            raise ProjectError(f"{self.procedure.name} is no text; change it in the program that made it")
        if there and text == before:
            return None
        ending = "\r\n" if there and b"\r\n" in self.procedure.read_bytes() else "\n"
        try:
            with self.revisions.of_write(before, text, writer, of) as number:
                _write(self.procedure, text.replace("\r\n", "\n").replace("\n", ending))
        except OSError as error:
            raise ProjectError(f"{self.folder / SCRATCH}: cannot be written: {error.strerror or error}") from error
        return number

    @property
    def revisions(self) -> Revisions:
        """All writes of the procedure."""
        inside = Path(_REVISIONS, self.undo)
        return Revisions(self.folder / SCRATCH / inside, lambda: self.scratch(inside.as_posix()))

    def seen(self, last: str | None, now: str) -> None:
        """Put into the undo list what another program has written. last: the text that was there before, if known."""
        if self.procedure.suffix.lower() not in BINARY:
            with suppress(OSError, ProjectError):  # the list is a help; what the author saved holds without it
                self.revisions.catch_up(last, now)

    def write_copy(self, text: str) -> Path:
        """Put a text beside the procedure under a new name, and return its path. Raises ProjectError."""
        self._check_inside()
        stem, suffix = self.procedure.stem, self.procedure.suffix
        home = self.procedure.parent
        taken = {path.name for path in home.iterdir()}
        name = next(name for i in range(1, len(taken) + 2) if (name := f"{stem}-{i}{suffix}") not in taken)
        _write(home / name, text)
        return home / name

    def scratch(self, inside: str = "") -> Path:
        """The folder for what the studio keeps, or one inside it; git passes over it. Raises ProjectError for links."""
        folder = self.folder / SCRATCH
        parts = Path(inside).parts
        for part in (folder.joinpath(*parts[:depth]) for depth in range(len(parts) + 1)):
            if part.is_symlink():
                raise ProjectError(f"{part}: a link; remove it")
            part.mkdir(exist_ok=True)
        if not (folder / ".gitignore").exists():
            write_file(folder / ".gitignore", "*\n")
        remove_leftovers(folder)
        return folder / inside

    def kept_settings(self) -> dict[str, Any]:
        """What ``keep_settings`` kept; nothing where that cannot be read."""
        try:
            kept: Any = json.loads((self.folder / SCRATCH / _SETTINGS).read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return kept if isinstance(kept, dict) else {}

    def keep_settings(self, chosen: Mapping[str, Any]) -> None:
        """Keep what was chosen in the page. Raises ProjectError."""
        if chosen != self.kept_settings():
            _write(self.scratch() / _SETTINGS, json.dumps(dict(chosen), indent=1) + "\n")


def _write(path: Path, text: str) -> None:
    """Replace a file's text, whole or not at all; a link is followed."""
    try:
        write_file(path.resolve(), text)
    except OSError as error:
        raise ProjectError(f"{path}: cannot be written: {error.strerror or error}") from error
