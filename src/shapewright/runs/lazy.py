"""What is read when somebody asks for it: sequences of things on disk, and single shapes of results."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeVar, cast, overload

Item = TypeVar("Item")


class Lazy(Sequence[Item]):
    """``count`` things, each of which ``item`` gives by its place."""

    def __init__(self, count: int, item: Callable[[int], Item]) -> None:
        self._count, self._item = count, item

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, place: int) -> Item: ...
    @overload
    def __getitem__(self, place: slice) -> Sequence[Item]: ...
    def __getitem__(self, place: int | slice) -> Item | Sequence[Item]:
        if isinstance(place, slice):
            return [self._item(i) for i in range(*place.indices(self._count))]
        if not -self._count <= place < self._count:
            raise IndexError(f"there are {self._count}, and none has the place {place}")
        return self._item(place % self._count)


@dataclass(frozen=True)
class Later(Generic[Item]):
    """A value that is read whenever somebody asks for it, and not kept."""

    read: Callable[[], Item]


def later(read: Callable[[], Item]) -> Item:
    """What a field that is ``Read`` takes in place of its value."""
    return cast(Item, Later(read))


class Read:
    """A field of a class of dataclasses that takes what is read ``later`` as well as a value."""

    def __init__(self, name: str) -> None:
        self._name = f"_{name}"

    def __get__(self, holder: Any, owner: type | None = None) -> Any:
        if holder is None:
            return self
        value = vars(holder)[self._name]
        return value.read() if isinstance(value, Later) else value

    def __set__(self, holder: Any, value: Any) -> None:
        vars(holder)[self._name] = value

    def held(self, holder: Any) -> Any:
        """The value, or what reads it, to make another such dataclass with."""
        return vars(holder)[self._name]
