"""A part of a result."""

from collections.abc import Iterator, Mapping
from typing import Any


class Record(Mapping[str, Any]):
    """A part of a result: its keys are attributes, and it reads as a dict. It cannot be changed.

    >>> vehicle = deltav.Case.example().reconstruct().vehicle1
    >>> vehicle.delta_v == vehicle["delta_v"]
    True
    >>> "pdof" in vehicle
    True
    """

    __slots__ = ("_entries",)
    _entries: Mapping[str, Any]

    def __init__(self, entries: Mapping[str, Any]) -> None:
        object.__setattr__(self, "_entries", entries)

    def __getitem__(self, key: str) -> Any:
        return _shown(self._entries[key])

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __getattr__(self, name: str) -> Any:
        # Before the entries are there, as in a copy that is being made, there is nothing to look in.
        if not name.startswith("_"):
            try:
                return self[name]
            except KeyError:
                pass
        raise AttributeError(f"there is no '{name}' here, but {', '.join(self)}" if name[:1] != "_" else name)

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("a result cannot be changed")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self]

    def __repr__(self) -> str:
        entries = ", ".join(f"{key}={value!r}" for key, value in self.items())
        return f"Record({entries})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Record, (self._entries,))


def _shown(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return tuple(_shown(element) for element in value)
    return value


Record.__module__ = "deltav"
