#pragma once

/// Positions of equilibrium of one model, one after the other.
///
/// Newton on the contacts of the pose before comes first; then contacts that pull are released,
/// overlaps that the search finds become contacts, and Newton goes on, until forces and gaps agree
/// (Dortmans repeats the increment likewise [1986, 4.6], but cannot find a new contact). Where this
/// does not settle, the step from the last pose is taken in parts, halved as needed; where no part
/// settles, and for the first pose, the descent finds the way. A pose is converged only when no
/// part of the known surfaces overlaps by more than `overlap`.

#include <memory>
#include <vector>

#include "equilibrium/attempt.h"
#include "equilibrium/contact_search.h"
#include "equilibrium/descent.h"
#include "equilibrium/describe_pose.h"
#include "equilibrium/newton.h"
#include "equilibrium/pose_result.h"
#include "equilibrium/predictor.h"

namespace condyle {

struct EquilibriumOptions {
  NewtonOptions newton;
  DescentOptions descent;
  PoseDescriptionOptions description;
};

class EquilibriumSolver {
 public:
  explicit EquilibriumSolver(Model model, EquilibriumOptions options = {});
  EquilibriumSolver(const EquilibriumSolver&) = delete;
  EquilibriumSolver& operator=(const EquilibriumSolver&) = delete;

  /// Values of conditions and scales of loads may change between poses; nothing else may.
  [[nodiscard]] Model& model() { return *model_; }

  /// Solves from the last converged state, or from the model's start when there is none. The state
  /// is kept when the pose converges. Without patience a step that does not settle is not taken in
  /// parts, and a failure is not explained.
  /// Allocates nothing once `result` and the solver have held a pose of this model.
  void solve(PoseResult& result, bool patient = true);
  PoseResult solve(bool patient = true);

  /// The last converged state; set_state restores one, solved with the model's present values.
  [[nodiscard]] const EquilibriumState& state() const { return state_; }
  void set_state(const EquilibriumState& state);

 private:
  void read_drive(Drive& drive) const;
  void keep(const EquilibriumState& state);
  void set_drive(const Drive& from, const Drive& to, double t);
  bool settle_at_estimates(EquilibriumState& state, Attempt& attempt);
  bool find_first(EquilibriumState& state, Attempt& attempt);
  bool solve_first(EquilibriumState& state, const Drive& target, Attempt& attempt);
  bool advance(EquilibriumState& state, const Drive& from, const Drive& to, Attempt& attempt);
  bool descend(EquilibriumState& state, Attempt& attempt);
  bool settle(EquilibriumState& state, Attempt& attempt);
  bool solve_from_last(EquilibriumState& state, Attempt& attempt, bool patient);
  bool release_pulling(EquilibriumState& state) const;
  void set_known(int pair, const EquilibriumState& state);
  bool add_overlaps(EquilibriumState& state, bool& too_many);
  [[nodiscard]] bool carries_and_clear(EquilibriumState& state);
  [[nodiscard]] bool on_minima(const EquilibriumState& state) const;
  [[nodiscard]] bool on_surfaces(const EquilibriumState& state);
  [[nodiscard]] bool faces(const EquilibriumState& state);

  std::unique_ptr<Model> model_;
  EquilibriumOptions options_;
  std::vector<ContactSearch> searches_;
  Newton newton_;
  Descent descent_;
  Predictor predictor_;
  EquilibriumState state_, next_, trial_;
  Drive solved_;  ///< at which state_ was solved
  Drive target_;  ///< of the pose under way
  bool has_state_ = false;
  std::vector<GapMinimum> minima_;
  std::vector<KnownContact> known_;
};

}  // namespace condyle
