"""Sweeps: positions of equilibrium over a range of a prescribed motion or of a load."""

from __future__ import annotations

import copy
from typing import Callable, Optional, Sequence, Union

from ._condyle import Model, Run, sweep_model
from .described import Sweep
from .scene import Scene


def sweep(scene: Union[Scene, Model], values: Optional[Sequence[float]] = None, *, vary: Optional[str] = None,
          path: Optional[str] = None, sensitivities: Optional[Sequence[str]] = None,
          progress: Optional[Callable[[int, int], object]] = None) -> Run:
    """Positions of equilibrium over a range, each from the one before it: what `condyle sweep` computes.

    scene: a Scene, of which a Model is made, or a Model.
    values: (n,) what is visited, in the scene's unit (deg, mm; 1 for a factor on a load); else those of its [sweep].
    vary: name of a condition, or NAME.scale of a load; else that of [sweep].
    path: "steps", or "arc length" to follow the path of equilibria through its limit points.
    sensitivities: numbers by which derivatives of each pose are wanted: ["aACL.reference_strain", "*.stiffness"].
    progress: a function of (done, total), called after each pose; total is 0 along an arc.

    Returns a Run with n poses. Raises InputError for bad input; a pose that is not found is a status. Other threads of
    Python go on meanwhile, and Ctrl-C ends it.
    """
    text = None
    if vary is not None or path is not None or sensitivities is not None:
        text = _with_sweep(scene, values, vary, path, sensitivities)
    return sweep_model(scene, values, text, progress)


def _with_sweep(scene, values, vary, path, sensitivities) -> str:
    """The text of the scene with another [sweep]."""
    described = Scene.from_text(scene.scene_text, check=False) if isinstance(scene, Model) else copy.copy(scene)
    asked = copy.copy(described.sweep) if described.sweep is not None else Sweep()
    if vary is not None:
        asked.vary = vary
    if path is not None:
        asked.path = path
    if sensitivities is not None:
        asked.sensitivities = sensitivities
    if values is not None:
        asked.values = values
        asked.from_ = asked.to = asked.step = None
    described.sweep = asked
    return described._text(functions_too=True)
