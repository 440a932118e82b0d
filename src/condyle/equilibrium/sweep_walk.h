#pragma once

/// One walk along the values of a sweep (sweep.h).

#include <optional>
#include <unordered_map>
#include <vector>

#include "condyle/equilibrium/events.h"
#include "condyle/equilibrium/known_poses.h"
#include "condyle/equilibrium/sweep_options.h"
#include "condyle/equilibrium/walker.h"

namespace condyle {

class SweepWalk {
 public:
  /// Refers to the solver and the options.
  SweepWalk(EquilibriumSolver& solver, const Swept& swept, const SweepOptions& options);

  SweepResult along(const std::vector<double>& values);

 private:
  /// One value of the sweep.
  struct Stop {
    SolvedPose at;
    int visit = 0;
    const KnownPose* taken = nullptr;  ///< over from an earlier sweep, as final
    bool from_elsewhere = false;       ///< not found from the pose before it
    std::optional<double> from;        ///< as in KnownPose
    std::vector<Event> events;
    [[nodiscard]] bool converged() const { return at.result.converged(); }
  };

  void step(double value);
  bool take_over(const KnownPose& known, Stop& stop);
  EquilibriumSolver& solver() { return walker_.solver(); }
  [[nodiscard]] const Model& model() const { return walker_.model(); }
  [[nodiscard]] RigidTransform in_model(const PoseResult& pose) const;
  [[nodiscard]] bool agrees(const PoseResult& pose, const PoseResult& known) const;
  void compute(Stop& stop);
  void mend_gap();
  bool mend(Stop& stop, const Stop& from, std::optional<PoseOrigin> origin = {});
  void tell();
  void find_events(Stop& stop);
  static void put_in_place(SolvedPose there, Stop& stop);
  void note_jump(Stop& stop);
  void stand_at_last_converged();
  void note_second_equilibria();
  void follow(std::size_t from, int way);
  [[nodiscard]] bool continuous(std::size_t a, std::size_t b) const;

  Walker walker_;
  const SweepOptions& options_;
  KnownPoseIndex known_;
  EquilibriumSolver::Standing start_;
  double event_tolerance_ = 0;  ///< of the swept value
  std::unordered_map<double, int> visits_;
  std::vector<Stop> stops_;
  std::size_t told_ = 0;  ///< stops that are final
  std::optional<std::size_t> last_converged_;
  std::optional<std::size_t> last_solved_;  ///< of those told
  SolvedPose trial_;
};

}  // namespace condyle
