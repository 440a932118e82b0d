#include "network/network_equations.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

#include "elements/line_element.h"
#include "input_error.h"
#include "network/settle_contacts.h"

namespace condyle {
namespace {

Vector6 force_only(const Eigen::Vector3d& f) {
  Vector6 y = Vector6::Zero();
  y.head<3>() = f;
  return y;
}

/// The force along a line, its energy and its loss.
LineState line_state(const LineComponent& line, double length, double rate) {
  LineState s{length, rate, 0, 0, 0};
  double elastic = 0, viscous = line.damping * rate;
  if (line.law) {
    const Tension t = tension(*line.law, length);
    elastic = t.force;
    s.energy = t.energy;
    if (line.viscous_time > 0) {
      double share = line.viscous_time * t.slope * rate;
      if (elastic >= 0) share = std::max(share, -elastic);
      viscous += share;
    }
  }
  s.force = elastic + viscous;
  s.dissipation = viscous * rate;
  return s;
}

}  // namespace

NetworkEquations::NetworkEquations(const Network& network)
    : network_(network), graph_(make_graph(network)) {
  const std::size_t vertices = graph_.vertices.size(), bodies = network.bodies.size();
  driven_.resize(network.motions.size());
  points_.assign(vertices, Eigen::Vector3d::Zero());
  arms_ = points_;
  vertex_twist_ = EdgeVariables::Zero(6, static_cast<Eigen::Index>(vertices));
  through_ = EdgeVariables::Zero(6, static_cast<Eigen::Index>(graph_.graph.edges.size()));
  inertia_.resize(bodies);
  inverse_P_.resize(bodies);
  lines_.resize(network.lines.size());
  contacts_.resize(network.contacts.size());
  twists_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * bodies));
}

void NetworkEquations::require_mass() const {
  for (const NetworkBody& body : network_.bodies) {
    if (!body.mass || !(body.mass->mass > 0))
      throw InputError("network: body \"" + body.name +
                       "\" has no mass, expected density, or mass, center and inertia");
  }
}

void NetworkEquations::place_vertices(const NetworkState& state) {
  for (std::size_t i = 0; i < driven_.size(); ++i) driven_[i] = network_.motions[i].motion(state.t);
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    twists_.segment<3>(row) = state.bodies[b].v;
    twists_.segment<3>(row + 3) = state.bodies[b].omega;
  }
  for (std::size_t v = 1; v < graph_.vertices.size(); ++v) {
    const NetworkVertex& vertex = graph_.vertices[v];
    const auto column = static_cast<Eigen::Index>(v);
    if (vertex.body == kNoBody) {
      points_[v] = vertex.driver < 0 ? vertex.at : driven_[vertex.driver].position;
      vertex_twist_.col(column).setZero();
      if (vertex.driver >= 0) vertex_twist_.col(column).head<3>() = driven_[vertex.driver].velocity;
      continue;
    }
    const RigidTransform& X = state.bodies[vertex.body].X;
    points_[v] = X * vertex.at;
    arms_[v] = X.R * (vertex.at - network_.bodies[vertex.body].reference);
    vertex_twist_.col(column) = twist_at_port(twists_.segment<6>(6 * vertex.body), arms_[v]);
  }
}

bool NetworkEquations::add_lines() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const LineComponent& line = network_.lines[i];
    const GraphEdge& edge = graph_.graph.edges[graph_.line_edge[i]];
    const Eigen::Vector3d d = port_point(line.to) - port_point(line.from);
    const double length = d.norm();
    if (!(length > kLeastLength)) return false;
    const Eigen::Vector3d e = d / length;
    const double rate =
        e.dot(vertex_twist_.col(edge.to).head<3>() - vertex_twist_.col(edge.from).head<3>());
    lines_[i] = line_state(line, length, rate);
    through_.col(graph_.line_edge[i]) = force_only(lines_[i].force * e);
  }
  return true;
}

void NetworkEquations::add_forces(const NetworkState& state) {
  for (std::size_t i = 0; i < network_.forces.size(); ++i) {
    const ForceDriver& driver = network_.forces[i];
    Wrench wrench;
    add_load(driver.load, state.bodies[driver.body].X, wrench);
    const double scale = driver.scale ? driver.scale(state.t) : 1;
    through_.col(graph_.force_edge[i]) << -scale * wrench.f, -scale * wrench.m;
  }
}

/// Acceleration of a vertex that is left when the body's own acceleration is taken away.
Vector6 NetworkEquations::convective(int v) const {
  const NetworkVertex& vertex = graph_.vertices[v];
  if (vertex.body == kNoBody)
    return force_only(vertex.driver < 0 ? Eigen::Vector3d(0, 0, 0)
                                        : driven_[vertex.driver].acceleration);
  if (vertex.body < 0) return Vector6::Zero();
  const Eigen::Vector3d w = twists_.segment<3>(6 * vertex.body + 3);
  return force_only(w.cross(w.cross(arms_[v])));
}

/// A row along n: n.(twist of the contact point) = 0. The normal turns and the point wanders as the
/// contact rolls and slides: dn/dt = -K dc/dt, ds/dt = dc/dt - v.
ConstraintRow NetworkEquations::contact_row(std::size_t i) const {
  const ContactComponent& component = network_.contacts[i];
  const ContactLinearization& contact = contacts_[i];
  const int edge = graph_.contact_edge[i], vertex = graph_.graph.edges[edge].to;
  const Eigen::Vector3d w = twists_.segment<3>(6 * component.body + 3);
  const Eigen::Vector3d v_c = vertex_twist_.col(vertex).head<3>();
  const Eigen::Vector3d v_O = v_c - w.cross(contact.s);
  const Eigen::Vector3d dc = contact.D1() * v_O + contact.D2() * w;
  const Eigen::Vector3d arm_O = arms_[vertex] - contact.s;
  const Eigen::Vector3d& n = contact.B.n;
  ConstraintRow row;
  row.edge = edge;
  row.vertex_to = vertex;
  row.direction.head<3>() = n;
  row.value = contact.gap();
  row.bias = n.dot(w.cross(w.cross(arm_O)) + w.cross(dc - v_O)) - (contact.B.K * dc).dot(v_c);
  row.contact = static_cast<int>(i);
  return row;
}

void NetworkEquations::add_point_rows(int edge, int to, int from, const Eigen::Vector3d& apart) {
  const Vector6 bias = convective(to) - convective(from);
  for (int k = 0; k < 3; ++k) {
    ConstraintRow row;
    row.edge = edge;
    row.vertex_to = to;
    row.vertex_from = from;
    row.direction[k] = 1;
    row.value = apart[k];
    row.bias = bias[k];
    rows_.push_back(row);
  }
}

Eigen::Vector3d NetworkEquations::port_point(int port) const {
  const int vertex = graph_.port_vertex[port];
  return vertex == 0 ? network_.ports[port].at : points_[vertex];
}

void NetworkEquations::add_driven_rows(std::size_t i) {
  const int vertex = graph_.port_vertex[network_.motions[i].port];
  if (graph_.vertices[vertex].body < 0) return;
  const std::size_t first = rows_.size();
  add_point_rows(graph_.vertices[vertex].edge, vertex, 0, points_[vertex] - driven_[i].position);
  for (int axis = 0; axis < 3; ++axis) {
    ConstraintRow& row = rows_[first + static_cast<std::size_t>(axis)];
    row.rate = driven_[i].velocity[axis];
    row.acceleration = driven_[i].acceleration[axis];
  }
}

void NetworkEquations::add_condition_row(std::size_t i, const NetworkState& state) {
  const ConditionComponent& component = network_.conditions[i];
  KinematicCondition condition = component.condition;
  ConstraintRow row;
  if (component.value) {
    const DrivenValue driven = component.value(state.t);
    condition.value = driven.value;
    row.rate = driven.rate;
    row.acceleration = driven.acceleration;
  }
  const ConditionDerivatives k = evaluate(condition, state.bodies[component.body].X);
  row.edge = graph_.condition_edge[i];
  row.vertex_to = graph_.graph.edges[row.edge].to;
  row.direction << k.alpha, k.eta;
  row.value = k.k;
  const Vector6 x = vertex_twist_.col(row.vertex_to);
  const Eigen::Vector3d v = x.head<3>(), w = x.tail<3>();
  row.bias = row.direction.dot(convective(row.vertex_to)) + (k.D1 * v + k.D2 * w).dot(v) +
             (k.D3 * v + k.D4 * w).dot(w);
  row.condition = static_cast<int>(i);
  rows_.push_back(row);
}

void NetworkEquations::add_rows(const NetworkState& state) {
  rows_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (state.contacts[i].closed) rows_.push_back(contact_row(i));
  for (std::size_t i = 0; i < network_.joints.size(); ++i) {
    const BallJoint& joint = network_.joints[i];
    const GraphEdge& edge = graph_.graph.edges[graph_.joint_edge[i]];
    add_point_rows(graph_.joint_edge[i], edge.to, edge.from,
                   port_point(joint.to) - port_point(joint.from));
  }
  for (std::size_t i = 0; i < network_.motions.size(); ++i) add_driven_rows(i);
  for (std::size_t i = 0; i < network_.conditions.size(); ++i) add_condition_row(i, state);
}

/// Σ K_j y_j over the ports of each body, y_j from the cut-sets.
void NetworkEquations::collect_wrenches() {
  wrenches_ = Eigen::VectorXd::Zero(twists_.size());
  const LinearGraph& graph = graph_.graph;
  for (std::size_t b = 0; b < graph_.tree.branches.size(); ++b) {
    const int vertex = graph.edges[graph_.tree.branches[b]].to;
    const int body = graph_.vertices[vertex].body;
    if (body < 0 || graph_.tree.cut_sets[b].empty()) continue;
    Vector6 y = Vector6::Zero();
    for (const SignedEdge& chord : graph_.tree.cut_sets[b])
      y += chord.sign * through_.col(chord.edge);
    wrenches_.segment<6>(6 * body) += wrench_at_reference(y, arms_[vertex]);
  }
}

/// Calls add(body, block) for each body that the row moves.
template <typename Add>
void NetworkEquations::carry_row(const ConstraintRow& row, Add add) const {
  const auto carry = [&](int vertex, double sign) {
    const int body = graph_.vertices[vertex].body;
    if (body >= 0) add(body, sign * wrench_at_reference(row.direction, arms_[vertex]));
  };
  carry(row.vertex_to, 1);
  carry(row.vertex_from, -1);
}

void NetworkEquations::fill_jacobian() {
  J_.setZero(static_cast<Eigen::Index>(rows_.size()), twists_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    auto row = J_.row(static_cast<Eigen::Index>(k));
    carry_row(rows_[k], [&](int body, const Vector6& block) {
      row.segment<6>(6 * body) += block.transpose();
    });
  }
}

bool NetworkEquations::assemble(NetworkState& state) {
  if (!settle_contacts(network_, state, contacts_)) return false;
  poses_.clear();
  for (const BodyState& body : state.bodies) poses_.push_back(body.X);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    if (state.contacts[i].followed)
      graph_.vertices[graph_.graph.edges[graph_.contact_edge[i]].to].at = contacts_[i].A.c;
  place_vertices(state);
  if (!add_lines()) return false;
  add_forces(state);
  add_rows(state);
  collect_wrenches();
  fill_jacobian();
  for (std::size_t b = 0; b < network_.bodies.size(); ++b) {
    const NetworkBody& body = network_.bodies[b];
    if (!body.mass) continue;
    inertia_[b] =
        inertia_terms(*body.mass, body.reference, state.bodies[b].X.R,
                      twists_.segment<6>(static_cast<Eigen::Index>(6 * b)), network_.gravity);
    // A point mass does not turn; any inertia keeps its matrix regular.
    if (body.point_mass) inertia_[b].P.bottomRightCorner<3, 3>().setIdentity();
  }
  factor_inertia();
  return wrenches_.allFinite();
}

void NetworkEquations::factor_inertia() {
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const NetworkBody& body = network_.bodies[b];
    if (!body.mass)
      inverse_P_[b].setConstant(std::numeric_limits<double>::quiet_NaN());
    else if (body.point_mass)
      inverse_P_[b] = inertia_[b].P.llt().solve(Matrix6::Identity());
    else
      inverse_P_[b] = condyle::inverse_inertia(*body.mass, poses_[b].R, inertia_[b].arm);
  }
  J_weighted_.resize(twists_.size(), J_.rows());
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    J_weighted_.middleRows<6>(row) = inverse_P_[b].lazyProduct(J_.middleCols<6>(row).transpose());
  }
  compliance_ = J_.lazyProduct(J_weighted_);  // a few rows: the blocked product costs more
}

Eigen::VectorXd NetworkEquations::inverse_inertia(const Eigen::VectorXd& w) const {
  Eigen::VectorXd a(w.size());
  for (std::size_t b = 0; b < inverse_P_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    a.segment<6>(row) = inverse_P_[b] * w.segment<6>(row);
  }
  return a;
}

/// Solves J P⁻¹ Jᵀ μ = r, rows and columns scaled to one; dependent rows share their load.
Eigen::VectorXd NetworkEquations::multipliers_for(const Eigen::VectorXd& right_side) const {
  if (right_side.size() == 0) return right_side;
  constexpr double kNearlyDependent = 1e-5;
  const Eigen::VectorXd scale = compliance_.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * compliance_ * scale.asDiagonal();
  const Eigen::LLT<Eigen::MatrixXd> cholesky(scaled);
  if (cholesky.info() == Eigen::Success &&
      cholesky.matrixLLT().diagonal().minCoeff() > kNearlyDependent)
    return scale.cwiseProduct(cholesky.solve(scale.cwiseProduct(right_side)));
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-11);
  solver.compute(scaled);
  return scale.cwiseProduct(solver.solve(scale.cwiseProduct(right_side)));
}

bool NetworkEquations::solve() {
  Eigen::VectorXd load = wrenches_;
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    load.segment<6>(row) -= inertia_[b].Q + inertia_[b].u;
    if (network_.bodies[b].point_mass) load.segment<3>(row + 3).setZero();
  }
  free_accelerations_ = inverse_inertia(load);
  Eigen::VectorXd wanted(J_.rows());
  for (Eigen::Index k = 0; k < J_.rows(); ++k)
    wanted[k] =
        rows_[static_cast<std::size_t>(k)].acceleration - rows_[static_cast<std::size_t>(k)].bias;
  multipliers_ = multipliers_for(J_ * free_accelerations_ - wanted);
  accelerations_ = free_accelerations_ - J_weighted_ * multipliers_;
  return accelerations_.allFinite();
}

Eigen::VectorXd NetworkEquations::rates() const { return J_ * twists_; }

Eigen::VectorXd NetworkEquations::position_correction() const {
  Eigen::VectorXd value(J_.rows());
  for (Eigen::Index k = 0; k < J_.rows(); ++k) value[k] = rows_[static_cast<std::size_t>(k)].value;
  return -J_weighted_ * multipliers_for(value);
}

Eigen::VectorXd NetworkEquations::velocity_correction() const {
  Eigen::VectorXd unused, after(J_.rows());
  for (Eigen::Index k = 0; k < J_.rows(); ++k) {
    const ConstraintRow& row = rows_[static_cast<std::size_t>(k)];
    after[k] = row.rate;
    const NetworkVertex& from = graph_.vertices[row.vertex_from];
    const NetworkVertex& to = graph_.vertices[row.vertex_to];
    if (from.body == kNoBody) after[k] += row.direction.dot(vertex_twist_.col(row.vertex_from));
    if (to.body == kNoBody) after[k] -= row.direction.dot(vertex_twist_.col(row.vertex_to));
  }
  return impact(after, unused);
}

Eigen::VectorXd NetworkEquations::impact(const Eigen::VectorXd& after,
                                         Eigen::VectorXd& impulse) const {
  impulse = multipliers_for(rates() - after);
  return -J_weighted_ * impulse;
}

double NetworkEquations::gap_rate(std::size_t contact) const {
  const int vertex = graph_.graph.edges[graph_.contact_edge[contact]].to;
  return contacts_[contact].B.n.dot(vertex_twist_.col(vertex).head<3>());
}

double NetworkEquations::contact_force(std::size_t contact) const {
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].contact == static_cast<int>(contact))
      return -multipliers_[static_cast<Eigen::Index>(k)];
  return 0;
}

double NetworkEquations::gap_acceleration(std::size_t contact) const {
  const ConstraintRow row = contact_row(contact);
  double acceleration = row.bias;
  carry_row(row, [&](int body, const Vector6& block) {
    acceleration += block.dot(accelerations_.segment<6>(6 * body));
  });
  return acceleration;
}

EnergySum NetworkEquations::energies() const {
  EnergySum sum;
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const NetworkBody& body = network_.bodies[b];
    if (!body.mass) continue;
    const Vector6 x = twists_.segment<6>(static_cast<Eigen::Index>(6 * b));
    sum.kinetic += x.dot(inertia_[b].P * x) / 2;
    sum.gravity -= body.mass->mass * network_.gravity.dot(poses_[b] * body.mass->center);
  }
  for (const LineState& line : lines_) {
    sum.elastic += line.energy;
    sum.dissipation += line.dissipation;
  }
  sum.driver_power = driver_power();
  return sum;
}

double NetworkEquations::driver_power() const {
  double power = 0;
  for (std::size_t i = 0; i < network_.forces.size(); ++i) {
    const int edge = graph_.force_edge[i];
    power -= through_.col(edge).dot(vertex_twist_.col(graph_.graph.edges[edge].to));
  }
  for (std::size_t k = 0; k < rows_.size(); ++k)
    if (rows_[k].condition >= 0)
      power -= multipliers_[static_cast<Eigen::Index>(k)] * rows_[k].rate;
  if (network_.motions.empty()) return power;
  EdgeVariables across, through;
  edge_variables(across, through);
  for (const int edge : graph_.motion_edge) power -= across.col(edge).dot(through.col(edge));
  return power;
}

void NetworkEquations::edge_variables(EdgeVariables& across, EdgeVariables& through) const {
  const std::vector<GraphEdge>& edges = graph_.graph.edges;
  across.resize(6, static_cast<Eigen::Index>(edges.size()));
  for (std::size_t e = 0; e < edges.size(); ++e)
    across.col(static_cast<Eigen::Index>(e)) =
        vertex_twist_.col(edges[e].to) - vertex_twist_.col(edges[e].from);
  through = through_;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    // The edge of a driven port belongs to its body, which takes in what the row gives.
    const double sign = edges[rows_[k].edge].kind == EdgeKind::kConstraint ? 1 : -1;
    through.col(rows_[k].edge) +=
        sign * multipliers_[static_cast<Eigen::Index>(k)] * rows_[k].direction;
  }
  Eigen::VectorXd at_ports = Eigen::VectorXd::Zero(twists_.size());
  const auto add_port_wrench = [&](int edge) {
    const int vertex = edges[edge].to, body = graph_.vertices[vertex].body;
    at_ports.segment<6>(6 * body) += wrench_at_reference(through.col(edge), arms_[vertex]);
  };
  for (std::size_t b = 0; b < graph_.tree.branches.size(); ++b) {
    const int branch = graph_.tree.branches[b];
    through.col(branch).setZero();
    for (const SignedEdge& chord : graph_.tree.cut_sets[b])
      through.col(branch) += chord.sign * through.col(chord.edge);
    if (edges[branch].kind == EdgeKind::kPort) add_port_wrench(branch);
  }
  for (const int chord : graph_.tree.chords)
    if (edges[chord].kind == EdgeKind::kPort) add_port_wrench(chord);
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const auto row = static_cast<Eigen::Index>(6 * b);
    Vector6 y = inertia_[b].P * accelerations_.segment<6>(row) + inertia_[b].Q + inertia_[b].u -
                at_ports.segment<6>(row);
    if (network_.bodies[b].point_mass) y.tail<3>().setZero();
    through.col(graph_.reference_edge[b]) = y;
  }
}

}  // namespace condyle
