"""The procedure as the studio knows it: what is on disk, and the newest version of it that could be read."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

from shapewright.studio.project.watch import fingerprint
from shapewright.studio.project.workspace import Project
from shapewright.studio.wire.collection import Parameter, Procedure
from shapewright.studio.wire.values import Values, message_of


@dataclass(eq=False)
class Authored:
    """The procedure, read again and again."""

    project: Project
    state: Literal["loading", "good", "broken"] = "loading"  # of the newest version
    digest: str = ""  # of the text on disk
    name: str = ""  # of the newest good version
    parameters: list[Parameter] = field(default_factory=list)  # of the newest good version
    defaults: Values = field(default_factory=dict)  # of the newest good version
    up: str | None = None  # axis that points up, of the newest good version; None before the first
    load: int = 0  # number of the newest reading
    saved: bool = False  # whether that followed a save
    _fingerprint: str = ""
    _text: str | None = None

    @property
    def version(self) -> str | None:
        """Tells what is on disk, helpers included, from all other versions; None for one that cannot be used."""
        return None if self.state == "broken" else self._fingerprint

    def changed(self) -> bool:
        """Whether a Python file of the project is another than when it was read last."""
        return fingerprint(self.project) != self._fingerprint

    def read(self, saved: bool) -> None:
        """Look at the file anew. Raises ProjectError when it cannot be read; the state is then ``broken``."""
        before = self._text
        self._fingerprint = fingerprint(self.project)
        self.load += 1
        self.state = "broken"
        self._text, self.digest = self.project.read_source()
        self.project.seen(before, self._text)
        self.state, self.saved = "loading", saved

    def accept(self, name: str, parameters: list[Parameter], defaults: Values, up: str) -> None:
        self.state, self.name, self.parameters, self.defaults, self.up = "good", name, parameters, defaults, up

    def reject(self) -> None:
        self.state, self.saved = "broken", False

    def values(self, *layers: Values | None) -> Values:
        """The defaults, with later layers over earlier ones."""
        values = dict(self.defaults)
        for layer in layers:
            values |= layer or {}
        return values

    def procedure(self, stale: bool, fitted: str | None) -> Procedure:
        """As the page gets it."""
        return message_of(Procedure, self, stale=stale, fitted=fitted)
