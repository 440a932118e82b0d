#include "condyle/python/own_functions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <type_traits>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/python/arguments.h"

namespace condyle::python {
namespace {

using LawPointer = void (*)(double length, double* out, void* user);
using LoadPointer = void (*)(const double* pose, double* out, void* user);

/// Keeps a Python object; gives it back under the interpreter's lock, wherever that happens.
std::shared_ptr<py::object> kept(const py::object& object) {
  return {new py::object(object), [](py::object* held) {
            const py::gil_scoped_acquire lock;
            delete held;
          }};
}

template <typename Pointer>
struct CFunction {
  Pointer pointer = nullptr;
  void* user = nullptr;
};

/// Whether a ctypes function declares (first, pointer, pointer) -> nothing; a pointer is any that ctypes knows.
template <typename Pointer>
bool is_declared(const py::object& function, const py::module_& ctypes) {
  const py::object arguments = function.attr("argtypes");
  if (!function.attr("restype").is_none() || arguments.is_none() || py::len(arguments) != 3)
    return false;
  const py::object pointer = ctypes.attr("_Pointer"), address = ctypes.attr("c_void_p");
  const auto is_pointer = [&](int i) {
    const py::object type = arguments[py::int_(i)];
    return type.is(address) || PyObject_IsSubclass(type.ptr(), pointer.ptr()) == 1;
  };
  const bool first = std::is_same_v<Pointer, LawPointer>
                         ? py::object(arguments[py::int_(0)]).is(ctypes.attr("c_double"))
                         : is_pointer(0);
  return first && is_pointer(1) && is_pointer(2);
}

/// The address in a PyCapsule, a ctypes function, or a numba cfunc; null where the object is none of them.
template <typename Pointer>
CFunction<Pointer> c_function(const py::object& object, const std::string& owner) {
  void* address = nullptr;
  void* user = nullptr;
  if (PyCapsule_CheckExact(object.ptr()) != 0) {
    address = PyCapsule_GetPointer(object.ptr(), PyCapsule_GetName(object.ptr()));
    user = PyCapsule_GetContext(object.ptr());
    if (address == nullptr) throw py::error_already_set();
  } else if (py::hasattr(object, "_argtypes_") || py::hasattr(object, "argtypes")) {
    const py::module_ ctypes = py::module_::import("ctypes");
    if (!py::isinstance(object, ctypes.attr("_CFuncPtr"))) return {};
    if (!is_declared<Pointer>(object, ctypes))
      throw py::type_error(
          owner + ": a ctypes function of another declaration, expected " +
          (std::is_same_v<Pointer, LawPointer>
               ? "CFUNCTYPE(None, c_double, POINTER(c_double), c_void_p)"
               : "CFUNCTYPE(None, POINTER(c_double), POINTER(c_double), c_void_p)"));
    const py::object as_pointer = ctypes.attr("cast")(object, ctypes.attr("c_void_p"));
    address = PyLong_AsVoidPtr(py::object(as_pointer.attr("value")).ptr());
  } else if (py::hasattr(object, "address") && py::hasattr(object, "ctypes")) {  // numba.cfunc
    address = PyLong_AsVoidPtr(py::object(object.attr("address")).ptr());
  }
  PyErr_Clear();
  return {reinterpret_cast<Pointer>(address), user};
}

void check_callable(const py::object& function, const std::string& owner) {
  if (PyCallable_Check(function.ptr()) == 0)
    throw py::type_error(
        owner + ": " + Py_TYPE(function.ptr())->tp_name +
        ", expected a function, or the address of one in a ctypes function or a PyCapsule");
}

void check_finite(const double* values,
                  std::size_t count,
                  const std::string& owner,
                  const std::string& at) {
  const double* bad =
      std::find_if_not(values, values + count, [](double v) { return std::isfinite(v); });
  if (bad == values + count) return;
  throw InputError(fmt::format("{} returned {}{}, expected finite numbers", owner, *bad, at));
}

/// Numbers of a sequence that has so many, or TypeError.
void take(const py::handle& given, std::size_t count, const std::string& what, double* out) {
  const auto array = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!array || static_cast<std::size_t>(array.size()) != count) {
    PyErr_Clear();
    throw py::type_error(what + " is " + py::cast<std::string>(py::repr(given)) + ", expected " +
                         std::to_string(count) + " numbers");
  }
  std::copy_n(array.data(), count, out);
}

Tension checked(const double* out, double length, const std::string& owner) {
  check_finite(out, 3, owner, " at length " + std::to_string(length) + " mm");
  return {out[0], out[1], out[2]};
}

/// Force, moment and the 36 derivatives; the latter are there or not.
using LoadNumbers = std::function<bool(const RigidTransform& X, double* out)>;

void to_wrench(const double* out, Wrench& wrench) {
  using Rows = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Eigen::Map<const Rows> D(out + 6);
  wrench.f = Eigen::Map<const Eigen::Vector3d>(out);
  wrench.m = Eigen::Map<const Eigen::Vector3d>(out + 3);
  wrench.F1 = D.topLeftCorner<3, 3>();
  wrench.F2 = D.topRightCorner<3, 3>();
  wrench.M1 = D.bottomLeftCorner<3, 3>();
  wrench.M2 = D.bottomRightCorner<3, 3>();
}

/// By central differences.
void differentiate(const LoadNumbers& load, const RigidTransform& X, double* out) {
  constexpr double kStep[2] = {1e-4, 1e-5};  // [mm], [rad]
  double plus[42], minus[42];
  for (int j = 0; j < 6; ++j) {
    const double h = kStep[j / 3];
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(j % 3);
    const auto moved = [&](double by) {
      return j < 3 ? RigidTransform{X.R, X.p + by * axis}
                   : RigidTransform{exp_rotation(by * axis) * X.R, X.p};
    };
    load(moved(h), plus);
    load(moved(-h), minus);
    for (int i = 0; i < 6; ++i) out[6 + 6 * i + j] = (plus[i] - minus[i]) / (2 * h);
  }
}

OwnLoad load_of(LoadNumbers load) {
  return [load = std::move(load)](const RigidTransform& X, Wrench& wrench) {
    double out[42] = {};
    if (!load(X, out)) differentiate(load, X, out);
    to_wrench(out, wrench);
  };
}

void write_pose(const RigidTransform& X, double* pose) {
  for (int i = 0; i < 3; ++i) pose[i] = X.p[i];
  for (int i = 0; i < 9; ++i) pose[3 + i] = X.R(i / 3, i % 3);
}

}  // namespace

CustomLaw own_law(const py::object& function, const std::string& owner) {
  const auto held = kept(function);
  if (const CFunction<LawPointer> c = c_function<LawPointer>(function, owner);
      c.pointer != nullptr) {
    return {[c, held, owner](double length) {
      double out[3] = {};
      c.pointer(length, out, c.user);
      return checked(out, length, owner);
    }};
  }
  check_callable(function, owner);
  return {[held, owner](double length) {
    const py::gil_scoped_acquire lock;
    double out[3];
    take((*held)(length), 3, owner + " returned: (force, slope, energy)", out);
    return checked(out, length, owner);
  }};
}

OwnLoad own_load(const py::object& function, const std::string& owner) {
  const auto held = kept(function);
  if (const CFunction<LoadPointer> c = c_function<LoadPointer>(function, owner);
      c.pointer != nullptr) {
    return load_of([c, held, owner](const RigidTransform& X, double* out) {
      double pose[12];
      write_pose(X, pose);
      c.pointer(pose, out, c.user);
      check_finite(out, 42, owner, "");
      return true;
    });
  }
  check_callable(function, owner);
  return load_of([held, owner](const RigidTransform& X, double* out) {
    const py::gil_scoped_acquire lock;
    double pose[12];
    write_pose(X, pose);
    const py::array_t<double> translation(3, pose);
    const py::array_t<double> rotation(py::array::ShapeContainer{3, 3}, pose + 3);
    const py::object found = (*held)(translation, rotation);
    const bool parts = PyTuple_Check(found.ptr()) != 0 || PyList_Check(found.ptr()) != 0;
    const std::size_t count = parts ? py::len(found) : 0;
    if (count != 2 && count != 3)
      throw py::type_error(owner + " returned " + py::cast<std::string>(py::repr(found)) +
                           ", expected (force, moment) or (force, moment, derivatives)");
    take(found[py::int_(0)], 3, owner + " returned: force", out);
    take(found[py::int_(1)], 3, owner + " returned: moment", out + 3);
    if (count == 3) take(found[py::int_(2)], 36, owner + " returned: derivatives", out + 6);
    check_finite(out, count == 3 ? 42 : 6, owner, "");
    return count == 3;
  });
}

}  // namespace condyle::python
