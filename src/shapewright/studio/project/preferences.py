"""What the author chose in the page: how fits run, and when."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Annotated, Any

from shapewright.fields import Field, fields_of, meant
from shapewright.settings import Preset, Settings, described, groups
from shapewright.studio.wire.changes import ChosenSettings, Scale

SHAPE_SECONDS = 5.0
"""Seconds that one shape may take in the studio: half of what a fit on the command line gives it, because one waits."""
_JUDGE = ("judge", "replicated", "close", "threshold", "vif")
_PREPARED = ("drop", "leave_out")
_FIT = ("samples", "epochs", "refine", "facing", "rounds", "seed", *_JUDGE, "shape_seconds", *_PREPARED)
_OWN = ("auto_fit", "fresh", "scale", "preset")
_GROUPS = groups()
_KEPT = (
    *(*_GROUPS["preparing"], *_GROUPS["building"], *(name for name in _GROUPS["judging"] if name != "judge")),
    *("seed", "workers"),
)
"""The settings that stay when another preset is chosen: no preset says anything about them."""


@dataclass(frozen=True)
class Preferences:
    """What the author chose. Each field but the last two is one of ``ChosenSettings``, and so is each of _FIT."""

    auto_fit: Annotated[bool, "A fit follows every save."] = True
    fresh: Annotated[bool, "A fit learns anew, and does not resume the run before."] = False
    scale: Annotated[Scale, "The colours of grades in the page."] = "clear"
    preset: Annotated[Preset, "Settings of fits to start from."] = "fast"
    settings: Settings = field(default_factory=lambda: Settings(shape_seconds=SHAPE_SECONDS))
    chosen: Mapping[str, Any] = field(default_factory=dict)  # those of ChosenSettings that were chosen in the page

    @classmethod
    def at_start(cls, kept: Mapping[str, Any], given: Mapping[str, Any]) -> Preferences:
        """Of a studio that starts.

        kept: what was chosen in the page before; an entry that cannot be is passed over.
        given: ``auto_fit``, ``preset`` and settings that the command line names; they go before what is kept.
        """
        preset: Preset = given.get("preset", cls.preset)
        settings = {name: value for name, value in given.items() if name not in cls.described() or name in _FIT}
        settings = {"shape_seconds": SHAPE_SECONDS, **settings}
        opened = cls(given.get("auto_fit", cls.auto_fit), preset=preset, settings=Settings.preset(preset, **settings))
        others = {name: value for name, value in kept.items() if name not in given}
        if "preset" in given and given["preset"] != kept.get("preset", cls.preset):
            others = _without_fit(others)
        try:
            return opened.changed(others)
        except ValueError:
            for name, value in others.items():
                with suppress(ValueError):
                    opened = opened.changed({name: value})
            return opened

    @staticmethod
    def described() -> Mapping[str, Field]:
        """What each field of ``ChosenSettings`` may be."""
        own = {name: field for name, field in fields_of(Preferences).items() if name in _OWN}
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
        settings, chosen = self.settings, self.chosen
        if own.get("preset", self.preset) != self.preset:
            chosen = _without_fit(chosen)
            settings = Settings.preset(own["preset"], **{name: getattr(settings, name) for name in _KEPT})
        fit = {name: value for name, value in checked.items() if name in _FIT}
        return replace(self, **own, settings=replace(settings, **fit), chosen={**chosen, **checked})


def _without_fit(chosen: Mapping[str, Any]) -> dict[str, Any]:
    """Without what another preset says in its own way."""
    return {name: value for name, value in chosen.items() if name not in _FIT or name in _KEPT}
