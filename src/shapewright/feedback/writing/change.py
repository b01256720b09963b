"""What a suggestion changes in an author's file, as facts: a file that was edited since can be changed so, too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import msgspec

from shapewright.feedback.writing.edit import NewRule, parameter_line, with_range, with_rule
from shapewright.feedback.writing.source import EditError, code, free_name, functions_in, parsed


@dataclass(frozen=True)
class NewLimits:
    """Other limits of a parameter's Range, as text; what is None stays.

    Attributes:
        parameter: its name.
        low: the lower end.
        high: the upper end.
        steps: of a Range that has some.
    """

    parameter: str
    low: str | None
    high: str | None
    steps: str | None


@dataclass(frozen=True)
class FileChange:
    """A change of the file of a procedure.

    Attributes:
        procedure: its name.
        limits: Ranges that change.
        rule: what comes new.
    """

    procedure: str
    limits: tuple[NewLimits, ...] = ()
    rule: NewRule | None = None

    def written(self, source: str) -> str:
        """The changed text. Raises EditError where the text is written in a way that the change does not know."""
        for new in self.limits:
            source = with_range(source, self.procedure, new.parameter, new.low, new.high, new.steps)
        return with_rule(source, self.procedure, self.rule) if self.rule else source

    def merged(self, before: str, now: str) -> str:
        """The text as it is now with the change, which was made for the text before.

        Raises EditError where the author has edited the same Range since, or has taken a name that comes new.
        """
        for name in [new.parameter for new in self.limits] if now != before else ():
            if parameter_line(before, self.procedure, name) != parameter_line(now, self.procedure, name):
                raise EditError(f"you have edited {name} since this was tried")
        if self.rule and now != before:
            there = {function.name.value: code(function) for function in functions_in(parsed(now))}
            new = {function.name.value: code(function) for function in functions_in(parsed(self.rule.function))}
            names = [parameter.name for parameter in self.rule.parameters]
            names += [name for name, text in new.items() if there.get(name) != text]
            taken = [name for name in names if free_name(now, self.procedure, name) != name]
            if taken:
                raise EditError(f"your file has {', '.join(taken)} already, which this would add")
        return self.written(now)

    def only_when(self, condition: str) -> FileChange:
        """The same with a rule that can be switched on only where a condition on the parameters, ``p``, holds."""
        assert self.rule and self.rule.flag
        flag, *others = self.rule.parameters
        flag = replace(flag, annotation=f"Annotated[bool, When(lambda p: {condition})]")
        ours = ("shapewright", "typing")
        names = {module: self.rule.imports.get(module, ()) for module in ours}
        names = {"shapewright": (*names["shapewright"], "When"), "typing": tuple({*names["typing"], "Annotated"})}
        rule = replace(self.rule, parameters=(flag, *others), imports={**self.rule.imports, **names})
        return replace(self, rule=rule)

    @property
    def record(self) -> dict[str, Any]:
        """For JSON."""
        plain: dict[str, Any] = msgspec.to_builtins(self)
        return plain

    @classmethod
    def from_record(cls, record: Mapping[str, Any]) -> FileChange:
        """Raises EditError for what is no record of a change."""
        try:
            return msgspec.convert(record, cls)
        except msgspec.ValidationError as error:
            raise EditError(f"the run does not say what this changes ({error}); explain it again") from error
