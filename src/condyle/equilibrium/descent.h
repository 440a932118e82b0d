#pragma once

/// The way to an equilibrium from afar, for poses where Newton on a guessed set of contacts does
/// not succeed.
///
/// Minimises the energy of line elements and loads over the admissible poses: sequential quadratic
/// programmes in the six components of a step, with every local minimum of the gap
/// (contact_search.h) as a constraint, found anew at every iteration, plus points where a gap was
/// lowest in earlier iterations, which go on as material points: curved contacts split, merge and
/// vanish while the pose moves, and non-penetration at any material point is always a valid
/// constraint. Steps are accepted by an l1 merit with a second-order correction, so curved contacts
/// do not stall it (Maratos effect). Loads that have no potential enter the merit by their work
/// over the step.
///
/// Whenever the set of carrying contacts settles, Newton takes over; the caller verifies.

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/newton.h"
#include "condyle/equilibrium/small_qp.h"
#include "condyle/equilibrium/work.h"

namespace condyle {

struct DescentOptions {
  int max_steps = 150;
  double longest_step = 0.1;  ///< of one iteration, in units of L
};

struct DescentReport {
  bool converged = false;  ///< Newton converged from here and the caller accepted it
  bool ran_away = false;   ///< the pose left every reasonable place: nothing carries the load
  int steps = 0;           ///< quadratic programmes solved
  int iterations = 0;      ///< those and the ones of the Newton attempts within
  int searches = 0;        ///< for contacts of one pair
  double step = 0;         ///< last accepted step [mm]
  NewtonReport newton;     ///< of the last attempt
};

class Descent {
 public:
  Descent(const Model& model,
          std::vector<ContactSearch>& searches,
          Newton& newton,
          DescentOptions options = {});

  using Accept = std::function<bool(EquilibriumState&)>;
  using GoesOn = std::function<bool()>;

  /// Improves `state` in place. `drive` must stay until it returns; `accept` says whether a Newton
  /// solution is one (no pull, no overlap). Given up after `max_steps` or as much work; and where
  /// `goes_on`, asked once after a few steps, says so.
  DescentReport solve(EquilibriumState& state,
                      const Drive& drive,
                      const Accept& accept,
                      const GoesOn& goes_on,
                      const Work& most);

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// A gap that must not become negative (or, for a contact held closed, must vanish).
  struct Constraint {
    int pair;
    ContactPlaces places;
    double gap;      ///< [mm]
    Vector6 row;     ///< ∂gap in scaled components (da, L dπ)
    bool refined;    ///< an isolated minimum of the gap, else a material point
    bool bilateral;  ///< held closed
  };
  /// The quadratic programme at a pose and which of its rows is which constraint.
  struct Programme {
    SmallQp qp;
    std::vector<std::size_t> one_sided, two_sided;
    double force_scale = 0, stiffness_scale = 0;  ///< [N], [N/mm]
  };
  /// Multipliers of a programme, in the order of the constraints and of the conditions.
  struct Multipliers {
    std::vector<double> p, sigma;
    double largest = 0;  ///< [N]
  };

  void start(const RigidTransform& X);
  bool start_anew();
  bool iterate(const Accept& accept, DescentReport& report);
  void gather(const RigidTransform& X, std::vector<Constraint>& constraints);
  void gather_within(double ahead, const RigidTransform& X, std::vector<Constraint>& constraints);
  void add_memory(int pair,
                  std::size_t first,
                  const RigidTransform& X,
                  std::vector<Constraint>& constraints);
  void remember(const std::vector<Constraint>& constraints);
  [[nodiscard]] Constraint constrain(int pair,
                                     const ContactPlaces& places,
                                     const RigidTransform& X) const;
  void set_forces(Programme& programme);
  void set_rows(Programme& programme) const;
  bool add_contact_curvature(Programme& programme, const SmallQpSolution& solution) const;
  [[nodiscard]] Multipliers multipliers(const Programme& programme,
                                        const SmallQpSolution& solution) const;
  [[nodiscard]] Vector6 corrected_step(const Programme& programme,
                                       const Vector6& step,
                                       const RigidTransform& to,
                                       const std::vector<Constraint>& there) const;
  [[nodiscard]] Vector6 step_within_reach(Programme& programme) const;
  void take_step(const Programme& programme, const Vector6& step, DescentReport& report);
  bool try_newton(const Multipliers& multipliers,
                  const std::vector<Constraint>& constraints,
                  const Accept& accept,
                  DescentReport& report);
  bool stays_refused(const RigidTransform& found);
  [[nodiscard]] const Parameters& parameters() const { return newton_.system().parameters(); }
  [[nodiscard]] ConditionDerivatives condition(std::size_t i, const RigidTransform& X) const {
    return evaluate(model_.conditions[i], drive_->values[i], X);
  }
  [[nodiscard]] double violation(const std::vector<Constraint>& constraints,
                                 const RigidTransform& X) const;
  [[nodiscard]] double energy_change(const RigidTransform& from, const RigidTransform& to);

  const Model& model_;
  std::vector<ContactSearch>& searches_;
  Newton& newton_;
  DescentOptions options_;
  const Drive* drive_ = nullptr;  ///< of the pose under way
  EquilibriumState result_;
  RigidTransform X_;
  std::vector<Constraint> constraints_, trial_;
  std::vector<std::pair<int, Place>> memory_;  ///< pair and place on A
  std::vector<GapMinimum> minima_;
  std::vector<double> paths_, paths_from_, paths_to_;  ///< kept by the paths of line elements
  double reach_ = 0;                                   ///< longest step allowed now [mm]
  double penalty_ = 0;                                 ///< weight of a violation in the merit [N]
  int patience_ = 0;                                   ///< iterations before Newton is tried again
  int searches_made_ = 0;
  bool has_forgotten_ = false;             ///< the material points, once
  std::optional<RigidTransform> refused_;  ///< the last equilibrium that was not accepted
};

}  // namespace condyle
