"""What the author chose in the page: how fits run, and when."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, get_type_hints

from shapewright.settings import Settings

_FIT = ("samples", "epochs", "refine", "rounds", "seed", "threshold", "fidelity", "shape_seconds")
_PRESETS = ("fast", "paper")


@dataclass(frozen=True)
class Preferences:
    """auto_fit: a fit follows every save. fresh: fits do not go on from the run before. settings: of the fits."""

    auto_fit: bool = True
    fresh: bool = False
    preset: str = "fast"
    settings: Settings = field(default_factory=lambda: Settings(shape_seconds=5.0))

    def record(self) -> dict[str, Any]:
        """The page's ``Settings``."""
        own = {"auto_fit": self.auto_fit, "fresh": self.fresh, "preset": self.preset}
        return own | {name: getattr(self.settings, name) for name in _FIT}

    def changed(self, given: dict[str, Any]) -> Preferences:
        """With some entries of ``record`` replaced. Raises ValueError, which names an entry that cannot be."""
        result = self
        for name in ("auto_fit", "fresh"):
            if name in given:
                if not isinstance(given[name], bool):
                    raise ValueError(f"{name} is true or false")
                result = replace(result, **{name: given[name]})
        if given.get("preset", self.preset) != self.preset:
            if given["preset"] not in _PRESETS:
                raise ValueError(f"preset is one of {', '.join(_PRESETS)}")
            kept = {
                name: getattr(self.settings, name)
                for name in ("seed", "threshold", "fidelity", "shape_seconds", "shape_memory_mb", "workers")
            }
            result = replace(result, preset=given["preset"], settings=Settings.preset(given["preset"], **kept))
        changes = {name: _checked(name, value) for name, value in given.items() if name in _FIT}
        unknown = set(given) - {"auto_fit", "fresh", "preset", *_FIT}
        if unknown:
            raise ValueError(f"no setting {', '.join(sorted(unknown))}")
        return replace(result, settings=replace(result.settings, **changes))


def _checked(name: str, value: Any) -> Any:
    kind = get_type_hints(Settings)[name]
    if name == "refine":
        if value not in ("off", "quick", "thorough"):
            raise ValueError("refine is off, quick or thorough")
        return value
    if isinstance(value, bool) or not isinstance(value, int | float) or (kind is int and value != int(value)):
        raise ValueError(f"{name} is a {'whole ' if kind is int else ''}number")
    if value < 0:
        raise ValueError(f"{name}={value} is less than 0")
    return kind(value)
