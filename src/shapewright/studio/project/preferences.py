"""What the author chose in the page: how fits run, and when."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Any

from shapewright.fields import Field, fields_of, meant
from shapewright.settings import Preset, Settings, described, groups
from shapewright.studio.wire.changes import ChosenSettings

SHAPE_SECONDS = 5.0
"""Seconds that one shape may take in the studio: half of what a fit on the command line gives it, because one waits."""
_JUDGE = ("judge", "replicated", "close", "threshold", "vif")
_PREPARED = ("drop", "leave_out")
_FIT = ("samples", "epochs", "refine", "facing", "rounds", "seed", *_JUDGE, "shape_seconds", *_PREPARED)
_GROUPS = groups()
_KEPT = (
    *(*_GROUPS["preparing"], *_GROUPS["building"], *(name for name in _GROUPS["judging"] if name != "judge")),
    *("seed", "workers"),
)
"""The settings that stay when another preset is chosen: no preset says anything about them."""


@dataclass(frozen=True)
class Preferences:
    """What the author chose. Each field but ``settings`` is one of ``ChosenSettings``, and so is each of _FIT."""

    auto_fit: Annotated[bool, "A fit follows every save."] = True
    fresh: Annotated[bool, "A fit learns anew, and does not resume the run before."] = False
    preset: Annotated[Preset, "Settings of fits to start from."] = "fast"
    settings: Settings = field(default_factory=lambda: Settings(shape_seconds=SHAPE_SECONDS))

    @staticmethod
    def described() -> Mapping[str, Field]:
        """What each field of ``ChosenSettings`` may be."""
        own = {name: field for name, field in fields_of(Preferences).items() if name != "settings"}
        return own | {name: described()[name] for name in _FIT}

    def message(self) -> ChosenSettings:
        """As the page gets them."""
        values = {name: getattr(self.settings if name in _FIT else self, name) for name in self.described()}
        return ChosenSettings(**values)

    def changed(self, given: Mapping[str, Any]) -> Preferences:
        """With some fields of ``ChosenSettings`` replaced. Raises ValueError, which names a field that cannot be."""
        fields = self.described()
        unknown = [name for name in given if name not in fields]
        if unknown:
            raise ValueError(f"there is no setting {unknown[0]!r}{meant(unknown[0], fields)}")
        checked = {name: fields[name].checked(value) for name, value in given.items()}
        own = {name: value for name, value in checked.items() if name not in _FIT}
        settings = self.settings
        if own.get("preset", self.preset) != self.preset:
            settings = Settings.preset(own["preset"], **{name: getattr(settings, name) for name in _KEPT})
        fit = {name: value for name, value in checked.items() if name in _FIT}
        return replace(self, **own, settings=replace(settings, **fit))
