#include "condyle/python/interrupts.h"
#include "condyle/python/solver.h"

#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"

namespace condyle::python {
namespace {

/// As ModelPointer of bind_model.cpp.
using SolverPointer = std::shared_ptr<KneeSolver>;

SolverPointer make_solver(const py::object& model, bool stability) {
  auto knee = model_of(model);
  const Unlocked unlocked;
  return std::make_shared<KneeSolver>(std::move(knee), stability);
}

std::shared_ptr<PoseData> solve(const SolverPointer& solver,
                                const py::object& drive,
                                const py::kwargs& named) {
  const KneeSolver::Use use(*solver);
  const Drive asked = drive_from(*solver->knee(), solver->drive(), drive, named);
  const Unlocked unlocked;
  return solver->solve(asked);
}

using Numbers = std::vector<std::pair<std::string, std::vector<double>>>;

void add_number(const py::handle& name, const py::handle& value, Numbers& out) {
  if (!py::isinstance<py::str>(name))
    throw py::type_error("numbers: expected names of numbers, as texts");
  auto text = py::cast<std::string>(name);
  const bool is_number = PyFloat_Check(value.ptr()) != 0 || PyLong_Check(value.ptr()) != 0 ||
                         value.is_none() || !py::hasattr(value, "__len__");
  std::vector<double> values =
      is_number ? std::vector<double>{number(value, text)} : numbers(value, text);
  out.emplace_back(std::move(text), std::move(values));
}

void set_numbers(const SolverPointer& solver, const py::object& numbers, const py::object& value) {
  const KneeSolver::Use use(*solver);
  Numbers found;
  if (py::isinstance<py::str>(numbers)) {
    add_number(numbers, value, found);
  } else {
    if (PyDict_Check(numbers.ptr()) == 0)
      throw py::type_error("numbers: expected a name and a value, or a dict {name: value}");
    if (!value.is_none()) throw py::type_error("value: expected none beside a dict {name: value}");
    for (const auto& [name, number] : py::reinterpret_borrow<py::dict>(numbers))
      add_number(name, number, found);
  }
  solver->set(found);
}

py::object get_number(const SolverPointer& solver, const std::string& name) {
  const KneeSolver::Use use(*solver);
  const std::vector<double> values = solver->get(name);
  if (values.size() == 1) return py::float_(values[0]);
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

void reset(const SolverPointer& solver) {
  const KneeSolver::Use use(*solver);
  solver->reset();
}

}  // namespace

void bind_solver(py::module_& m) {
  py::class_<KneeSolver, SolverPointer>(
      m, "Solver",
      "The workspace of one thread: solves poses of a Model, each from the last one that was "
      "found.\n\n"
      "Solver(model, *, stability=True): without `stability` the stiffness of poses is not "
      "examined.\n"
      "Of a scene a Model is made. Used by two threads at once it raises RuntimeError.")
      .def(py::init(&make_solver), py::arg("model"), py::kw_only(), py::arg("stability") = true)
      .def("solve", &solve, py::arg("drive") = py::none(), py::pos_only(),
           "The position of equilibrium, from the last pose that was found.\n\n"
           "solve(flexion=30, drawer=0.5), or solve({\"body weight.scale\": 2}): values of "
           "conditions in the scene's units\n"
           "(deg or rad, mm ...), factors on loads; what is not given has the scene's value, or "
           "that of `set`. Returns a\n"
           "Pose; one that is not found says so in its status.")
      .def("set", &set_numbers, py::arg("numbers"), py::arg("value") = py::none(),
           "Change numbers from now on, without building the model anew: "
           "set(\"aACL.slack_length\", 31.5), or\n"
           "set({\"*.stiffness\": 5000, \"aACL.insertion.tibia\": [3, -20, 1]}).\n\n"
           "Names are those of `sensitivities` in docs/scene.md, but surfaces and layers; values "
           "in the scene's units.\n"
           "All of them are set, or none.")
      .def("get", &get_number, py::arg("name"),
           "A number as it is now, in the scene's units; of a vector an array (3,).")
      .def("reset", &reset, "Forget the poses solved so far; numbers that were set stay.")
      .def_property_readonly(
          "model",
          [](const SolverPointer& solver) {
            return std::const_pointer_cast<KneeModel>(solver->knee());
          },
          "The Model.");
}

}  // namespace condyle::python
