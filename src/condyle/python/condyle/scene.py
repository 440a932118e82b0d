"""Scenes built in Python: one class for each table of a scene file (docs/scene.md), with its keys as names.

Nothing is checked here but the names: a scene is written as TOML and read by the reader of scene files, whose line an
InputError has. Numbers are in the units that the scene declares (Units); arrays may be numpy's. What is left out, or None,
is not written. A dict does wherever a table stands.
"""

from __future__ import annotations

import difflib
import json
import os
import tomllib
from typing import Any, Callable, Iterator, Mapping, Optional, Sequence, Union

from ._condyle import InputError, ParsedScene, scene_text

Number = Union[float, int]
Numbers = Sequence[Number]
Function = Callable[..., Any]


class Table:
    """A table of a scene file: keywords are its keys, None is left out. Compare, copy and pickle as usual."""

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

    def _items(self) -> Iterator[tuple[str, Any]]:
        for key in self._keys:
            value = getattr(self, key)
            if value is not None:
                yield key.removesuffix("_"), value

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and _inline(self, "") == _inline(other, "")

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{key}={value!r}' for key, value in self._items())})"


class Tables(list):
    """Tables of one kind in their order, by number or by name: scene.ligaments["aACL"]."""

    def __getitem__(self, key: Any) -> Any:
        if not isinstance(key, str):
            return list.__getitem__(self, key)
        names = [getattr(table, "name", None) for table in self]
        if key in names:
            return list.__getitem__(self, names.index(key))
        near = difflib.get_close_matches(key, [str(name) for name in names], 1)
        raise KeyError(f"{key!r}" + (f', did you mean "{near[0]}"?' if near else ""))


class Units(Table):
    """[units]: length "mm", "cm" or "m"; angle "deg" or "rad"; force "N"."""

    length: str
    angle: str
    force: str


class Start(Table):
    """Start pose of the moving body: translation (3,) [length], and rotation (3,), a vector, or the joint angles [angle]."""

    translation: Numbers
    rotation: Numbers
    flexion: Number
    adduction: Number
    internal_rotation: Number


class Body(Table):
    """[[body]]: name; fixed (one is, the other moves); mesh, a file, in mesh_units; start, a Start; and for motions
    density [kg/length³], or mass [kg], center (3,) [length], inertia (3, 3) [kg length²]."""

    name: str
    fixed: bool
    mesh: Union[str, os.PathLike]
    mesh_units: str
    start: Union[Start, Mapping[str, Any]]
    density: Number
    mass: Number
    center: Numbers
    inertia: Sequence[Numbers]


class Frame(Table):
    """An anatomical frame: body, origin (3,) [length], and the unit vectors lateral, anterior, proximal (3,)."""

    body: str
    origin: Numbers
    lateral: Numbers
    anterior: Numbers
    proximal: Numbers


class Joint(Table):
    """[joint]: side, "right" or "left", and the frames femur and tibia, each a Frame."""

    side: str
    femur: Union[Frame, Mapping[str, Any]]
    tibia: Union[Frame, Mapping[str, Any]]


class Region(Table):
    """Which part of a mesh a patch covers: box, two corners (2, 3) [length]; angles (2,) [angle]; least_cosine."""

    box: Sequence[Numbers]
    angles: Numbers
    least_cosine: Number


class Fit(Table):
    """How a patch is fitted: control_points "auto" or (2,); smoothing "auto", "position" or a length; degree 3 to 5."""

    control_points: Union[str, Sequence[int]]
    smoothing: Union[str, Number]
    degree: int


class Surface(Table):
    """[[surface]]: name, body, kind and the keys of that kind.

    kind "patch": compartment, region (a Region), offset [length], mesh, mesh_units, fit (a Fit); "plane": point, normal,
    radius; "sphere": center, radius; "cylinder": point, axis, radius, length; "ellipsoid": center, semi_axes, axes; "torus":
    center, axis, major, minor; "polynomial": coefficients [[i, j, a], ...], frame {origin, axes}, radius. solid "inside" or
    "outside". modulus [force/length²], poisson, layer [length]: soft. Points (3,) and radii in the scene's length.
    """

    name: str
    body: str
    kind: str
    solid: str
    compartment: str
    region: Union[Region, Mapping[str, Any]]
    offset: Number
    mesh: Union[str, os.PathLike]
    mesh_units: str
    fit: Union[Fit, Mapping[str, Any]]
    point: Numbers
    normal: Numbers
    center: Numbers
    axis: Numbers
    radius: Number
    length: Number
    semi_axes: Numbers
    axes: Union[Numbers, Sequence[Numbers]]
    major: Number
    minor: Number
    coefficients: Sequence[Numbers]
    frame: Mapping[str, Any]
    modulus: Number
    poisson: Number
    layer: Number


class Contact(Table):
    """[[contact]]: name, surfaces (two names); state "auto", "closed" or "open"; start, points (k, 3) [length]; law "rigid" or
    "layer", the latter with pressure "linear" or "logarithmic", tolerance and lost_force (parts of the force)."""

    name: str
    surfaces: Sequence[str]
    state: str
    start: Sequence[Numbers]
    law: str
    pressure: str
    tolerance: Number
    lost_force: Number


class End(Table):
    """An end of a ligament, condition or damper: body, and at (3,) [length] in the frame of that body."""

    body: str
    at: Numbers


class Ligament(Table):
    """[[ligament]]: name, ends (two End), law.

    law "toe-linear": stiffness [force per unit strain], transition_strain, and slack_length [length], or reference_strain,
    alone or with reference_length; "quadratic": stiffness [force/length²] and one of the same; "polynomial": coefficients,
    tension_only; "table": lengths, forces. Or a function of your own: law(length) -> (force, slope, energy), in mm, N, N/mm,
    N mm; the energy's slope is the force. A Python function is called under the interpreter's lock, hundreds of times a
    pose; a C function is not: void f(double length, double out[3], void* user), as a ctypes CFUNCTYPE, a numba cfunc or a
    PyCapsule whose context is `user`. Wrapped: wraps (names), side (3,) or (k, 3), inside "anchor" or "straight", thickness.
    """

    name: str
    ends: Sequence[Union[End, Mapping[str, Any]]]
    law: Union[str, Function]
    stiffness: Number
    transition_strain: Number
    slack_length: Number
    reference_strain: Number
    reference_length: Number
    coefficients: Numbers
    tension_only: bool
    lengths: Numbers
    forces: Numbers
    wraps: Sequence[str]
    side: Union[Numbers, Sequence[Numbers]]
    inside: str
    thickness: Number


class Wrap(Table):
    """[[wrap]]: name, body, kind "sphere", "cylinder", "ellipsoid" or "torus" with the keys of such a surface; or fit "bone",
    with the names of the ligaments that lead it."""

    name: str
    body: str
    kind: str
    center: Numbers
    radius: Number
    point: Numbers
    axis: Numbers
    axes: Union[Numbers, Sequence[Numbers]]
    semi_axes: Numbers
    major: Number
    minor: Number
    fit: str
    ligaments: Sequence[str]


class Condition(Table):
    """[[condition]]: name, kind ("flexion", "adduction", "internal_rotation", "lateral_shift", "anterior_drawer",
    "distraction", "translation", "rotation", "distance"), value [angle or length]; axis; ends (two End)."""

    name: str
    kind: str
    value: Number
    axis: Union[str, Numbers]
    ends: Sequence[Union[End, Mapping[str, Any]]]


class Load(Table):
    """[[load]] on the moving body: name, body, kind "force" or "moment", vector (3,) [force, or force times length], at (3,)
    [length], follows "ground" or "body", scale.

    Or function, a load of your own in place of kind and vector: function(translation, rotation) -> (force, moment) or
    (force, moment, derivatives): translation (3,) [mm] and rotation (3, 3) of the moving body in the ground frame; force
    (3,) [N] and moment (3,) [N mm] about its origin, ground frame; derivatives (6, 6) of (force, moment) by translation and
    rotation vector, else taken by differences. As C: void f(const double pose[12], double out[42], void* user), with them.
    """

    name: str
    body: str
    kind: str
    vector: Numbers
    at: Numbers
    follows: str
    scale: Number
    function: Function


class Sweep(Table):
    """[sweep]: vary, the name of a condition or NAME.scale of a load; from_, to, step, or values [angle, length or 1]; path
    "steps" or "arc length"; sensitivities, names of numbers."""

    vary: str
    from_: Number
    to: Number
    step: Number
    values: Numbers
    path: str
    sensitivities: Sequence[str]


class Laxity(Table):
    """[laxity]: flexion (n,) [angle] at which the swept load goes over its values; cut, names of ligaments left out the
    second time."""

    flexion: Numbers
    cut: Sequence[str]


class Drive(Table):
    """How the scale of a load goes over time: load; shape "pulse" (start, duration [s]), "decaying sine" (start [s],
    frequency [1/s], decay [1/s]) or "table" (times [s], factors)."""

    load: str
    shape: str
    start: Number
    duration: Number
    frequency: Number
    decay: Number
    times: Numbers
    factors: Numbers


class Damper(Table):
    """A damper between the bodies: name, ends (two End), coefficient [force s/length]."""

    name: str
    ends: Sequence[Union[End, Mapping[str, Any]]]
    coefficient: Number


class Simulate(Table):
    """[simulate]: time [s], rate [1/s], gravity (3,) [length/s²], flexion [angle], flexion_velocity [angle/s], hold (names of
    conditions), restitution, tolerance, viscous_time [s], drive (Drive), damper (Damper)."""

    time: Number
    rate: Number
    gravity: Numbers
    flexion: Number
    flexion_velocity: Number
    hold: Sequence[str]
    restitution: Number
    tolerance: Number
    viscous_time: Number
    drive: Sequence[Union[Drive, Mapping[str, Any]]]
    damper: Sequence[Union[Damper, Mapping[str, Any]]]


class CalibrateLoad(Table):
    """[[calibrate.load]]: name in the table of measurements, and the load, or the condition, that it means."""

    name: str
    load: str
    condition: str


class CalibrateParameter(Table):
    """[[calibrate.parameter]]: of (names), what, prior_sd, normal_sd, bounds (2,), together."""

    of: Union[str, Sequence[str]]
    what: str
    prior_sd: Number
    normal_sd: Number
    bounds: Numbers
    together: bool


class Calibrate(Table):
    """[calibrate]: measurements (a CSV file), specimen, moment (unit of moments there), relative (names of curves), huber,
    curve_sd (2,), frame_sd {femur, tibia}, flexion_sd, level_sd, starts, samples, seed, load (CalibrateLoad), parameter
    (CalibrateParameter)."""

    measurements: Union[str, os.PathLike]
    specimen: str
    moment: str
    relative: Sequence[str]
    huber: Number
    curve_sd: Numbers
    frame_sd: Mapping[str, Numbers]
    flexion_sd: Number
    level_sd: Number
    starts: int
    samples: int
    seed: int
    load: Sequence[Union[CalibrateLoad, Mapping[str, Any]]]
    parameter: Sequence[Union[CalibrateParameter, Mapping[str, Any]]]


class Scene(Table):
    """A knee as a scene file describes it: title, units, joint, sweep, laxity, simulate, calibrate, and lists of bodies,
    surfaces, contacts, wraps, ligaments, conditions and loads (its tables [[body]], [[surface]] ...).

    Scene(units=Units(length="mm", angle="deg", force="N"), bodies=[Body("femur", fixed=True), ...], ...). Lists go by name
    as well: scene.ligaments["aACL"].slack_length = 31. It is read, with all its checks, where it is used: fit, Model, sweep,
    check().
    """

    title: str
    units: Union[Units, Mapping[str, Any]]
    bodies: Sequence[Union[Body, Mapping[str, Any]]]
    joint: Union[Joint, Mapping[str, Any]]
    surfaces: Sequence[Union[Surface, Mapping[str, Any]]]
    contacts: Sequence[Union[Contact, Mapping[str, Any]]]
    wraps: Sequence[Union[Wrap, Mapping[str, Any]]]
    ligaments: Sequence[Union[Ligament, Mapping[str, Any]]]
    conditions: Sequence[Union[Condition, Mapping[str, Any]]]
    loads: Sequence[Union[Load, Mapping[str, Any]]]
    sweep: Union[Sweep, Mapping[str, Any]]
    laxity: Union[Laxity, Mapping[str, Any]]
    simulate: Union[Simulate, Mapping[str, Any]]
    calibrate: Union[Calibrate, Mapping[str, Any]]

    def __init__(self, *, folder: Union[str, os.PathLike] = ".", **keys: Any) -> None:
        """`folder`: where paths of meshes start."""
        self._file = os.path.join(os.fspath(folder), "<Scene>")
        self._read: Optional[tuple[str, str, str]] = None  # text and path of a file, and itself as TOML
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
            tables = tomllib.loads(text)
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"{file}: {error}, expected TOML") from None
        scene = cls(**{_PLURALS.get(key, key): value for key, value in tables.items()})
        scene._file = file
        scene._read = (text, file, scene._toml(functions_too=False))
        return scene

    def check(self) -> None:
        """Read it as a scene file. Raises InputError for what is wrong with it."""
        self._parsed()

    def to_toml(self) -> str:
        """The scene as a file has it. Raises InputError where it has a law or a load that is a function."""
        return self._text(functions_too=False)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Write it to a file, of which paths of meshes are taken from its folder: they are written as they are."""
        text = self.to_toml()
        with open(path, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)

    def _text(self, functions_too: bool) -> str:
        text = self._toml(functions_too)
        return self._read[0] if self._read is not None and self._read[2] == text else text

    def _toml(self, functions_too: bool) -> str:
        lines, tables = [], []
        for key, value in self._items():
            name = _SINGULARS.get(key, key)
            if isinstance(value, Table):
                tables.append(f"\n[{name}]\n" + _lines(value, name, functions_too))
            elif key in _SINGULARS:
                tables += [f"\n[[{name}]]\n" + _lines(table, name, functions_too) for table in value]
            else:
                lines.append(f"{name} = {_inline(value, name)}\n")
        return "".join(lines + tables)

    def _parsed(self) -> ParsedScene:
        """As the reader understands it, with its functions."""
        file = self._file
        if self._read is not None and not self._is_as_read():
            file = os.path.join(os.path.dirname(file), "<Scene>")
        laws = {ligament.name: ligament.law for ligament in self.ligaments or () if _is_function(ligament.law)}
        loads = {load.name: load.function for load in self.loads or () if load.function is not None}
        return ParsedScene(_utf8(self._text(functions_too=True)), file, True, laws, loads)

    def _is_as_read(self) -> bool:
        return self._read is not None and self._read[2] == self._toml(functions_too=True)


_PLURALS = {"body": "bodies", "surface": "surfaces", "contact": "contacts", "wrap": "wraps", "ligament": "ligaments",
            "condition": "conditions", "load": "loads"}
_SINGULARS = {plural: singular for singular, plural in _PLURALS.items()}

_ENDS = [End]
Body._tables = {"start": Start}
Joint._tables = {"femur": Frame, "tibia": Frame}
Surface._tables = {"region": Region, "fit": Fit}
Ligament._tables = Condition._tables = Damper._tables = {"ends": _ENDS}
Simulate._tables = {"drive": [Drive], "damper": [Damper]}
Calibrate._tables = {"load": [CalibrateLoad], "parameter": [CalibrateParameter]}
Scene._tables = {"units": Units, "bodies": [Body], "joint": Joint, "surfaces": [Surface], "contacts": [Contact],
                 "wraps": [Wrap], "ligaments": [Ligament], "conditions": [Condition], "loads": [Load], "sweep": Sweep,
                 "laxity": Laxity, "simulate": Simulate, "calibrate": Calibrate}


def read_scene(path: Union[str, os.PathLike]) -> Scene:
    """Read a scene file (TOML, docs/scene.md). Returns a Scene; raises InputError for what is wrong with the file."""
    return Scene._from(*scene_text(path), check=False)


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


def _is_function(value: Any) -> bool:
    return value is not None and not isinstance(value, str)


def _lines(table: Any, place: str, functions_too: bool) -> str:
    """The keys of a table, one each line."""
    if not isinstance(table, Table):
        raise TypeError(f"{place}: {type(table).__name__}, expected a table, as condyle.{place.capitalize()}")
    place = f"{place} {table.name!r}" if getattr(table, "name", None) else place
    return "".join(f"{key} = {_inline(value, f'{place}: {key}')}\n" for key, value in _file_items(table, place, functions_too))


def _file_items(table: Table, place: str, functions_too: bool) -> Iterator[tuple[str, Any]]:
    """What a file says of a table. Functions are put in once it is read: till then a law is 0, a load nothing."""
    own_load = isinstance(table, Load) and table.function is not None
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


def _inline(value: Any, place: str) -> str:
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
        return _inline(os.fspath(value), place)
    if isinstance(value, Table):
        value = dict(value._items())
    if isinstance(value, Mapping):
        keys = (f"{_inline(str(key), place)} = {_inline(item, f'{place}.{key}')}" for key, item in value.items() if item is not None)
        return "{ " + ", ".join(keys) + " }"
    if hasattr(value, "tolist"):  # numpy's arrays and numbers
        return _inline(value.tolist(), place)
    if isinstance(value, (list, tuple, range)):
        return "[" + ", ".join(_inline(item, f"{place}[{i}]") for i, item in enumerate(value)) + "]"
    raise TypeError(f"{place}: {type(value).__name__}, expected a text, a number, a list or a table")


def _utf8(text: str) -> str:
    try:
        text.encode("utf-8")
    except UnicodeEncodeError as error:
        raise InputError(f"text: {error.reason} at {error.start}, expected Unicode") from None
    return text
