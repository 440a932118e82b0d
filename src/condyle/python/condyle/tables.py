"""Tables of a scene file as objects, and as TOML: keywords are keys, and nothing is checked but their names."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Iterator, Mapping
from typing import Any, TypeVar


class Table:
    """A table of a scene file: keywords are its keys, None is left out. Compare, copy and pickle as usual."""

    name: str
    _keys: tuple[str, ...] = ()
    _tables: dict[str, Any] = {}  # classes of tables within

    def __init_subclass__(cls) -> None:
        cls._keys = tuple(name for name in cls.__annotations__ if not name.startswith("_"))

    def __init__(self, *name: Any, **keys: Any) -> None:
        if name:
            if len(name) > 1 or self._keys[0] != "name":
                raise TypeError(f"{type(self).__name__}: {len(name)} arguments without a keyword, expected "
                                f"{'a name' if self._keys[0] == 'name' else 'none'}")
            if "name" in keys:
                raise TypeError(f"{type(self).__name__}: name is given twice")
            keys["name"] = name[0]
        for key in self._keys:
            object.__setattr__(self, key, None)
        for key, value in keys.items():
            self._expect_key(key, TypeError)
            setattr(self, key + "_" if key + "_" in self._keys else key, value)

    @classmethod
    def _expect_key(cls, key: str, error: type) -> None:
        if key in cls._keys or key + "_" in cls._keys:
            return
        near = difflib.get_close_matches(key, cls._keys, 1)
        raise error(f'{cls.__name__}: unknown key {key}' + (f', did you mean "{near[0]}"?' if near else
                                                            f", expected {', '.join(cls._keys)}"))

    def __setattr__(self, key: str, value: Any) -> None:
        if not key.startswith("_"):
            self._expect_key(key, AttributeError)
            value = _made(self._tables.get(key), value)
        object.__setattr__(self, key, value)

    def __delattr__(self, key: str) -> None:
        """A key that is deleted is not given, as one that is None."""
        setattr(self, key, None)

    def _items(self) -> Iterator[tuple[str, Any]]:
        for key in self._keys:
            value = getattr(self, key)
            if value is not None:
                yield key.removesuffix("_"), value

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and plain(self) == plain(other)

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in self._items())})"


T = TypeVar("T")


class Tables(list[T]):
    """Tables of one kind in their order, by number or by name: scene.ligaments["aACL"]."""

    def __getitem__(self, key: Any) -> Any:
        return list.__getitem__(self, self._place(key))

    def __setitem__(self, key: Any, table: Any) -> None:
        list.__setitem__(self, self._place(key), table)

    def __delitem__(self, key: Any) -> None:
        list.__delitem__(self, self._place(key))

    def _place(self, key: Any) -> Any:
        """The number that a name stands for."""
        if not isinstance(key, str):
            return key
        names = [getattr(table, "name", None) for table in self]
        if key in names:
            return names.index(key)
        near = difflib.get_close_matches(key, [str(name) for name in names], 1)
        raise KeyError(key + (f', did you mean "{near[0]}"?' if near else ""))


def _made(kind: Any, value: Any) -> Any:
    """Dicts become the tables that they stand for."""
    if kind is None or value is None:
        return value
    if isinstance(kind, list):
        if isinstance(value, (Mapping, Table, str)) or not hasattr(value, "__iter__"):
            return value  # the reader will say what is wrong
        return Tables(_made(kind[0], item) for item in value)
    if isinstance(value, Mapping):
        return kind(**value)
    return value


def plain(value: Any) -> Any:
    """For comparisons: arrays are lists, tables dicts."""
    if isinstance(value, Table):
        value = dict(value._items())
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    return value.tolist() if hasattr(value, "tolist") else value


def inline(value: Any, place: str) -> str:
    """A value on one line of TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return repr(int(value))
    if isinstance(value, float):
        return repr(float(value))
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007F")
    if isinstance(value, os.PathLike):
        return inline(os.fspath(value), place)
    if isinstance(value, Table):
        value = dict(value._items())
    if isinstance(value, Mapping):
        keys = (f"{inline(str(key), place)} = {inline(item, f'{place}.{key}')}" for key, item in value.items() if item is not None)
        return "{ " + ", ".join(keys) + " }"
    if hasattr(value, "tolist"):  # numpy's arrays and numbers
        return inline(value.tolist(), place)
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(inline(item, f"{place}[{i}]") for i, item in enumerate(value)) + "]"
    raise TypeError(f"{place}: {type(value).__name__}, expected a text, a number, a list or a table")
