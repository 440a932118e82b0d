#pragma once

/// Positions of equilibrium of one model, one after the other: a pose is a function of the model,
/// which is constant, of what drives it (drive.h), and of the pose before, from which it is found.
/// Solvers share a model and its covers; each is the workspace of one thread.
///
/// Newton on the contacts of the pose before comes first; then contacts that pull are released,
/// overlaps that the search finds become contacts, and Newton goes on, until forces and gaps agree
/// (Dortmans repeats the increment likewise [1986, 4.6], but cannot find a new contact). Where this
/// does not settle, the descent looks for a way from the last pose, then the step from there is
/// taken in parts, halved as needed; then the descent starts anew from the scene's start pose and
/// from the last pose, both carried to the values asked for (carried_pose.h). A pose is converged
/// only when no part of the known surfaces overlaps by more than kAllowedOverlap and every contact
/// lies on them. An equilibrium on a surface extrapolated beyond its known part is told where no
/// other is found, and no pose goes on from it. All ways together are bounded by counted iterations.

#include <memory>
#include <utility>
#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/attempt.h"
#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/descent.h"
#include "condyle/equilibrium/describe_pose.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/passed_through.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/equilibrium/predictor.h"

namespace condyle {

struct EquilibriumOptions {
  NewtonOptions newton;
  DescentOptions descent;
  PoseDescriptionOptions description;
  /// Spent on one pose by all ways together, some 25 ms; a third of it on one that is only followed from
  /// the pose before it.
  Work most{450, 450000};
  Work most_at_first{450, 600000};  ///< on the first pose of a sweep, or on one alone
};

/// How much is tried where the step from the last pose does not settle.
enum class Patience {
  kNone,  ///< the descent from there
  kWay,   ///< and the way from there in parts
  kAll,   ///< and other starts; a failure is explained
  kFirst  ///< the same for longer: of a pose that is wanted for itself, or that leads to others
};

class EquilibriumSolver {
 public:
  explicit EquilibriumSolver(const std::shared_ptr<const Model>& model,
                             EquilibriumOptions options = {});
  /// `covers` as from cover_pairs(*model), shared with other solvers of the model. Throws
  /// std::invalid_argument for those of another one.
  EquilibriumSolver(std::shared_ptr<const Model> model,
                    const ContactCovers& covers,
                    EquilibriumOptions options = {});
  explicit EquilibriumSolver(Model model, EquilibriumOptions options = {});
  EquilibriumSolver(const EquilibriumSolver&) = delete;
  EquilibriumSolver& operator=(const EquilibriumSolver&) = delete;

  [[nodiscard]] const Model& model() const { return *model_; }
  [[nodiscard]] const ContactCovers& covers() const { return covers_; }

  /// Solves from the last converged state, or from the model's start when there is none. The state
  /// is kept when the pose converges. Throws std::invalid_argument for a drive that is not one of
  /// the model.
  /// Allocates nothing once `result` and the solver have held a pose of this model.
  void solve(const Drive& drive, PoseResult& result, Patience patience = Patience::kFirst);
  PoseResult solve(const Drive& drive, Patience patience = Patience::kFirst);
  /// With the model's nominal drive.
  PoseResult solve() { return solve(drive_of(*model_)); }

  /// Ligaments and loads from now on, in place of the model's own: costs no rebuilding. The state
  /// stays, as a start for the next pose. Throws std::invalid_argument where there are not as many
  /// as the model has.
  void set_parameters(const Parameters& parameters);
  [[nodiscard]] const Parameters& parameters() const { return newton_.system().parameters(); }

  /// As newly made, but for the parameters: what is solved next does not depend on what was solved
  /// before, to the last bit.
  /// Builds nothing anew and allocates nothing.
  void reset();

  /// Where searches of contacts begin, as the last pose left it.
  [[nodiscard]] const std::vector<ContactSearch>& searches() const { return searches_; }
  /// The same, but searches begin where those of a solver of the same model and covers did: a pose
  /// near that one's costs less.
  void reset(const std::vector<ContactSearch>& searches);

  /// The last converged state; set_state restores one, solved with that drive.
  [[nodiscard]] const EquilibriumState& state() const { return state_; }
  void set_state(const EquilibriumState& state, const Drive& drive);

  /// From where the next pose starts: the last converged state and its values, or none.
  struct Standing {
    EquilibriumState state;
    Drive solved;
    bool has_state = false;
  };
  [[nodiscard]] Standing standing() const { return {state_, solved_, has_state_}; }
  void go_back(const Standing& standing);

  /// The state of the last pose solved, converged or beyond the edge of a patch.
  [[nodiscard]] const EquilibriumState& solution() const { return next_; }
  /// At that state, for what derivatives know of it (sensitivity.h); valid until the next pose is
  /// asked for. Throws std::invalid_argument where the last pose was not solved.
  [[nodiscard]] Linearization linearized_solution() const;

  /// On the last pose, whether it was found or not, and on what is told of it.
  [[nodiscard]] const Work& spent() const { return spent_; }

  /// Was the last pose found from another start than the pose before it?
  [[nodiscard]] bool from_elsewhere() const { return from_elsewhere_; }

 private:
  void forget();
  void keep(const EquilibriumState& state);
  void set_drive(const Drive& from, const Drive& to, double t);
  bool settle_at_estimates(EquilibriumState& state, Attempt& attempt);
  bool find_first(EquilibriumState& state, Attempt& attempt);
  bool solve_first(EquilibriumState& state, const Drive& target, Attempt& attempt);
  bool advance(EquilibriumState& state, const Drive& from, const Drive& to, Attempt& attempt);
  [[nodiscard]] Work most(Patience patience) const;
  [[nodiscard]] long looked_at() const;
  [[nodiscard]] Work left(Attempt& attempt) const;
  bool descend(EquilibriumState& state, Attempt& attempt);
  bool descend_softly(EquilibriumState& state, Attempt& attempt);
  bool stiffen(double softest, EquilibriumState& state, Attempt& attempt);
  [[nodiscard]] bool tried_from(const RigidTransform& X, const Attempt& attempt) const;
  [[nodiscard]] bool leads_nowhere(const RigidTransform& X, Attempt& attempt) const;
  bool settle(EquilibriumState& state, Attempt& attempt);
  bool solve_from_last(EquilibriumState& state, Attempt& attempt, Patience patience);
  bool solve_from_elsewhere(EquilibriumState& state, Attempt& attempt);
  bool descend_from(const RigidTransform& X, EquilibriumState& state, Attempt& attempt);
  bool descend_from_beside_start(EquilibriumState& state, Attempt& attempt);
  bool solve_from_edge(EquilibriumState& state, Attempt& attempt);
  bool take_off_surfaces(EquilibriumState& state, Attempt& attempt);
  bool starts_passed_through(Attempt& attempt);
  void describe(const Attempt& attempt, bool off_surfaces, PoseResult& result);
  const ContactChanges& changes(const EquilibriumState& state, Attempt& attempt);
  [[nodiscard]] bool is_admissible(const EquilibriumState& state, Attempt& attempt);
  [[nodiscard]] bool on_surfaces(const EquilibriumState& state, Attempt& attempt);
  [[nodiscard]] std::pair<int, double> farthest_beyond(const EquilibriumState& state) const;
  [[nodiscard]] bool faces(const EquilibriumState& state, Attempt& attempt);
  void note_rim(const EquilibriumState& state, const ContactChanges& rims, Attempt& attempt) const;
  void note_overflow(const EquilibriumState& state, Attempt& attempt);
  void keep_off_surfaces(const OffSurfaces& off, Attempt& attempt) const;

  std::shared_ptr<const Model> model_;
  ContactCovers covers_;
  EquilibriumOptions options_;
  std::vector<ContactSearch> searches_;
  std::vector<PassedThrough> passed_;
  ContactRules rules_;
  Newton newton_;
  Descent descent_;
  Predictor predictor_;
  EquilibriumState state_, next_, trial_;
  Drive solved_;  ///< at which state_ was solved
  Drive target_;  ///< of the pose under way: what is asked for,
  Drive drive_;   ///< and what is tried now on the way there
  bool has_state_ = false;
  OffSurfaces edge_;         ///< the last equilibrium told of beyond an edge
  bool has_edge_ = false;    ///< since a pose converged
  bool on_the_way_ = false;  ///< the values under way are not those asked for
  bool from_elsewhere_ = false;
  Work spent_;
  std::vector<GapMinimum> minima_;
};

}  // namespace condyle
