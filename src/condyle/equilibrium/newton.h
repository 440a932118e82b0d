#pragma once

/// Newton's method on the equilibrium of a given set of closed contacts [Dortmans
/// 1986, 2.156-2.160].
///
/// Unknowns da, dπ, dp (n contacts), dσ (m conditions), 6 + n + m rows; the surface coordinates are
/// eliminated (contact/contact.h). Rotations are scaled by the model's length L, moments by 1/L,
/// angle conditions by L, so that all rows are newtons or millimetres:
///
///     [ F1      F2/L     n      -w α    ] [da  ]     [ f   ]
///     [ M1/L    M2/L²    s x n/L -w η/L ] [L dπ] = - [ m/L ]
///     [ nᵀ      (s x n)ᵀ/L  0     0     ] [dp  ]     [ n.g ]
///     [ w αᵀ    w ηᵀ/L   0       0      ] [dσ/w]     [ w k ]
///
/// Converged means: force and moment/L below tolerance times the sum of all force magnitudes,
/// distances below tolerance times L. Which contacts are closed is somebody else's decision
/// (equilibrium_solver.h). Contact laws without unknowns (contact/contact_law.h) add to f, m and
/// their blocks as ligaments do.

#include <limits>
#include <vector>

#include "condyle/contact/contact.h"
#include "condyle/contact/contact_potentials.h"
#include "condyle/elements/line_element_block.h"
#include "condyle/equilibrium/drive.h"
#include "condyle/equilibrium/parameters.h"
#include "condyle/equilibrium/pose_trace.h"
#include "condyle/math/small_lu.h"

namespace condyle {

/// A closed contact with its places on both surfaces and its force p [N], >= 0 pushes.
struct ClosedContact {
  int pair = 0;  ///< index into Model::pairs
  ContactPlaces places;
  double p = 0;
};

/// What Newton changes: the pose, the closed contacts and the multipliers of the conditions.
struct EquilibriumState {
  RigidTransform X;
  std::vector<ClosedContact> contacts;
  std::vector<double> sigma;  ///< one per Model::conditions
  /// What the paths of line elements keep (line_path.h), one after the other; any other number of
  /// them than path_numbers(elements): nothing is known.
  std::vector<double> paths = {};
};

/// Throws std::invalid_argument with one sentence where the state is not one of the model.
void check_state(const EquilibriumState& state, const Model& model);

enum class NewtonOutcome { kConverged, kIterationLimit, kDiverged, kSingular, kZeroLength };

struct NewtonOptions {
  int max_iterations = 25;
  double tolerance = 1e-12;  ///< relative
  double longest_step =
      0.35;  ///< of one iteration, in units of L (translation and rotation together)
};

struct NewtonReport {
  NewtonOutcome outcome = NewtonOutcome::kIterationLimit;
  int iterations = 0;
  double residual = 0;     ///< largest of |f| and |m|/L [N] at the end
  double gap = 0;          ///< largest |g| of a contact [mm]
  double force_scale = 0;  ///< sum of force magnitudes [N]
  int zero_element = -1;   ///< index of the element of zero length
};

/// Everything at one state: residual, Jacobian blocks, contact linearisations. Sized once. The
/// workspace of one thread.
class NewtonSystem {
 public:
  explicit NewtonSystem(const Model& model);
  NewtonSystem(const NewtonSystem&) = delete;
  NewtonSystem& operator=(const NewtonSystem&) = delete;

  /// In place of those before, at first the model's own. Throws std::invalid_argument where there
  /// are not as many as the model has.
  void set_parameters(const Parameters& parameters);
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }

  /// False where an element has no length (zero_element()). Throws std::invalid_argument for a
  /// state or a drive that is not one of the model.
  bool assemble(const EquilibriumState& state, const Drive& drive) {
    return assemble(state, drive, {false, false});
  }
  /// What is told well enough for a step alone, where that costs less.
  struct Roughly {
    bool laws, paths;  ///< contact laws, paths of line elements
  };
  bool assemble(const EquilibriumState& state, const Drive& drive, const Roughly& roughly);
  [[nodiscard]] bool is_assembled_at(const EquilibriumState& state) const;

  /// What contact laws hold while poses near X_BA are solved is chosen there.
  void prepare(const RigidTransform& X_BA) { potentials_.prepare(X_BA); }
  /// At a state that was assembled and is solved: does a contact law or a path change what it holds
  /// while a pose is solved? Then it has to be solved on.
  [[nodiscard]] bool revise(EquilibriumState& state);
  [[nodiscard]] bool has_paths() const { return elements_.has_paths(); }
  /// Contact laws know nothing of what was asked before.
  void reset() { potentials_.reset(); }

  /// Fills the matrix and the right side (minus the residual); returns the number of rows.
  int fill(const EquilibriumState& state, SmallLu& matrix, double* right_side) const;

  /// Moves the state at which the system was assembled by a step as the matrix has it: (da, L dπ,
  /// dp, dσ/w).
  void move(EquilibriumState& state, const double* step) const;

  [[nodiscard]] const Model& model() const { return model_; }
  /// Sum of the magnitudes of what pulls and loads, without contacts and conditions, where it was
  /// assembled last [N].
  [[nodiscard]] double pull() const { return pull_; }
  [[nodiscard]] ContactPotentials& potentials() { return potentials_; }
  [[nodiscard]] const ContactPotentials& potentials() const { return potentials_; }
  [[nodiscard]] const Wrench& wrench() const { return wrench_; }
  [[nodiscard]] const std::vector<ContactLinearization>& contacts() const { return contacts_; }
  [[nodiscard]] const std::vector<ConditionDerivatives>& conditions() const { return conditions_; }
  [[nodiscard]] double force_scale() const { return force_scale_; }
  [[nodiscard]] int zero_element() const { return zero_element_; }
  [[nodiscard]] double out_of_balance() const;  ///< max(|f|, |m|/L) [N]
  [[nodiscard]] double largest_distance()
      const;  ///< of coincidence |g|, alignment L|h| and conditions [mm]
  [[nodiscard]] double largest_gap() const;  ///< |g| [mm]

 private:
  const Model& model_;
  Parameters parameters_;
  LineElementBlock elements_;
  ContactPotentials potentials_;
  double pull_ = 0;
  RigidTransform X_;
  Wrench wrench_;
  std::vector<ContactLinearization> contacts_;
  std::vector<ConditionDerivatives> conditions_;
  double force_scale_ = 0;
  int zero_element_ = -1;
};

class Newton {
 public:
  explicit Newton(const Model& model, NewtonOptions options = {});

  /// Improves the state in place. Allocates nothing once the state has its size.
  NewtonReport solve(EquilibriumState& state, const Drive& drive);

  /// From now on solving ends, as at the limit of iterations, once contact laws have looked at so many points
  /// (ContactPotentials::looked_at): one iteration with them may take 20 ms.
  void bound_laws(long points) { most_of_laws_ = points; }

  /// Of the last solve.
  [[nodiscard]] const ResidualHistory& residuals() const { return residuals_; }

  /// The system at the last state assembled.
  [[nodiscard]] const NewtonSystem& system() const { return system_; }
  [[nodiscard]] NewtonSystem& system() { return system_; }

  /// Where the last solve that did not converge ended, and for which drive.
  struct Stopped {
    EquilibriumState state;
    Drive drive;
  };
  [[nodiscard]] const Stopped& stopped() const { return stopped_; }

 private:
  NewtonReport iterate(EquilibriumState& state, const Drive& drive);
  bool factor_softened(const EquilibriumState& state, double* step);
  [[nodiscard]] bool is_exhausted(const NewtonReport& report) const;

  const Model& model_;
  NewtonOptions options_;
  long most_of_laws_ = std::numeric_limits<long>::max();
  NewtonSystem system_;
  SmallLu matrix_;
  ResidualHistory residuals_;
  Stopped stopped_;
};

}  // namespace condyle
