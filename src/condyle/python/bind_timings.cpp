/// What Python's share is measured against (tools/python.sh): the same work in C++ alone, timed in the same process.

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/solver.h"
#include "condyle/python/thread_seconds.h"

namespace condyle::python {
namespace {

const DrivenNumber& driven(const KneeModel& knee, const std::string& name) {
  const auto at = knee.driven().find(name);
  if (at == knee.driven().end())
    throw InputError("name = \"" + name + "\", expected a condition or a load");
  return at->second;
}

std::vector<double> inside(const py::object& values, const DrivenNumber& number) {
  std::vector<double> out = numbers(values, "values");
  for (double& value : out) value *= number.factor;
  return out;
}

double seconds_of_solves(const std::shared_ptr<KneeSolver>& solver,
                         const std::string& name,
                         const py::object& values) {
  const KneeSolver::Use use(*solver);
  const DrivenNumber& number = driven(*solver->knee(), name);
  const std::vector<double> all = inside(values, number);
  const Unlocked unlocked;
  return solver->seconds_of(number.which, all);
}

double seconds_of_sweep(const std::shared_ptr<KneeModel>& knee,
                        const std::string& name,
                        const py::object& values) {
  const DrivenNumber& number = driven(*knee, name);
  const std::vector<double> all = inside(values, number);
  const Unlocked unlocked;
  const double begin = thread_seconds();
  EquilibriumSolver solver(knee->model(), knee->covers(), equilibrium_options(knee->scene()));
  const SweepResult result = sweep(solver, number.which, all);
  return thread_seconds() - begin;
}

}  // namespace

void bind_timings(py::module_& m) {
  m.def("_seconds_of_solves", &seconds_of_solves, py::arg("solver"), py::arg("name"),
        py::arg("values"), "Seconds of a loop of solves in C++.");
  m.def("_seconds_of_sweep", &seconds_of_sweep, py::arg("model"), py::arg("name"),
        py::arg("values"), "Seconds of a sweep in C++, without a result for Python.");
}

}  // namespace condyle::python
