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

#include <vector>

#include "condyle/network/constraint_row.h"
#include "condyle/network/motion.h"
#include "condyle/network/multiplier_solver.h"
#include "condyle/network/path_lines.h"
#include "condyle/network/settle_contacts.h"

namespace condyle {

class NetworkEquations {
 public:
  /// Throws InputError for an inconsistent graph. Keeps a reference.
  explicit NetworkEquations(const Network& network);

  [[nodiscard]] const Network& network() const { return network_; }
  [[nodiscard]] const NetworkGraph& graph() const { return graph_; }

  /// Throws InputError for a body without mass, which has a place in statics but not in dynamics.
  void require_mass() const;

  /// Kinematics, wrenches and constraint rows; settles the contacts, or only the closed ones, which
  /// is all that solve() asks for. False where a contact is lost or a line has no length.
  bool assemble(NetworkState& state, bool open_contacts_too = true);

  /// Forgets the states before: contacts are settled from their places alone. `paths` is what the paths
  /// of lines keep.
  void begin_anew(const std::vector<double>& paths);

  /// One contact that is followed, at the state's pose; false where it is lost.
  bool settle(std::size_t contact, NetworkState& state);
  /// The rate of its gap at the state at which it was settled [mm/s].
  [[nodiscard]] double settled_gap_rate(std::size_t contact, const NetworkState& state) const;

  /// Accelerations and multipliers, after assemble(). False for dependent constraints.
  bool solve();

  /// Corrections that put the state back on its constraints, after assemble(): of the pose
  /// (translation of the reference port, rotation vector) and of the twist, six for each body.
  [[nodiscard]] Eigen::VectorXd position_correction() const;
  [[nodiscard]] Eigen::VectorXd velocity_correction() const;
  /// The same for twists `twists` at poses `moved` from those assembled (Kinematics::displacement),
  /// to first order in what they differ.
  [[nodiscard]] Eigen::VectorXd position_correction_after(const Eigen::VectorXd& moved) const;
  [[nodiscard]] Eigen::VectorXd velocity_correction_after(const Eigen::VectorXd& moved,
                                                          const Eigen::VectorXd& twists) const;
  /// What is left of small motions and changes of the twists when they are put onto the
  /// constraints.
  void keep_admissible(Eigen::VectorXd& motion, Eigen::VectorXd& change) const;
  /// The change of the twists by impulses that give each row the rate `after`; `impulse` is the
  /// multiplier.
  [[nodiscard]] Eigen::VectorXd impact(const Eigen::VectorXd& after,
                                       Eigen::VectorXd& impulse) const;

  // At the state last assembled:
  [[nodiscard]] const std::vector<ConstraintRow>& rows() const { return rows_; }
  [[nodiscard]] const Eigen::MatrixXd& jacobian() const { return J_; }
  [[nodiscard]] Eigen::VectorXd rates() const;  ///< J x of all rows
  [[nodiscard]] const Kinematics& kinematics() const { return at_; }
  /// w = Σ K_j y_j of all that is no constraint; the statics of a network is w - Jᵀ μ = 0.
  [[nodiscard]] const Eigen::VectorXd& wrenches() const { return wrenches_; }
  [[nodiscard]] const std::vector<LineState>& lines() const { return lines_; }
  /// What the paths of lines keep (PathLines::kept).
  [[nodiscard]] const std::vector<double>& paths() const { return path_lines_.kept(); }
  /// The last line for which an assembly failed, since it had no length or no path, and when [s].
  struct LostLine {
    int line = -1;
    double t = 0;
  };
  [[nodiscard]] const LostLine& lost_line() const { return lost_line_; }
  [[nodiscard]] const ContactLinearization& contact(std::size_t i) const { return contacts_[i].at; }
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
  /// A chord whose wrench a port of a body takes in.
  struct Feed {
    int body, vertex, edge;
    double sign;
  };
  void list_feeds();
  bool add_lines(double t);
  bool add_path_line(std::size_t line);
  void add_forces(const NetworkState& state);
  void add_potentials(const NetworkState& state);
  void collect_wrenches();
  void fill_jacobian();
  void set_inertia(const NetworkState& state);
  void factor_inertia();
  [[nodiscard]] Eigen::VectorXd inverse_inertia(const Eigen::VectorXd& w) const;
  [[nodiscard]] Eigen::VectorXd prescribed_rates() const;
  [[nodiscard]] Eigen::VectorXd turned(const Eigen::VectorXd& moved) const;

  const Network& network_;
  NetworkGraph graph_;
  Kinematics at_;
  std::vector<Feed> feeds_;
  EdgeVariables through_;  ///< of the chords that are no constraints
  std::vector<InertiaTerms> inertia_;
  std::vector<Eigen::Matrix3d> inverse_J_;  ///< of each body about its mass centre, body frame
  std::vector<Matrix6> inverse_P_;
  std::vector<LineState> lines_;
  PathLines path_lines_;
  LostLine lost_line_;
  std::vector<SettledContact> contacts_;
  std::vector<ConstraintRow> rows_;
  MultiplierSolver solver_;
  Eigen::VectorXd wrenches_, accelerations_, multipliers_;
  Eigen::MatrixXd J_, J_weighted_, compliance_;  ///< J, P⁻¹ Jᵀ, J P⁻¹ Jᵀ
};

}  // namespace condyle
