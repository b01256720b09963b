"""The procedure as the studio knows it: what is on disk, and the newest version of it that could be read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

from shapewright.studio.project.workspace import Project

_NOTHING: Mapping[str, Any] = {"name": "", "parameters": [], "defaults": {}}


@dataclass(eq=False)
class Authored:
    """state: of the newest version. digest: of the text on disk. version: name, parameters and defaults of the newest
    good one. load: number of the newest reading. saved: whether that followed a save. helper: whether the save was of
    another file than the procedure's own."""

    project: Project
    state: Literal["loading", "good", "broken"] = "loading"
    digest: str = ""
    version: Mapping[str, Any] = field(default_factory=lambda: _NOTHING)
    load: int = 0
    saved: bool = False
    helper: bool = False
    _fingerprint: str = ""

    def changed(self) -> bool:
        """Whether a Python file of the project is another than when it was read last."""
        return self.project.fingerprint() != self._fingerprint

    def read(self, saved: bool) -> None:
        """Look at the file anew. Raises ProjectError when it cannot be read; the state is then ``broken``."""
        before = self.digest
        self._fingerprint = self.project.fingerprint()
        self.load += 1
        self.state = "broken"
        _, self.digest = self.project.read_source()
        self.state, self.saved, self.helper = "loading", saved, saved and self.digest == before

    def accept(self, version: Mapping[str, Any]) -> None:
        self.state, self.version = "good", version

    def reject(self) -> None:
        self.state, self.saved = "broken", False

    def values(self, *layers: Mapping[str, Any] | None) -> dict[str, Any]:
        """The defaults, with later layers over earlier ones."""
        values = dict(self.version["defaults"])
        for layer in layers:
            values |= layer or {}
        return values

    def record(self, stale: bool, fitted: str | None) -> dict[str, Any]:
        """The page's ``Procedure``."""
        return {
            "state": self.state,
            "stale": stale,
            "name": self.version["name"],
            "digest": self.digest,
            "fitted": fitted,
            "parameters": self.version["parameters"],
        }
