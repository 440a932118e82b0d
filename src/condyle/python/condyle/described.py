"""The tables of a scene file (docs/scene.md), with its keys as names.

Numbers are in the units that the scene declares (Units); arrays may be numpy's. What is left out, or None, is not written.
A dict does wherever a table stands.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Union

from .tables import Table, Tables

Number = Union[float, int]
Numbers = Sequence[Number]
Function = Callable[..., Any]


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
    start: Start
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
    femur: Frame
    tibia: Frame


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
    region: Region
    offset: Number
    mesh: Union[str, os.PathLike]
    mesh_units: str
    fit: Fit
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
    ends: Tables[End]
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
    ends: Tables[End]


class Load(Table):
    """[[load]] on the moving body: name, body, kind "force" or "moment", vector (3,) [force, or force times length], at (3,)
    [length], follows "ground" or "body", scale.

    Or function, a load of your own in place of kind, vector, at and follows: function(translation, rotation) -> (force, moment) or
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
    ends: Tables[End]
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
    drive: Tables[Drive]
    damper: Tables[Damper]


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
    load: Tables[CalibrateLoad]
    parameter: Tables[CalibrateParameter]


_ENDS = [End]
Body._tables = {"start": Start}
Joint._tables = {"femur": Frame, "tibia": Frame}
Surface._tables = {"region": Region, "fit": Fit}
Ligament._tables = Condition._tables = Damper._tables = {"ends": _ENDS}
Simulate._tables = {"drive": [Drive], "damper": [Damper]}
Calibrate._tables = {"load": [CalibrateLoad], "parameter": [CalibrateParameter]}
