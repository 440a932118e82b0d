"""What a calibration leaves behind."""

from __future__ import annotations

from ._condyle import Run, fitted_scene_text
from .scene import Scene


def fitted_scene(run: Run) -> Scene:
    """The scene of a calibration with the fitted numbers in place of its own: what `condyle calibrate --scene` writes.

    run: of condyle.calibrate, or opened from a file of `condyle calibrate`. Comments and order of its text stay, only
    numbers of the knee change. Raises InputError for a run of another kind, or where a number has no place in the text.
    """
    if not isinstance(run, Run):
        raise TypeError(f"run: {type(run).__name__}, expected a condyle.Run")
    return Scene._from(*fitted_scene_text(run), check=True)
