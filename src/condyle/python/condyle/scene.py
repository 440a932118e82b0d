"""Scenes built in Python or read from a file.

Nothing is checked here: a scene is written as TOML and read by the reader of scene files, whose line an InputError has.
"""

from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator
from typing import Any, Optional, Union

from ._condyle import InputError, ParsedScene, scene_text, write_scene_text
from .described import (Body, Calibrate, Condition, Contact, Joint, Laxity, Ligament, Load, Simulate, Surface, Sweep, Units,
                        Wrap)
from .tables import Table, Tables, inline, plain


class Scene(Table):
    """A knee as a scene file describes it: title, units, joint, sweep, laxity, simulate, calibrate, and lists of bodies,
    surfaces, contacts, wraps, ligaments, conditions and loads (its tables [[body]], [[surface]] ...).

    Scene(units=Units(length="mm", angle="deg", force="N"), bodies=[Body("femur", fixed=True), ...], ...). Lists go by name
    as well: scene.ligaments["aACL"].slack_length = 31. It is read, with all its checks, where it is used: fit, Model, sweep,
    check().
    """

    title: str
    units: Units
    bodies: Tables[Body]
    joint: Joint
    surfaces: Tables[Surface]
    contacts: Tables[Contact]
    wraps: Tables[Wrap]
    ligaments: Tables[Ligament]
    conditions: Tables[Condition]
    loads: Tables[Load]
    sweep: Sweep
    laxity: Laxity
    simulate: Simulate
    calibrate: Calibrate

    def __init__(self, *, folder: Union[str, os.PathLike] = ".", **keys: Any) -> None:
        """`folder`: where paths of meshes start."""
        self._file = os.path.join(os.fspath(folder), "<Scene>")
        self._folder = _working_folder()  # where its file is told from
        self._read: Optional[tuple[str, Any]] = None  # the text that it was read from, and what that said
        super().__init__(**keys)

    @classmethod
    def from_text(cls, text: str, folder: Union[str, os.PathLike] = ".", *, check: bool = True) -> Scene:
        """A scene from TOML; paths of meshes start at `folder`. Raises InputError, unless it is not to be checked."""
        if not isinstance(text, str):
            raise TypeError(f"text: {type(text).__name__}, expected a scene as TOML")
        return cls._from(text, os.path.join(os.fspath(folder), "<text>"), check)

    @classmethod
    def _from(cls, text: str, file: str, check: bool) -> Scene:
        if check:
            ParsedScene(_utf8(text), file, True, {}, {})
        try:
            tables = tomllib.loads(text.removeprefix("\ufeff"))
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"{file}: {error}, expected TOML") from None
        scene = cls(**{_PLURALS.get(key, key): value for key, value in tables.items()})
        scene._file = file
        scene._read = (text, plain(scene))
        return scene

    def check(self) -> None:
        """Read it as a scene file. Raises InputError for what is wrong with it."""
        self._parsed()

    def to_toml(self) -> str:
        """The scene as a file has it. Raises InputError where it has a law or a load that is a function."""
        return self._text(functions_too=False)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Write it to a file. Relative paths of meshes and measurements are told from the folder of that file, where it is
        another one than that of the scene. Raises InputError where the file cannot be written."""
        write_scene_text(_utf8(self.to_toml()), self._place(), path)

    def _place(self) -> str:
        """Its file, from where we are now."""
        return self._file if self._folder == _working_folder() else os.path.join(self._folder, self._file)

    def _text(self, functions_too: bool) -> str:
        return self._read[0] if self._read is not None and self._is_as_read() else self._toml(functions_too)

    def _is_as_read(self) -> bool:
        return self._read is not None and self._read[1] == plain(self)

    def _toml(self, functions_too: bool) -> str:
        lines, tables = [], []
        for key, value in self._items():
            name = _SINGULARS.get(key, key)
            if isinstance(value, Table):
                tables.append(f"\n[{name}]\n" + _lines(value, name, functions_too))
            elif key in _SINGULARS:
                tables += [f"\n[[{name}]]\n" + _lines(table, name, functions_too) for table in value]
            else:
                lines.append(f"{name} = {inline(value, name)}\n")
        return "".join(lines + tables)

    def _parsed(self) -> ParsedScene:
        """As the reader understands it, with its functions."""
        text = self._text(functions_too=True)
        file = self._place()
        if self._read is not None and not self._is_as_read():
            file = os.path.join(os.path.dirname(file), "<Scene>")
        laws = {ligament.name: ligament.law for ligament in self.ligaments or () if _is_function(ligament.law)}
        loads = {load.name: load.function for load in self.loads or () if load.function is not None}
        return ParsedScene(_utf8(text), file, True, laws, loads)


_PLURALS = {"body": "bodies", "surface": "surfaces", "contact": "contacts", "wrap": "wraps", "ligament": "ligaments",
            "condition": "conditions", "load": "loads"}
_SINGULARS = {plural: singular for singular, plural in _PLURALS.items()}

_NUMBERS_OF_LAWS = ("stiffness", "transition_strain", "slack_length", "reference_strain", "reference_length", "coefficients",
                    "tension_only", "lengths", "forces")

Scene._tables = {"units": Units, "bodies": [Body], "joint": Joint, "surfaces": [Surface], "contacts": [Contact],
                 "wraps": [Wrap], "ligaments": [Ligament], "conditions": [Condition], "loads": [Load], "sweep": Sweep,
                 "laxity": Laxity, "simulate": Simulate, "calibrate": Calibrate}


def read_scene(path: Union[str, os.PathLike]) -> Scene:
    """Read a scene file (TOML, docs/scene.md). Returns a Scene; raises InputError for what is wrong with the file."""
    return Scene._from(*scene_text(path), check=False)


def _is_function(value: Any) -> bool:
    return value is not None and not isinstance(value, str)


def _lines(table: Any, place: str, functions_too: bool) -> str:
    """The keys of a table, one each line."""
    if not isinstance(table, Table):
        raise TypeError(f"{place}: {type(table).__name__}, expected a table, as condyle.{place.capitalize()}")
    place = f"{place} {table.name!r}" if getattr(table, "name", None) else place
    return "".join(f"{key} = {inline(value, f'{place}: {key}')}\n" for key, value in _file_items(table, place, functions_too))


def _file_items(table: Table, place: str, functions_too: bool) -> Iterator[tuple[str, Any]]:
    """What a file says of a table. Functions are put in once it is read: till then a law is 0, a load nothing."""
    own_load = isinstance(table, Load) and table.function is not None
    if isinstance(table, Ligament) and _is_function(table.law):
        beside = [key for key in _NUMBERS_OF_LAWS if getattr(table, key) is not None]
        if beside:
            raise InputError(f"{place}: law is a function, expected no {beside[0]} = {getattr(table, beside[0])!r} beside it")
    for key, value in table._items():
        own = (isinstance(table, Ligament) and key == "law" and _is_function(value)) or key == "function"
        if own and not functions_too:
            raise InputError(f"{place}: {key} is a function, expected none: a file cannot hold it")
        if own and key == "law":
            yield "law", "polynomial"
            yield "coefficients", [0.0]
        elif not own:
            yield key, value
    if own_load:
        yield from ((key, value) for key, value in (("kind", "force"), ("vector", [0.0, 0.0, 0.0]))
                    if getattr(table, key) is None)


def _working_folder() -> str:
    try:
        return os.getcwd()
    except FileNotFoundError:  # it is gone
        return ""


def _utf8(text: str) -> str:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as error:
        raise InputError(f"text: {error.reason} at {error.start}, expected Unicode") from None
    return text
