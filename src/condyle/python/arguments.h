#pragma once

/// Arguments from Python, checked: each error names the argument.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace condyle::python {

namespace py = pybind11;

/// A finite number; TypeError for what is none, InputError for one that is not finite.
[[nodiscard]] double number(const py::handle& value, const std::string& argument);

/// Finite numbers of one dimension, one at least, a million at most.
[[nodiscard]] std::vector<double> numbers(const py::handle& value, const std::string& argument);

/// Three finite numbers.
[[nodiscard]] std::array<double, 3> vector3(const py::handle& value, const std::string& argument);

/// A path without zero bytes, from str, bytes or os.PathLike.
[[nodiscard]] std::string path(const py::handle& value, const std::string& argument);

/// The one of `names` that is most like `name`, as ', did you mean "..."?'; nothing where none is.
[[nodiscard]] std::string did_you_mean(const std::string& name,
                                       const std::vector<std::string>& names);

}  // namespace condyle::python
