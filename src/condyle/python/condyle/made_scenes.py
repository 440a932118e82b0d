"""Scenes that are made of something else: of a calibration, or of two meshes."""

from __future__ import annotations

import os
from typing import Optional, Sequence, Union

from ._condyle import Run, fitted_scene_text, new_scene_text
from .scene import Scene

_Path = Union[str, os.PathLike]


def fitted_scene(run: Run) -> Scene:
    """The scene of a calibration with the fitted numbers in place of its own: what `condyle calibrate --scene` writes.

    run: of condyle.calibrate, or opened from a file of `condyle calibrate`. Comments and order of its text stay, only
    numbers of the knee change. Raises InputError for a run of another kind, or where a number has no place in the text.
    """
    if not isinstance(run, Run):
        raise TypeError(f"run: {type(run).__name__}, expected a condyle.Run")
    return Scene._from(*fitted_scene_text(run), check=True)


def new_scene(femur: _Path, tibia: _Path, template: _Path, *, cartilage: Sequence[_Path] = (), side: Optional[str] = None,
              units: Optional[str] = None, folder: _Path = ".") -> Scene:
    """A scene of two bones: unit, side and frames from their shape, ligaments and loads from a template; what `condyle new` makes.

    femur, tibia: meshes (STL, PLY, OBJ ...) in one frame and one unit, as a scanner gives them.
    template: the scene of a knee whose ligaments are carried over: data/phantom/knee.toml.
    cartilage: meshes of the femoral and the tibial cartilage, two where the sides of the tibia are apart.
    side: "right" or "left", units: "mm", "cm" or "m"; told from the shape where None.
    folder: from which paths of meshes are told.

    Returns a Scene; comments of its text (to_toml) say what was found and what to look at. Takes some seconds. Raises
    InputError for meshes that cannot be used or are no knee, and where it cannot tell, with what settles it.
    """
    return Scene._from(*new_scene_text(femur, tibia, template, cartilage, side, units, folder), check=True)
