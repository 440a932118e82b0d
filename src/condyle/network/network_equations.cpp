#include "condyle/network/network_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>

#include "condyle/elements/line_element.h"
#include "condyle/input_error.h"
#include "condyle/math/no_number.h"
#include "condyle/math/simd.h"

namespace condyle {
namespace {

/// Calls add(body, block) for each body that the row moves.
template <typename Add>
void carry_row(const NetworkGraph& graph, const Kinematics& at, const ConstraintRow& row, Add add) {
  const auto carry = [&](int vertex, double sign) {
    const int body = graph.vertices[vertex].body;
    if (body >= 0) add(body, sign * wrench_at_reference(row.direction, at.arm(vertex)));
  };
  carry(row.vertex_to, 1);
  carry(row.vertex_from, -1);
}

bool is_constraint(EdgeKind kind) { return kind == EdgeKind::kConstraint; }

}  // namespace

NetworkEquations::NetworkEquations(const Network& network)
    : network_(network), graph_(make_graph(network)), at_(network, graph_), path_lines_(network) {
  through_ = EdgeVariables::Zero(6, static_cast<Eigen::Index>(graph_.graph.edges.size()));
  inertia_.resize(network.bodies.size());
  inverse_P_.resize(network.bodies.size());
  for (const NetworkBody& body : network.bodies)
    inverse_J_.push_back(
        body.mass && !body.point_mass
            ? Eigen::Matrix3d(body.mass->inertia.llt().solve(Eigen::Matrix3d::Identity()))
            : Eigen::Matrix3d::Zero());
  lines_.resize(network.lines.size());
  contacts_.resize(network.contacts.size());
  list_feeds();
}

/// Of the cut-sets y_port = Σ ± y_chord those that are no constraints.
void NetworkEquations::list_feeds() {
  const LinearGraph& graph = graph_.graph;
  for (std::size_t b = 0; b < graph_.tree.branches.size(); ++b) {
    const int vertex = graph.edges[graph_.tree.branches[b]].to;
    const int body = graph_.vertices[vertex].body;
    if (body < 0) continue;
    for (const SignedEdge& chord : graph_.tree.cut_sets[b])
      if (!is_constraint(graph.edges[chord.edge].kind))
        feeds_.push_back({body, vertex, chord.edge, static_cast<double>(chord.sign)});
  }
}

void NetworkEquations::begin_anew(const std::vector<double>& paths) {
  contacts_.assign(contacts_.size(), SettledContact());
  path_lines_.keep(paths);
  lost_line_ = LostLine();
}

void NetworkEquations::require_mass() const {
  for (const NetworkBody& body : network_.bodies) {
    if (!body.mass || !(body.mass->mass > 0))
      throw InputError("network: body \"" + body.name +
                       "\" has no mass, expected density, or mass, center and inertia");
  }
}

/// dL/dt = -w·(velocity of the port, angular velocity of the body), w the wrench of 1 N about the port.
bool NetworkEquations::add_path_line(std::size_t line) {
  const GraphEdge& edge = graph_.graph.edges[graph_.line_edge[line]];
  const PathLines::Pull pull = path_lines_.pull(line, at_);
  if (!(pull.length > kLeastLength)) return false;
  const double rate = -pull.wrench.dot(at_.vertex_twist(edge.to));
  lines_[line] = line_state(network_.lines[line], pull.length, rate);
  through_.col(graph_.line_edge[line]) = -lines_[line].force * pull.wrench;
  return true;
}

CONDYLE_FMA_CLONE
bool NetworkEquations::add_lines(double t) {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const LineComponent& line = network_.lines[i];
    if (line.path) {
      if (add_path_line(i)) continue;
      lost_line_ = {static_cast<int>(i), t};
      return false;
    }
    const GraphEdge& edge = graph_.graph.edges[graph_.line_edge[i]];
    const Eigen::Vector3d d = at_.point(line.to) - at_.point(line.from);
    const double length = std::sqrt(d.squaredNorm());
    if (!(length > kLeastLength)) {
      lost_line_ = {static_cast<int>(i), t};
      return false;
    }
    const Eigen::Vector3d e = d * (1 / length);
    const double rate = e.dot(at_.velocity(edge.to) - at_.velocity(edge.from));
    lines_[i] = line_state(line, length, rate);
    through_.col(graph_.line_edge[i]).head<3>() = lines_[i].force * e;
  }
  return true;
}

void NetworkEquations::add_forces(const NetworkState& state) {
  for (std::size_t i = 0; i < network_.forces.size(); ++i) {
    const ForceDriver& driver = network_.forces[i];
    const double scale = driver.scale ? driver.scale(state.t) : driver.load.scale;
    Wrench wrench;
    add_load(driver.load, scale, state.bodies[driver.body].X, wrench);
    through_.col(graph_.force_edge[i]) << -wrench.f, -wrench.m;
  }
}

void NetworkEquations::add_potentials(const NetworkState& state) {
  for (std::size_t i = 0; i < network_.potentials.size(); ++i) {
    const PotentialComponent& contact = network_.potentials[i];
    Wrench wrench;
    contact.potential->add_to(state.bodies[contact.body].X, wrench);
    through_.col(graph_.potential_edge[i]) << -wrench.f, -wrench.m;
  }
}

/// Σ K_j y_j over the ports of each body.
CONDYLE_FMA_CLONE
void NetworkEquations::collect_wrenches() {
  wrenches_.setZero(at_.twists().size());
  for (const Feed& feed : feeds_) {
    const Eigen::Vector3d f = feed.sign * through_.col(feed.edge).head<3>();
    wrenches_.segment<3>(6 * feed.body) += f;
    wrenches_.segment<3>(6 * feed.body + 3) +=
        at_.arm(feed.vertex).cross(f) + feed.sign * through_.col(feed.edge).tail<3>();
  }
}

void NetworkEquations::fill_jacobian() {
  J_.setZero(static_cast<Eigen::Index>(rows_.size()), at_.twists().size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    auto row = J_.row(static_cast<Eigen::Index>(k));
    carry_row(graph_, at_, rows_[k], [&](int body, const Vector6& block) {
      row.segment<6>(6 * body) += block.transpose();
    });
  }
}

bool NetworkEquations::assemble(NetworkState& state, bool open_contacts_too) {
  if (!settle_contacts(network_, open_contacts_too, state, contacts_)) return false;
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (state.contacts[i].followed) at_.set_contact_point(i, contacts_[i].at.A.c);
  at_.place(state);
  if (!add_lines(state.t)) return false;
  add_forces(state);
  add_potentials(state);
  constraint_rows(network_, graph_, at_, contacts_, state, rows_);
  collect_wrenches();
  fill_jacobian();
  set_inertia(state);
  factor_inertia();
  return wrenches_.allFinite();
}

bool NetworkEquations::settle(std::size_t contact, NetworkState& state) {
  const ContactComponent& component = network_.contacts[contact];
  return settle_contact(component, state.bodies[component.body].X, network_.length,
                        state.contacts[contact], contacts_[contact]);
}

double NetworkEquations::settled_gap_rate(std::size_t contact, const NetworkState& state) const {
  const int b = network_.contacts[contact].body;
  const BodyState& body = state.bodies[b];
  const ContactLinearization& at = contacts_[contact].at;
  const Eigen::Vector3d arm = body.X.R * (at.A.c - network_.bodies[b].reference);
  return at.B.n.dot(body.v + body.omega.cross(arm));
}

CONDYLE_FMA_CLONE
void NetworkEquations::set_inertia(const NetworkState& state) {
  for (std::size_t b = 0; b < network_.bodies.size(); ++b) {
    const NetworkBody& body = network_.bodies[b];
    if (!body.mass) {
      inverse_P_[b].setConstant(kNoNumber);
      continue;
    }
    const Eigen::Matrix3d& R = state.bodies[b].X.R;
    inertia_[b] = inertia_terms(*body.mass, body.reference, R, at_.twist(static_cast<int>(b)),
                                network_.gravity);
    if (body.point_mass) {
      // A point mass does not turn; any inertia keeps its matrix regular.
      inertia_[b].P.bottomRightCorner<3, 3>().setIdentity();
      inverse_P_[b] = inertia_[b].P.llt().solve(Matrix6::Identity());
    } else {
      inverse_P_[b] = condyle::inverse_inertia(body.mass->mass, inverse_J_[b], R, inertia_[b].arm);
    }
  }
}

CONDYLE_FMA_CLONE
void NetworkEquations::factor_inertia() {
  J_weighted_.resize(J_.cols(), J_.rows());
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    for (Eigen::Index k = 0; k < J_.rows(); ++k)
      J_weighted_.col(k).segment<6>(row).noalias() =
          inverse_P_[b] * J_.row(k).segment<6>(row).transpose();
  }
  compliance_ = J_.lazyProduct(J_weighted_);  // a few rows: the blocked product costs more
  solver_.factor(compliance_);
}

Eigen::VectorXd NetworkEquations::inverse_inertia(const Eigen::VectorXd& w) const {
  Eigen::VectorXd a(w.size());
  for (std::size_t b = 0; b < inverse_P_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    a.segment<6>(row).noalias() = inverse_P_[b] * w.segment<6>(row);
  }
  return a;
}

bool NetworkEquations::solve() {
  Eigen::VectorXd load = wrenches_;
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    load.segment<6>(row) -= inertia_[b].Q + inertia_[b].u;
    if (network_.bodies[b].point_mass) load.segment<3>(row + 3).setZero();
  }
  accelerations_ = inverse_inertia(load);
  Eigen::VectorXd excess = J_.lazyProduct(accelerations_);
  for (Eigen::Index k = 0; k < J_.rows(); ++k) {
    const ConstraintRow& row = rows_[static_cast<std::size_t>(k)];
    excess[k] += row.bias - row.acceleration;
  }
  multipliers_ = solver_.solve(excess);
  accelerations_ -= J_weighted_.lazyProduct(multipliers_);
  return accelerations_.allFinite();
}

double NetworkEquations::gap_rate(std::size_t contact) const {
  const int vertex = graph_.graph.edges[graph_.contact_edge[contact]].to;
  return contacts_[contact].at.B.n.dot(at_.velocity(vertex));
}

double NetworkEquations::contact_force(std::size_t contact) const {
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].contact == static_cast<int>(contact))
      return -multipliers_[static_cast<Eigen::Index>(k)];
  return 0;
}

double NetworkEquations::gap_acceleration(std::size_t contact) const {
  const ConstraintRow row = contact_row(network_, graph_, at_, contacts_[contact].at, contact);
  double acceleration = row.bias;
  carry_row(graph_, at_, row, [&](int body, const Vector6& block) {
    acceleration += block.dot(accelerations_.segment<6>(6 * body));
  });
  return acceleration;
}

}  // namespace condyle
