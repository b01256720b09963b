"""The parameter space that a function's signature spells."""

from __future__ import annotations

import dataclasses
import functools
import inspect
import linecache
import types
import typing
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from shapewright.parameters import Parameters, ParameterSpace
from shapewright.procedures.annotations import Argument, SignatureError, read
from shapewright.procedures.bindings import Binding, Plain
from shapewright.procedures.errors import ProcedureError
from shapewright.procedures.places import Place

_KINDS = (
    "Annotated[float, Range(low, high)] for a scalar, Annotated[int, Range(low, high)] for an integer, "
    'bool for a binary, Literal["a", "b"] for a choice'
)


@dataclass(frozen=True)
class Signature:
    """How a function is called with the values of a space.

    Attributes:
        space: its parameters.
        bindings: for each argument that the space is about what it gets, by its name.
        fixed: names of the arguments that stay at their defaults: they have no Range.
        positional: names of those that stand before a ``/``.
        meanings: what is said of parameters in words, by name.
    """

    space: ParameterSpace
    bindings: Mapping[str, Binding]
    fixed: tuple[str, ...] = ()
    positional: tuple[str, ...] = ()
    meanings: Mapping[str, str] = dataclasses.field(default_factory=dict)

    def call(self, function: Callable[..., Any], args: Sequence[Any], given: Mapping[str, Any]) -> Any:
        """Call the function with values of the space, or with its own arguments; what is left out is at its default."""
        values = {**self._defaults, **given}
        arguments = {name: value for name, value in values.items() if name not in self._inner}
        for name, binding in self._made.items():
            own = name in given and binding.names[0] not in given  # called with the function's own argument
            arguments[name] = given[name] if own else binding(values)
        for name in list(self.bindings)[: len(args)] if args else ():
            if name not in given:  # a second value of an argument is the function's to refuse
                del arguments[name]
        before = [arguments.pop(name) for name in self.positional[len(args) :]]
        return function(*args, *before, **arguments)

    def arguments(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """What the function gets for values of the space, by the names of its arguments."""
        complete = {**self._defaults, **values}
        return {name: binding(complete) for name, binding in self.bindings.items()}

    @functools.cached_property
    def _defaults(self) -> Parameters:
        return self.space.defaults

    @functools.cached_property
    def _made(self) -> dict[str, Binding]:
        """The bindings of the arguments that are made of values; each other argument is a value itself."""
        return {name: binding for name, binding in self.bindings.items() if not isinstance(binding, Plain)}

    @functools.cached_property
    def _inner(self) -> frozenset[str]:
        """The values that are no arguments themselves."""
        return frozenset(self.space.names) - self.bindings.keys()


def signature_of(function: Callable[..., Any], names: Mapping[str, Any] | None = None, skip: int = 0) -> Signature:
    """What a function's signature spells, without its first ``skip`` parameters.

    names: those of the place where it is defined, which annotations may use.
    Raises ProcedureError, pointing at the function, where an annotation is no parameter's.
    """
    place = place_in(function)
    if inspect.iscoroutinefunction(function):
        raise ProcedureError("an async function builds nothing by itself; leave async out", place)
    items = list(inspect.signature(function).parameters.values())
    if not items:
        raise ProcedureError(f"it has no parameters; give it some: {_KINDS}", place)
    bound = set(function.keywords) if isinstance(function, functools.partial) else set()
    try:
        items = items[skip:]
        hints = _hints(function, [item.name for item in items], names or {})
        arguments = [
            argument for item in items for argument in _argument(item, hints.get(item.name), item.name in bound)
        ]
        signature = _signature(arguments, items)
        if not len(signature.space) and not skip:
            raise SignatureError("none of its arguments has a Range", unknown=True)
        signature.space.active(signature.space.defaults)  # a when= that fails says so now
    except ValueError as error:
        raise ProcedureError(str(error), place) from error
    except SignatureError as error:
        raise ProcedureError(f"{error}; use {_KINDS}" if error.unknown else str(error), place) from error
    return signature


def _signature(arguments: Sequence[Argument], items: Sequence[inspect.Parameter]) -> Signature:
    known = [argument for argument in arguments if argument.binding]
    fixed = tuple(argument.name for argument in arguments if not argument.binding)
    space = ParameterSpace(tuple(parameter for argument in known for parameter in argument.parameters))
    twice = {name for name in space.names if space.names.count(name) > 1}
    if twice:
        raise SignatureError(f"two parameters are called {', '.join(sorted(twice))}")
    before = tuple(item.name for item in items if item.kind is item.POSITIONAL_ONLY and item.name not in fixed)
    bindings = {argument.name: argument.binding for argument in known if argument.binding}
    meanings = {name: text for argument in known for name, text in argument.meanings.items()}
    return Signature(space, bindings, fixed, before, meanings)


def _argument(item: inspect.Parameter, hint: Any, bound: bool) -> Iterator[Argument]:
    """Nothing for ``*`` and ``**``: whoever calls the function leaves them empty."""
    if item.kind in (item.VAR_POSITIONAL, item.VAR_KEYWORD):
        return
    default = None if item.default is item.empty else item.default
    missing = item.default is item.empty
    if bound:
        yield Argument(item.name)
    elif hint is None and missing:
        raise SignatureError(f"parameter {item.name!r} has no annotation", unknown=True)
    elif hint is None:
        yield Argument(item.name)
    else:
        yield read(item.name, hint, default, missing)


def _hints(function: Callable[..., Any], wanted: Sequence[str], names: Mapping[str, Any]) -> dict[str, Any]:
    """The annotations of these arguments. What the function returns is left out: it may be known to a checker alone."""
    inner: Any = inspect.unwrap(function.func if isinstance(function, functools.partial) else function)
    if isinstance(spelled := getattr(inner, "__signature__", None), inspect.Signature):  # of a file that is no Python
        return {item.name: item.annotation for item in spelled.parameters.values() if item.annotation is not item.empty}
    if isinstance(inner, type) and not dataclasses.is_dataclass(inner):
        inner = vars(inner).get("__init__", inner)
    elif not isinstance(inner, type) and not hasattr(inner, "__annotations__"):
        inner = type(inner).__call__
    annotations = {name: hint for name, hint in _annotations(inner).items() if name in wanted}
    scope = {**getattr(inspect.getmodule(inner), "__dict__", {}), **getattr(inner, "__globals__", {})}
    try:
        annotations = {n: _evaluated(h, scope, names) if isinstance(h, str) else h for n, h in annotations.items()}
        holder = types.SimpleNamespace(__annotations__=annotations)
        return typing.get_type_hints(holder, scope, dict(names), include_extras=True)
    except (NameError, TypeError, AttributeError, SyntaxError) as error:
        raise SignatureError(f"an annotation cannot be read: {error}") from error


def _evaluated(text: str, scope: dict[str, Any], names: Mapping[str, Any]) -> Any:
    """What an annotation that is text means. Its text is kept, so that a condition in it can be shown."""
    place = f"<annotation {text}>"
    linecache.cache[place] = (len(text), None, [text], place)
    return eval(compile(text, place, "eval"), scope, {**names})


def _annotations(inner: Any) -> dict[str, Any]:
    if isinstance(inner, type):  # a dataclass that builds itself when it is called: its bases' fields count as well
        return {
            name: hint
            for base in reversed(inner.__mro__)
            for name, hint in vars(base).get("__annotations__", {}).items()
        }
    return dict(getattr(inner, "__annotations__", {}))


def place_in(function: Callable[..., Any]) -> Place:
    """Where a function begins; the class of an object that is called, or the place that the object says itself."""
    if isinstance(said := getattr(function, "place", None), Place):
        return said
    inner: Any = inspect.unwrap(function.func if isinstance(function, functools.partial) else function)
    name = name_of(function)
    inner = getattr(inner, "__func__", inner)
    if code := getattr(inner, "__code__", None):
        return Place(code.co_filename, code.co_firstlineno, function=name)
    home = inner if isinstance(inner, type) else type(inner)
    try:
        return Place(inspect.getsourcefile(home) or name, inspect.getsourcelines(home)[1], function=name)
    except (OSError, TypeError):
        return Place(getattr(home, "__module__", name), None, function=name)


def name_of(function: Callable[..., Any]) -> str:
    """Of the function, of what a partial function calls, of the class of an object that is called."""
    inner: Any = function.func if isinstance(function, functools.partial) else function
    return getattr(inner, "__name__", None) or type(inner).__name__
