"""One reference to measure replicas against: what every kind of shape has to answer."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, Any, Literal, Protocol, Self, get_type_hints

from shapewright.comparison.grouping import Group
from shapewright.judging.paper import Metric
from shapewright.judging.verdict import Evidence, Grade
from shapewright.search.objective import Objective
from shapewright.settings import Settings
from shapewright.shapes import Floats, ReferenceShape, Shape


@dataclass(frozen=True)
class Measures:
    """How a replica differs from its reference; NaN for what cannot be measured. Records and tables go over these.

    The Chamfer distance and F-scores are those of surfaces, of drawings of outlines. Depth and volumes are of meshes
    alone, and the IoU of volumes is of two that enclose one.
    """

    distance: Annotated[float, "The paper's: light-field distance, or 1 - VIF; of a scan that of its points"] = math.nan
    iou: Annotated[float, "IoU of silhouettes, or of areas"] = math.nan
    chamfer: Annotated[float, "Chamfer distance, in largest extents"] = math.nan
    depth: Annotated[float, "Difference of depth pictures, 0 to 1"] = math.nan
    fidelity: Annotated[float, "Fidelity: how likely a person calls the two the same"] = math.nan
    volume_iou: Annotated[float, "IoU of volumes"] = math.nan
    f1: Annotated[float, "F-score at 1 % of the largest extent"] = math.nan
    f2: Annotated[float, "F-score at 2 % of the largest extent"] = math.nan

    def by_name(self) -> dict[str, float]:
        return dict(vars(self))

    @classmethod
    def words(cls) -> dict[str, str]:
        """What each measure is, by name."""
        return {name: hint.__metadata__[0] for name, hint in get_type_hints(cls, include_extras=True).items()}


def means(measured: Sequence[Measures], grades: Sequence[Grade]) -> dict[Literal["all", "replicated"], Measures]:
    """The mean of each measure over the pairs where it can be taken: of all, and of the replicated ones."""
    replicated = [each for each, grade in zip(measured, grades, strict=True) if grade == "replicated"]
    return {"all": mean(measured), "replicated": mean(replicated)}


def mean(measured: Sequence[Measures]) -> Measures:
    """Of each measure over the pairs where it can be taken; NaN where it never can."""
    columns = zip(*(each.by_name().values() for each in measured), strict=True)
    finite = [[value for value in column if math.isfinite(value)] for column in columns]
    return Measures(*(sum(column) / len(column) if column else math.nan for column in finite))


class Target(Protocol):
    """One reference, and whatever of it takes time to make, made when it is first needed; any thread may ask.

    What does not depend on the reference, such as the goal, is the same for all targets of a judge.
    """

    @property
    def shape(self) -> ReferenceShape:
        """The reference."""

    @property
    def visible(self) -> bool:
        """Whether a picture shows it; if none does, nothing can replicate it."""

    @property
    def metric(self) -> Metric:
        """The distance and its threshold, for a run's record."""

    @property
    def goal(self) -> float:
        """The cost of a search up to which a replica surely counts as the same; -inf where costs do not tell."""

    @property
    def enough(self) -> float:
        """A cost, by the last of the parts, at which a search may end; -inf where there is none."""

    @property
    def parts(self) -> tuple[slice, ...]:
        """The parts of a residual that a search goes by, one after the other, coarse to fine."""

    @property
    def surprise_cost(self) -> float:
        """What it costs a search to choose something unlikely, times minus the logarithm of the probability."""

    def objective(self, field: int = 0) -> Objective | None:
        """What a search makes small, in one light field; None where the reference cannot be seen."""

    def cost(self, replica: Shape) -> float:
        """The cost of a replica to a search, in the pose that it has; inf where the two cannot be compared."""

    def nearest(self, replica: Shape | None) -> tuple[float, int]:
        """The distance, and the light field in which the two differ least; NaN and 0 where it cannot be measured."""

    def fidelity(self, replica: Shape | None) -> float:
        """The replica's fidelity alone; NaN where the two cannot be compared."""

    def evidence(self, replica: Shape | None) -> Evidence:
        """The replica's fidelity, and the regions in which the two differ."""

    def measures(self, replica: Shape | None, distance: float | None = None, fidelity: float | None = None) -> Measures:
        """All that can be measured, nothing where the distance cannot. distance, fidelity: where known already."""

    def compatible(self, measures: Measures) -> bool:
        """Whether a replica with these measures counts as the same by the paper's measure."""

    def grade(self, measures: Measures) -> Grade:
        """The grade of a replica with these measures, by the judge of the settings."""

    @classmethod
    def groups(
        cls, names: Sequence[str], targets: Sequence[Self], settings: Settings, left: Floats | None = None
    ) -> tuple[Group, ...]:
        """Visible references, by likeness to each other, and by what is ``left`` between them and their replicas.

        left: (N, K), see ``remainders``.
        """


class Sought:
    """What a search makes small of one target, see ``Target.objective``; it is sent as the target, and made anew."""

    def __init__(self, target: Target, field: int) -> None:
        self._target, self._field = target, field
        self.made = functools.cache(functools.partial(target.objective, field))

    def __reduce__(self) -> tuple[Any, ...]:
        return Sought, (self._target, self._field)

    def residual(self, replica: Shape) -> Floats | None:
        form = self.made()
        return form.residual(replica) if form else None
