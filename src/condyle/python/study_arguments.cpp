#include "condyle/python/study_arguments.h"

#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"

namespace condyle::python {
namespace {

constexpr double kLeastStrain = 0.001, kMostStrain = 1;

std::string between(long long least, long long most) {
  return ", expected a whole number from " + std::to_string(least) + " to " + std::to_string(most);
}

std::string said(const std::string& argument, const py::handle& value) {
  return argument + " = " + py::cast<std::string>(py::repr(value));
}

}  // namespace

long long whole_number(const py::handle& value,
                       const std::string& argument,
                       long long least,
                       long long most) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
  if (!index || PyBool_Check(value.ptr())) {
    PyErr_Clear();
    throw py::type_error(argument + ": " + Py_TYPE(value.ptr())->tp_name + between(least, most));
  }
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || number < least || number > most)
    throw InputError(said(argument, index) + between(least, most));
  return number;
}

int threads_of(const py::handle& threads) {
  constexpr int kMost = 4096;
  return threads.is_none() ? 0 : static_cast<int>(whole_number(threads, "threads", 1, kMost));
}

void check_no_own_loads(const KneeModel& knee, const std::string& study) {
  for (const auto& [index, load] : knee.fitted().knee.loads)
    throw InputError("[[load]] \"" + knee.scene().loads.at(index).name +
                     "\": function: is a function, expected none: " + study + " cannot follow it");
}

std::shared_ptr<const KneeModel> model_without_own_loads(const py::object& scene,
                                                         const std::string& study) {
  auto knee = model_of(scene);
  check_no_own_loads(*knee, study);
  return knee;
}

CompareOptions reference_options(const py::handle& degree, const py::handle& strain) {
  CompareOptions options;
  options.degree = static_cast<int>(whole_number(degree, "degree", kLowestDegree, kHighestDegree));
  options.strain = number(strain, "strain");
  if (options.strain < kLeastStrain || options.strain > kMostStrain)
    throw InputError(said("strain", strain) + ", expected a strain from 0.001 to 1");
  return options;
}

}  // namespace condyle::python
