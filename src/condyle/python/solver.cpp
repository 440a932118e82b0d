#include "condyle/python/solver.h"

#include <stdexcept>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/thread_seconds.h"

namespace condyle::python {
namespace {

EquilibriumOptions options_of(const KneeModel& knee, bool stability) {
  SweepOptions options;
  options.stability = stability;
  return equilibrium_options(knee.scene(), options);
}

/// Makes the solver as new where what follows does not come to its end.
class UnlessDone {
 public:
  explicit UnlessDone(EquilibriumSolver& solver) : solver_(solver) {}
  UnlessDone(const UnlessDone&) = delete;
  ~UnlessDone() {
    if (!done_) solver_.reset();
  }
  void done() { done_ = true; }

 private:
  EquilibriumSolver& solver_;
  bool done_ = false;
};

void put(const KneeModel& knee, const py::handle& name, const py::handle& value, Drive& drive) {
  const char* text = PyUnicode_Check(name.ptr()) != 0 ? PyUnicode_AsUTF8(name.ptr()) : nullptr;
  if (text == nullptr) {
    PyErr_Clear();
    throw py::type_error("drive: expected the names of conditions and loads, as texts");
  }
  const auto at = knee.driven().find(std::string_view(text));
  if (at == knee.driven().end()) {
    std::vector<std::string> names;
    for (const auto& entry : knee.driven()) names.push_back(entry.first);
    throw py::type_error("\"" + std::string(text) + "\" is no condition and no load of the scene" +
                         did_you_mean(text, names));
  }
  at->second.which.in(drive) = number(value, text) * at->second.factor;
}

}  // namespace

KneeSolver::Use::Use(KneeSolver& solver) : busy_(solver.busy_) {
  if (busy_.test_and_set())
    throw std::runtime_error(
        "solver: another thread solves with it (or a law of its own does), expected one Solver "
        "for each thread; they share the Model");
}

KneeSolver::KneeSolver(std::shared_ptr<const KneeModel> knee, bool stability)
    : knee_(std::move(knee)),
      solver_(knee_->model(), knee_->covers(), options_of(*knee_, stability)),
      drive_(drive_of(*knee_->model())) {}

std::shared_ptr<PoseData> KneeSolver::solve(const Drive& drive) {
  UnlessDone guard(solver_);
  solver_.solve(drive, result_);
  guard.done();
  return std::make_shared<PoseData>(knee_, result_);
}

SweepResult KneeSolver::sweep(const SweepDescription& description, const SweepOptions& options) {
  UnlessDone guard(solver_);
  SweepResult result = condyle::sweep(solver_, description, options);
  guard.done();
  return result;
}

void KneeSolver::reset() { solver_.reset(); }

const std::vector<SceneParameter>& KneeSolver::named(const std::string& name) {
  const auto known = named_.find(name);
  if (known != named_.end()) return known->second;
  return named_.emplace(name, numbers_named(name, knee_->scene())).first->second;
}

std::vector<double> KneeSolver::get(const std::string& name) {
  std::vector<double> values;
  for (const SceneParameter& number : named(name))
    values.push_back(python::get({*knee_, number}, solver_.parameters(), drive_));
  return values;
}

void KneeSolver::set(const std::vector<std::pair<std::string, std::vector<double>>>& numbers) {
  Parameters parameters = solver_.parameters();
  Drive drive = drive_;
  for (const auto& [name, values] : numbers) {
    const std::vector<SceneParameter>& places = named(name);
    const bool all = name.starts_with("*");
    if (values.size() != places.size() && !(all && values.size() == 1))
      throw InputError(name + ": " + std::to_string(values.size()) + " numbers, expected " +
                       std::to_string(places.size()));
    for (std::size_t i = 0; i < places.size(); ++i)
      python::set({*knee_, places[i]}, values[values.size() == 1 ? 0 : i], parameters, drive);
  }
  solver_.set_parameters(parameters);
  drive_ = drive;
}

double KneeSolver::seconds_of(const Swept& swept, const std::vector<double>& values) {
  UnlessDone guard(solver_);
  const double begin = thread_seconds();
  Drive drive = drive_;
  for (const double value : values) {
    swept.in(drive) = value;
    solver_.solve(drive, result_);
  }
  guard.done();
  return thread_seconds() - begin;
}

Drive drive_from(const KneeModel& knee,
                 const Drive& nominal,
                 const py::object& given,
                 const py::kwargs& named) {
  Drive drive = nominal;
  if (!given.is_none()) {
    if (PyDict_Check(given.ptr()) == 0)
      throw py::type_error(std::string("drive: ") + Py_TYPE(given.ptr())->tp_name +
                           ", expected a dict {name: value}, or names as keywords");
    for (const auto& [name, value] : py::reinterpret_borrow<py::dict>(given))
      put(knee, name, value, drive);
  }
  for (const auto& [name, value] : named) {
    if (!given.is_none() && given.contains(name))
      throw py::type_error(py::cast<std::string>(name) +
                           " is given twice, expected once: in the dict or as a keyword");
    put(knee, name, value, drive);
  }
  return drive;
}

std::shared_ptr<PoseData> solve_once(const std::shared_ptr<KneeModel>& knee,
                                     const py::object& drive,
                                     const py::kwargs& named) {
  const Drive asked = drive_from(*knee, drive_of(*knee->model()), drive, named);
  const Unlocked unlocked;
  return std::make_shared<PoseData>(knee, knee->solve_anew(asked));
}

}  // namespace condyle::python
