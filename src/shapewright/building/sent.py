"""A procedure as it crosses to other processes and to other machines: small, plain, and known by its text."""

from __future__ import annotations

import hashlib
import pickle
import platform
import sys
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

import cloudpickle

from shapewright.procedures import Procedure, ProcedureError
from shapewright.versions import version_of


@dataclass(frozen=True)
class Sent:
    """A procedure by its file and name, else by its module, else by value.

    target: what a worker process reads it from, pickled.
    places: where its own process looks for modules: a worker needs them before it reads the procedure.
    working: the folder that it is built in; None for that of the process.
    files: the procedure's and those that it uses from its folder, for who checks that they are the same elsewhere.
    digest: of the contents of these files.
    version: of shapewright.
    """

    target: bytes
    places: tuple[str, ...]
    working: Path | None
    files: tuple[Path, ...] = ()
    digest: str = ""
    version: str = ""

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
    def outward(cls, procedure: Procedure) -> Sent:
        """For other machines: it is built there in the working folder of this process, from the same files."""
        if procedure.path and (module := sys.modules.get(procedure.function.__module__)):
            # Conditions of parameters are sent with the work. They may be functions of a file that only we have loaded.
            cloudpickle.register_pickle_by_value(module)
        sent, named = cls.of(procedure), (procedure.path, *procedure.helpers)
        files = tuple(file for file in named if file and file.is_file())
        working = sent.working or Path.cwd()
        return replace(sent, working=working, files=files, digest=_digest(files), version=version_of("shapewright"))

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
        return replace(self, places=places, working=working)


def _digest(files: Iterable[Path]) -> str:
    content = hashlib.sha256()
    for file in files:
        content.update(hashlib.sha256(file.read_bytes()).digest())
    return content.hexdigest()
