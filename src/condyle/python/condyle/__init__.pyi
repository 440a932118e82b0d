from enum import IntEnum

from ._condyle import Group as Group, InputError as InputError, Model as Model, Pose as Pose, Run as Run, Solver as Solver
from ._condyle import Surfaces as Surfaces, __version__ as __version__, build_info as build_info, fit as fit
from ._condyle import calibrate as calibrate, compare as compare, laxity as laxity, open_run as open_run, simulate as simulate
from ._condyle import Study as Study, open_study as open_study, study as study
from .described import Body as Body, Calibrate as Calibrate, CalibrateLoad as CalibrateLoad, CalibrateParameter as CalibrateParameter, Condition as Condition, Contact as Contact
from .described import Damper as Damper, Drive as Drive, End as End, Fit as Fit, Frame as Frame, Joint as Joint
from .described import Laxity as Laxity, Ligament as Ligament, Load as Load, Region as Region, Simulate as Simulate, Start as Start
from .described import Surface as Surface, Sweep as Sweep, Units as Units, Wrap as Wrap
from .made_scenes import fitted_scene as fitted_scene, new_scene as new_scene
from .scene import Scene as Scene, read_scene as read_scene
from .sweeps import sweep as sweep
from .tables import Table as Table, Tables as Tables

class Status(IntEnum):
    CONVERGED = 0
    ITERATION_LIMIT = 1
    DIVERGED = 2
    SINGULAR = 3
    LEFT_PATCH = 4
    NO_EQUILIBRIUM = 5
    ZERO_LENGTH = 6
    OVERLAP = 7
    NOT_COMPUTED = 8
    NO_PATH = 9
