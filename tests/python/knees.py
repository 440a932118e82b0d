"""Small knees that tests share: exact surfaces, no mesh."""

import os
import pathlib

import condyle
from condyle import Body, Condition, Contact, End, Ligament, Load, Scene, Start, Surface, Sweep, Units

SOURCE = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CONDYLE_PROGRAM", str(SOURCE / "build" / "condyle"))
PHANTOM = SOURCE / "data" / "phantom" / "knee.toml"

_phantom = []


def phantom() -> "condyle.Model":
    """The shipped phantom, fitted once."""
    if not _phantom:
        _phantom.append(condyle.Model(condyle.read_scene(PHANTOM)))
    return _phantom[0]


def spring(force=5.0, **ligament) -> Scene:
    """A body that hangs on a line element along x, pulled by a force: every other motion is prescribed.

    The element's end on the ground is at the origin, that on the body at its origin; x is the length. Its law is
    100 N/mm (L - 10 mm), unless another is given."""
    law = {} if "law" in ligament else {"law": "polynomial", "coefficients": [-1000, 100]}
    return Scene(
        title="A spring",
        units=Units(length="mm", angle="deg", force="N"),
        bodies=[Body("ground", fixed=True), Body("weight", start=Start(translation=[11, 0, 0]))],
        ligaments=[Ligament("spring", ends=[End(body="ground", at=[0, 0, 0]), End(body="weight", at=[0, 0, 0])],
                            **law, **ligament)],
        conditions=[Condition("y", kind="translation", axis="y", value=0), Condition("z", kind="translation", axis="z", value=0),
                    Condition("a", kind="rotation", axis="x", value=0), Condition("b", kind="rotation", axis="y", value=0),
                    Condition("c", kind="rotation", axis="z", value=0)],
        loads=[Load("pull", body="weight", kind="force", vector=[force, 0, 0])],
        sweep=Sweep(vary="pull.scale", values=[0, 1, 2]))


def ball_on_ball(force=100.0) -> Scene:
    """A ball of radius 20 pressed on one of radius 30: they touch where the line of centres says."""
    return Scene(
        title="Two balls",
        units=Units(length="mm", angle="deg", force="N"),
        bodies=[Body("low", fixed=True), Body("high", start=Start(translation=[0, 52, 0]))],
        surfaces=[Surface("low ball", body="low", kind="sphere", center=[0, 0, 0], radius=30),
                  Surface("high ball", body="high", kind="sphere", center=[0, 0, 0], radius=20)],
        contacts=[Contact("balls", surfaces=["low ball", "high ball"])],
        conditions=[Condition("x", kind="translation", axis="x", value=0), Condition("z", kind="translation", axis="z", value=0),
                    Condition("a", kind="rotation", axis="x", value=0), Condition("b", kind="rotation", axis="y", value=0),
                    Condition("c", kind="rotation", axis="z", value=0)],
        loads=[Load("press", body="high", kind="force", vector=[0, -force, 0])],
        sweep=Sweep(vary="x", values=[0, 5, 10]))
