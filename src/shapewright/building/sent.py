"""A procedure as it crosses to other processes and to other machines: small, plain, and known by its text."""

from __future__ import annotations

import atexit
import functools
import hashlib
import pickle
import platform
import shutil
import sys
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path

import cloudpickle

from shapewright.procedures import Procedure, ProcedureError
from shapewright.versions import version_of


@dataclass(frozen=True)
class Draft:
    """A procedure's file that lies where only its own machine sees it.

    path: the file.
    name: of the procedure in it.
    text: of the file.
    beside: the folder of the author's, whose files it may use.
    """

    path: Path
    name: str
    text: bytes
    beside: Path

    @classmethod
    def of(cls, procedure: Procedure, home: Path | None) -> Draft | None:
        """None for a procedure that lies in the author's folder, or in no file."""
        path = procedure.path
        if path is None or home is None or path.parent == home:
            return None
        return cls(path, procedure.name, path.read_bytes(), home)

    def landed(self) -> Path:
        """The file here: itself where it is there, else a copy with links to the author's files beside it."""
        if self.path.is_file() and self.path.read_bytes() == self.text:
            return self.path
        return _landed(self)


@functools.lru_cache(maxsize=64)
def _landed(draft: Draft) -> Path:
    folder = Path(tempfile.mkdtemp(prefix="shapewright-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    path = folder / draft.path.name
    path.write_bytes(draft.text)
    link_all(draft.beside, folder)
    return path


def link_all(source: Path, folder: Path) -> None:
    """Link the files of a folder into another one, but those whose names are taken there."""
    for file in source.iterdir() if source.is_dir() else ():
        with suppress(OSError):  # Windows may forbid links
            (folder / file.name).symlink_to(file)


@dataclass(frozen=True)
class Sent:
    """A procedure by its file and name, else by its module, else by value.

    target: what a worker process reads it from, pickled.
    places: where its own process looks for modules: a worker needs them before it reads the procedure.
    working: the folder that it is built in; None for that of the process.
    files: the procedure's and those that it uses from its folder, for who checks that they are the same elsewhere.
    digest: of the contents of these files.
    version: of shapewright.
    draft: the file itself, where other machines do not see it.
    """

    target: bytes
    places: tuple[str, ...]
    working: Path | None
    files: tuple[Path, ...] = ()
    digest: str = ""
    version: str = ""
    draft: Draft | None = None

    @classmethod
    def of(cls, procedure: Procedure) -> Sent:
        """For processes of this machine. Raises ProcedureError when it cannot be sent."""
        target = f"{procedure.path}:{procedure.name}" if procedure.path else procedure
        try:
            pickled = bytes(cloudpickle.dumps(target))
        except Exception as error:
            raise ProcedureError(
                f"it cannot be sent to the worker processes ({error}); "
                "put the procedure in a file of its own and load it with load_procedure",
                procedure.place,
            ) from error
        return cls(pickled, tuple(sys.path), procedure.working)

    @classmethod
    def outward(cls, procedure: Procedure, home: Path | None = None) -> Sent:
        """For other machines: it is built there in the working folder of this process, from the same files.

        home: the author's folder; a file that lies elsewhere is sent whole.
        """
        if procedure.path and (module := sys.modules.get(procedure.function.__module__)):
            # Conditions of parameters are sent with the work. They may be functions of a file that only we have loaded.
            cloudpickle.register_pickle_by_value(module)
        draft = Draft.of(procedure, home)
        sent, named = cls.of(procedure), () if draft else (procedure.path, *procedure.helpers)
        files = tuple(file for file in named if file and file.is_file())
        working = sent.working or Path.cwd()
        return replace(
            sent, working=working, files=files, digest=_digest(files), version=version_of("shapewright"), draft=draft
        )

    @property
    def payload(self) -> bytes:
        """As a worker process receives it."""
        return pickle.dumps((list(self.places), self.working, self.target))

    def arrived(self) -> Sent:
        """The same on the machine that it was sent to. Raises ProcedureError when the procedure is not the same there.

        Modules are looked for where its own process does, and then where this one does.
        """
        here, installed = platform.node(), version_of("shapewright")
        if self.version != installed:
            raise ProcedureError(
                f"{here} has shapewright {installed}, and not {self.version}: install the same version on all machines"
            )
        for file in self.files:
            if not file.is_file():
                raise ProcedureError(
                    f"{file}: no such file on {here}; put the procedure's folder on a disk that all machines see"
                )
        if _digest(self.files) != self.digest:
            raise ProcedureError(f"{self.files[0]}: on {here} this is another text, or it was edited meanwhile")
        places = (*self.places, *(place for place in sys.path if place not in self.places))
        working = self.working if self.working and self.working.is_dir() else None
        target = cloudpickle.dumps(f"{self.draft.landed()}:{self.draft.name}") if self.draft else self.target
        return replace(self, target=target, places=places, working=working)


def _digest(files: Iterable[Path]) -> str:
    content = hashlib.sha256()
    for file in files:
        content.update(hashlib.sha256(file.read_bytes()).digest())
    return content.hexdigest()
