#include "condyle/python/arguments.h"

#include <cmath>

#include "condyle/input_error.h"
#include "condyle/scene_file/section.h"

namespace condyle::python {
namespace {

constexpr std::size_t kMostNumbers = 1000000;

std::string type_name(const py::handle& value) { return Py_TYPE(value.ptr())->tp_name; }

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

Numbers array_of(const py::handle& value, const std::string& argument, const char* expected) {
  const auto unusable = [&] {
    PyErr_Clear();
    return py::type_error(argument + ": " + type_name(value) + ", expected " + expected);
  };
  if (value.is_none() || py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value))
    throw unusable();
  const auto given = py::array::ensure(value);
  if (!given || std::string("biuf").find(given.dtype().kind()) == std::string::npos)
    throw unusable();
  Numbers out = Numbers::ensure(given);
  if (!out) throw unusable();
  return out;
}

std::string text_of(const py::handle& value) { return py::cast<std::string>(py::repr(value)); }

}  // namespace

double number(const py::handle& value, const std::string& argument) {
  double found = 0;
  if (PyFloat_Check(value.ptr())) {
    found = PyFloat_AS_DOUBLE(value.ptr());
  } else {
    if (py::isinstance<py::str>(value) || value.is_none())
      throw py::type_error(argument + ": " + type_name(value) + ", expected a number");
    found = PyFloat_AsDouble(value.ptr());
    if (found == -1 && PyErr_Occurred() != nullptr) {
      PyErr_Clear();
      throw py::type_error(argument + ": " + type_name(value) + ", expected a number");
    }
  }
  if (!std::isfinite(found))
    throw InputError(argument + " = " + text_of(value) + ", expected a finite number");
  return found;
}

std::vector<double> numbers(const py::handle& value, const std::string& argument) {
  const Numbers array = array_of(value, argument, "numbers [v1, v2, ...]");
  if (array.ndim() != 1 || array.size() == 0)
    throw InputError(argument + ": an array of shape " + text_of(array.attr("shape")) +
                     ", expected one dimension and a number at least");
  const auto size = static_cast<std::size_t>(array.size());
  if (size > kMostNumbers)
    throw InputError(argument + ": " + std::to_string(size) +
                     " numbers, expected a million at most");
  std::vector<double> out(array.data(), array.data() + size);
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(out[i]))
      throw InputError(argument + "[" + std::to_string(i) + "] = " + std::to_string(out[i]) +
                       ", expected a finite number");
  return out;
}

std::array<double, 3> vector3(const py::handle& value, const std::string& argument) {
  const Numbers array = array_of(value, argument, "three numbers");
  if (array.ndim() != 1 || array.size() != 3)
    throw InputError(argument + ": an array of shape " + text_of(array.attr("shape")) +
                     ", expected three numbers");
  const std::vector<double> found = numbers(array, argument);
  return {found[0], found[1], found[2]};
}

std::string path(const py::handle& value, const std::string& argument) {
  PyObject* bytes = nullptr;
  if (PyUnicode_FSConverter(value.ptr(), &bytes) == 0) {
    const bool is_type = PyErr_ExceptionMatches(PyExc_TypeError) != 0;
    PyErr_Clear();
    if (is_type) throw py::type_error(argument + ": " + type_name(value) + ", expected a path");
    throw InputError(argument + " = " + text_of(value) + ", expected a path");
  }
  return py::reinterpret_steal<py::bytes>(bytes);
}

std::string did_you_mean(const std::string& name, const std::vector<std::string>& names) {
  const std::string meant = nearest(name, names);
  return meant.empty() ? "" : ", did you mean \"" + meant + "\"?";
}

}  // namespace condyle::python
