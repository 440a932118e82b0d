#pragma once

/// The equations of a network at one state, assembled along its graph.
///
/// Chords of the graph are springs, dampers, loads and constraints; their wrenches reach the ports
/// of the bodies through the fundamental cut-sets, y_port = Σ ± y_chord, and with the terminal
/// equations of the bodies remain
///     P da = w - Jᵀ μ - Q - u,   J da + bias = rate of what is prescribed,
/// w = Σ K_j y_j at the reference ports. Row k of J is the direction d_k of a constraint, carried
/// to the reference ports, and its edge has y = μ_k d_k: contacts (force -μ along the normal), ball
/// joints, conditions (μ is their σ), and driven ports of bodies.

#include <Eigen/Core>

#include <limits>
#include <vector>

#include "elements/contact.h"
#include "network/network_graph.h"
#include "network/rigid_body_component.h"

namespace condyle {

/// One scalar constraint: direction.x_edge + ... = rate.
struct ConstraintRow {
  int edge = -1;
  int vertex_to = 0, vertex_from = 0;
  Vector6 direction = Vector6::Zero();
  double value = 0;  ///< what has to vanish [mm] or [rad]
  double rate = 0;   ///< direction.(twist to - twist from) has to be this
  double acceleration = 0;
  double bias = 0;  ///< of the second derivative: all that is not J times acceleration
  int contact = -1, condition = -1;
};

struct LineState {
  double length = 0, rate = 0;   ///< [mm], [mm/s]
  double force = 0, energy = 0;  ///< [N], [N mm]
  double dissipation = 0;        ///< [N mm/s]
};

struct EnergySum {
  double kinetic = 0, gravity = 0, elastic = 0;  ///< [N mm]
  double dissipation = 0;                        ///< [N mm/s]
  double driver_power = 0;                       ///< [N mm/s], after solve()
  [[nodiscard]] double stored() const { return kinetic + gravity + elastic; }
};

class NetworkEquations {
 public:
  /// Throws InputError for an inconsistent graph. Keeps a reference.
  explicit NetworkEquations(const Network& network);

  [[nodiscard]] const Network& network() const { return network_; }
  [[nodiscard]] const NetworkGraph& graph() const { return graph_; }

  /// Throws InputError for a body without mass, which has a place in statics but not in dynamics.
  void require_mass() const;

  /// Kinematics, wrenches and constraint rows; settles the contacts. False where a contact is lost
  /// or a line has no length.
  bool assemble(NetworkState& state);

  /// Accelerations and multipliers, after assemble(). False for dependent constraints.
  bool solve();

  /// Corrections that put the state back on its constraints, after assemble(): of the pose
  /// (translation of the reference port, rotation vector) and of the twist, six for each body.
  [[nodiscard]] Eigen::VectorXd position_correction() const;
  [[nodiscard]] Eigen::VectorXd velocity_correction() const;
  /// The change of the twists by impulses that give each row the rate `after`; `impulse` is the
  /// multiplier.
  [[nodiscard]] Eigen::VectorXd impact(const Eigen::VectorXd& after,
                                       Eigen::VectorXd& impulse) const;

  // At the state last assembled:
  [[nodiscard]] const std::vector<ConstraintRow>& rows() const { return rows_; }
  [[nodiscard]] const Eigen::MatrixXd& jacobian() const { return J_; }
  [[nodiscard]] Eigen::VectorXd rates() const;  ///< J x of all rows
  [[nodiscard]] const Eigen::VectorXd& twists() const { return twists_; }
  /// w = Σ K_j y_j of all that is no constraint; the statics of a network is w - Jᵀ μ = 0.
  [[nodiscard]] const Eigen::VectorXd& wrenches() const { return wrenches_; }
  [[nodiscard]] const std::vector<LineState>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<ContactLinearization>& contacts() const { return contacts_; }
  /// n.(velocity of the contact point of the body) of any contact [mm/s]
  [[nodiscard]] double gap_rate(std::size_t contact) const;

  // After solve():
  [[nodiscard]] const Eigen::VectorXd& accelerations() const { return accelerations_; }
  [[nodiscard]] const Eigen::VectorXd& multipliers() const { return multipliers_; }
  /// Of a contact [N], > 0 pushes; 0 where open.
  [[nodiscard]] double contact_force(std::size_t contact) const;
  /// n.(relative acceleration) of a contact, closed or not [mm/s²].
  [[nodiscard]] double gap_acceleration(std::size_t contact) const;
  [[nodiscard]] EnergySum energies() const;
  /// What the drivers give [N mm/s].
  [[nodiscard]] double driver_power() const;

  /// Across and through of all edges after solve(); those of the reference edges from the terminal
  /// equations of the bodies, so that Tellegen's sum checks the solution.
  void edge_variables(EdgeVariables& across, EdgeVariables& through) const;

 private:
  void place_vertices(const NetworkState& state);
  bool add_lines();
  void add_forces(const NetworkState& state);
  void add_rows(const NetworkState& state);
  [[nodiscard]] ConstraintRow contact_row(std::size_t contact) const;
  void add_point_rows(int edge, int to, int from, const Eigen::Vector3d& apart);
  void add_driven_rows(std::size_t motion);
  [[nodiscard]] Eigen::Vector3d port_point(int port) const;
  void add_condition_row(std::size_t i, const NetworkState& state);
  void collect_wrenches();
  void fill_jacobian();
  void factor_inertia();
  template <typename Add>
  void carry_row(const ConstraintRow& row, Add add) const;
  [[nodiscard]] Eigen::VectorXd inverse_inertia(const Eigen::VectorXd& w) const;
  [[nodiscard]] Eigen::VectorXd multipliers_for(const Eigen::VectorXd& right_side) const;
  [[nodiscard]] Vector6 convective(int vertex) const;

  const Network& network_;
  NetworkGraph graph_;
  std::vector<DrivenPoint> driven_;  ///< of each across driver
  std::vector<RigidTransform> poses_;
  std::vector<Eigen::Vector3d> points_;  ///< of each vertex, ground frame
  std::vector<Eigen::Vector3d> arms_;    ///< from the reference port of its body
  EdgeVariables vertex_twist_;
  EdgeVariables through_;  ///< of the chords that are no constraints
  std::vector<InertiaTerms> inertia_;
  std::vector<Matrix6> inverse_P_;
  std::vector<LineState> lines_;
  std::vector<ContactLinearization> contacts_;
  std::vector<ConstraintRow> rows_;
  Eigen::VectorXd twists_, wrenches_, free_accelerations_, accelerations_, multipliers_;
  Eigen::MatrixXd J_, J_weighted_, compliance_;  ///< J, P⁻¹ Jᵀ, J P⁻¹ Jᵀ
};

}  // namespace condyle
