"""Positions of equilibrium of the knee: what contacts, ligaments and loads make of it, pose by pose.

    import condyle
    scene = condyle.read_scene("data/phantom/knee.toml")
    run = condyle.sweep(scene)                    # a Run: numpy arrays
    print(run.values, run.ligaments["aACL"].force)
    run.save("run.h5")                            # what `condyle sweep` writes; condyle.open_run reads it

A scene can also be built of Scene, Body, Surface, Contact, Ligament ..., with the names of the scene file
(docs/scene.md). `fit` fits its surfaces, a Model is a knee that any number of threads share, a Solver is the workspace
of one thread.

Given are numbers in the units that the scene declares; results are in mm, N, N mm and deg. Bad input raises InputError, a
ValueError with the line that the program prints; a pose that is not found is a status (Status), never an exception.
"""

from enum import IntEnum as _IntEnum
from types import ModuleType as _Module

from ._condyle import (Group, InputError, Model, Pose, Run, Solver, Study, Surfaces, __version__, _status_names, build_info,
                       calibrate, compare, fit, laxity, open_run, open_study, simulate, study)
from .described import (Body, Calibrate, CalibrateLoad, CalibrateParameter, Condition, Contact, Damper, Drive, End, Fit, Frame,
                        Joint, Laxity, Ligament, Load, Region, Simulate, Start, Surface, Sweep, Units, Wrap)
from .made_scenes import fitted_scene, new_scene
from .keywords import named as _named
from .scene import Scene, read_scene
from .sweeps import sweep
from .tables import Table, Tables

calibrate, compare, fit, laxity, simulate, study = map(_named, (calibrate, compare, fit, laxity, simulate, study))
open_run, open_study = map(_named, (open_run, open_study))
for _class in (Model, Solver):
    _class.__init__ = _named(_class.__init__, _class.__name__)

Status = _IntEnum("Status", {name.upper().replace(" ", "_"): i for i, name in enumerate(_status_names)}, module=__name__)
Status.__doc__ = """How the search for a pose ended: CONVERGED is 0, the others say why there is no pose.

The values are those of Run.status and of /sweep/status in a result file; LEFT_PATCH has numbers all the same, of surfaces
extrapolated beyond what is known of them."""

__all__ = [name for name, _thing in list(globals().items())
           if not name.startswith("_") and not isinstance(_thing, _Module)] + ["__version__"]

# Their home is here, wherever they are written.
for _name in __all__:
    if hasattr(globals()[_name], "__module__"):
        globals()[_name].__module__ = __name__
