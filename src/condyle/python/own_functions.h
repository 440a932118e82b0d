#pragma once

/// Force laws and loads that the user writes: Python callables, which take the interpreter's lock for each call, and C
/// functions, which do not.
///
///   law   Python: law(length) -> (force [N], slope [N/mm], energy [N mm]), length in mm
///         C:      void law(double length, double out[3], void* user)
///   load  Python: load(translation, rotation) -> (force, moment) or (force, moment, derivatives)
///         C:      void load(const double pose[12], double out[42], void* user)
///
/// A pose is the translation of the moving body's origin [mm] and its rotation by rows, in the ground frame; a load is
/// force [N] and moment about that origin [N mm], ground frame; its derivatives, 6 x 6 by rows, are those of (force,
/// moment) by (translation, rotation vector): dR = [dπ]x R. Without derivatives they are taken by central differences.
///
/// A C function is a ctypes function (CFUNCTYPE), a numba cfunc, a PyCapsule of the pointer, with the user's pointer as
/// its context, or cffi's pointer as an int wrapped in a capsule. Whatever keeps it alive has to stay: the object given is kept.

#include <pybind11/pybind11.h>

#include <string>

#include "condyle/elements/force_law.h"
#include "condyle/python/knee.h"

namespace condyle::python {

/// `owner` names it in errors: '[[ligament]] "aACL": law'. Throws TypeError for what is neither.
/// What the function raises comes through; a result of another shape is a TypeError, one that is not finite an InputError.
[[nodiscard]] CustomLaw own_law(const pybind11::object& function, const std::string& owner);
[[nodiscard]] OwnLoad own_load(const pybind11::object& function, const std::string& owner);

}  // namespace condyle::python
