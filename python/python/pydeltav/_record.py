"""A part of a result."""

import types
from collections.abc import ItemsView, Iterator, Mapping, ValuesView
from typing import TYPE_CHECKING, Any, Generic, TypeVar, Union, get_args, get_origin, get_type_hints


class Record(Mapping[str, Any]):
    """A part of a result: its keys are attributes, and it reads as a dict. It cannot be changed.

    What keys a part has, in which units, its class in ``pydeltav.results`` tells.

    Parameters
    ----------
    entries : Mapping[str, Any]
        The keys and what stands there: a part of ``result.to_dict()``.

    Raises
    ------
    AttributeError
        If there is no such key, and if one is set.

    Examples
    --------
    >>> vehicle = pydeltav.Case.example().reconstruct().vehicle1
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
        return _shown(self._entries[key], _types(type(self)).get(key))

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    # A type checker knows the attributes of each class, and refuses all others.
    if not TYPE_CHECKING:

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
        return f"{type(self).__name__}({entries})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (self._entries,))


_Part = TypeVar("_Part")


class Keyed(Record, Generic[_Part]):
    """Parts of the same kind by their keys, such as ``result.outputs["vehicle1.speed"]``.

    Parameters
    ----------
    entries : Mapping[str, Any]
        The keys and what stands there.
    of : type
        The class of each part.

    Examples
    --------
    >>> numbers = pydeltav.Case.example().to_dict()
    >>> numbers["vehicle2"]["speed"] = {"low": "8 mph", "high": "12 mph"}
    >>> outputs = pydeltav.Case.from_dict(numbers).uncertainty(1000).outputs
    >>> [key for key, output in outputs.items() if output.central > 1000.0]
    ['impact.energy_loss', 'impact.normal_work', 'impact.tangential_work']
    """

    __slots__ = ("_of",)
    _of: Any

    def __init__(self, entries: Mapping[str, Any], of: Any) -> None:
        super().__init__(entries)
        object.__setattr__(self, "_of", of)

    def __getitem__(self, key: str) -> _Part:
        return _shown(self._entries[key], self._of)  # type: ignore[no-any-return]

    def items(self) -> ItemsView[str, _Part]:
        """The keys with their parts.

        Returns
        -------
        ItemsView
            As of a dict.

        Examples
        --------
        >>> {key: output.sd for key, output in uncertain.outputs.items()}["vehicle1.speed"] > 0.0
        True
        """
        return ItemsView(self)

    def values(self) -> ValuesView[_Part]:
        """The parts, in the order of the keys.

        Returns
        -------
        ValuesView
            As of a dict.

        Examples
        --------
        >>> any(output.first_order_sd > 1.0 for output in uncertain.outputs.values())
        True
        """
        return ValuesView(self)

    def __repr__(self) -> str:
        return f"Keyed({dict(self.items())!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Keyed, (self._entries, self._of))


_TYPES: dict[type, dict[str, Any]] = {}


def _types(of: type) -> dict[str, Any]:
    """The types of the attributes of a class."""
    if of not in _TYPES:
        _TYPES[of] = get_type_hints(of)
    return _TYPES[of]


def _alternatives(of: Any) -> tuple[Any, ...]:
    return get_args(of) if get_origin(of) in (Union, types.UnionType) else (of,)


def _shown(value: Any, of: Any) -> Any:
    """What stands in the document, as the type says that it is."""
    if isinstance(value, dict):
        for each in _alternatives(of):
            if get_origin(each) is Keyed:
                return Keyed(value, *get_args(each))
            if isinstance(each, type) and issubclass(each, Record):
                return each(value)
        return Record(value)
    if isinstance(value, list):
        elements = [of] * len(value)
        for each in _alternatives(of):
            if get_origin(each) is tuple:
                parts = list(get_args(each))
                elements = parts[:1] * len(value) if parts[-1] is ... else parts
        return tuple(map(_shown, value, elements))
    return value


Record.__module__ = "pydeltav"
Keyed.__module__ = "pydeltav.results"
