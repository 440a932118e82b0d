#pragma once

/// The workspace of one thread as Python holds it.

#include <pybind11/pybind11.h>

#include <atomic>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "condyle/equilibrium/sweep_options.h"
#include "condyle/python/run_data.h"
#include "condyle/python/solver_numbers.h"

namespace condyle::python {

class KneeSolver {
 public:
  /// `stability`: of each pose, with the stiffness of the joint.
  KneeSolver(std::shared_ptr<const KneeModel> knee, bool stability);

  [[nodiscard]] const std::shared_ptr<const KneeModel>& knee() const { return knee_; }
  [[nodiscard]] const Drive& drive() const { return drive_; }

  /// From the last pose that was found. What a law or load of one's own throws comes through; the solver is then as
  /// newly made, but for its numbers.
  [[nodiscard]] std::shared_ptr<PoseData> solve(const Drive& drive);
  [[nodiscard]] SweepResult sweep(const SweepDescription& description, const SweepOptions& options);
  void reset();

  [[nodiscard]] std::vector<double> get(const std::string& name);
  /// Values in the scene's units, one each or three of a vector; all or, where one cannot be, none. Throws InputError.
  void set(const std::vector<std::pair<std::string, std::vector<double>>>& numbers);

  /// Seconds of the processor for solving from one value to the next, over and over, in C++ alone: what Python's share is compared with.
  [[nodiscard]] double seconds_of(const Swept& swept, const std::vector<double>& values);

  /// While it lives the solver is that of one thread; throws std::runtime_error where another one has it.
  class Use {
   public:
    explicit Use(KneeSolver& solver);
    Use(const Use&) = delete;
    ~Use() { busy_.clear(); }

   private:
    std::atomic_flag& busy_;
  };

 private:
  const std::vector<SceneParameter>& named(const std::string& name);

  std::shared_ptr<const KneeModel> knee_;
  EquilibriumSolver solver_;
  Drive drive_;  ///< of all that solve is not given
  PoseResult result_;
  std::map<std::string, std::vector<SceneParameter>> named_;
  std::atomic_flag busy_;
};

/// The drive that keyword arguments and a dict say, else `nominal`. Throws TypeError for a name that the model has not.
[[nodiscard]] Drive drive_from(const KneeModel& knee,
                               const Drive& nominal,
                               const pybind11::object& given,
                               const pybind11::kwargs& named);

/// Model.solve: by a solver that starts anew.
[[nodiscard]] std::shared_ptr<PoseData> solve_once(const std::shared_ptr<KneeModel>& knee,
                                                   const pybind11::object& drive,
                                                   const pybind11::kwargs& named);

}  // namespace condyle::python
