#include "condyle/network/constraint_row.h"

#include <Eigen/Geometry>

namespace condyle {
namespace {

Vector6 six(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  Vector6 y;
  y << first, second;
  return y;
}

/// f.(ω x arm) where the arm turns with the body: f.(ω x (θ x arm)) = θ.(arm x (f x ω)).
Vector6 turn_of_arm(const Eigen::Vector3d& f,
                    const Eigen::Vector3d& omega,
                    const Eigen::Vector3d& arm) {
  return six(Eigen::Vector3d::Zero(), arm.cross(f.cross(omega)));
}

class RowMaker {
 public:
  RowMaker(const Network& network,
           const NetworkGraph& graph,
           const Kinematics& at,
           std::vector<ConstraintRow>& rows)
      : network_(network), graph_(graph), at_(at), rows_(rows) {}

  /// Two vertices stay together: one row for each axis.
  void add_point_rows(int edge, int to, int from, const Eigen::Vector3d& apart) {
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
      ConstraintRow row;
      row.edge = edge;
      row.vertex_to = to;
      row.vertex_from = from;
      row.direction[k] = 1;
      row.value = apart[k];
      row.bias = add_end(axis, to, row.turn_to) - add_end(axis, from, row.turn_from);
      row.turn_from = -row.turn_from;
      rows_.push_back(row);
    }
  }

  void add_joint(std::size_t i) {
    const BallJoint& joint = network_.joints[i];
    const GraphEdge& edge = graph_.graph.edges[graph_.joint_edge[i]];
    add_point_rows(graph_.joint_edge[i], edge.to, edge.from,
                   at_.point(joint.to) - at_.point(joint.from));
  }

  void add_driven(std::size_t i) {
    const int port = network_.motions[i].port, vertex = graph_.port_vertex[port];
    if (graph_.vertices[vertex].body < 0) return;
    const DrivenPoint& driven = at_.driven()[i];
    const std::size_t first = rows_.size();
    add_point_rows(graph_.vertices[vertex].edge, vertex, 0, at_.point(port) - driven.position);
    for (int axis = 0; axis < 3; ++axis) {
      ConstraintRow& row = rows_[first + static_cast<std::size_t>(axis)];
      row.rate = driven.velocity[axis];
      row.acceleration = driven.acceleration[axis];
    }
  }

  void add_condition(std::size_t i, const NetworkState& state) {
    const ConditionComponent& component = network_.conditions[i];
    const KinematicCondition& condition = component.condition;
    double value = condition.value;
    ConstraintRow row;
    if (component.value) {
      const DrivenValue driven = component.value(state.t);
      value = driven.value;
      row.rate = driven.rate;
      row.acceleration = driven.acceleration;
    }
    const ConditionDerivatives k = evaluate(condition, value, state.bodies[component.body].X);
    row.edge = graph_.condition_edge[i];
    row.vertex_to = graph_.graph.edges[row.edge].to;
    row.direction << k.alpha, k.eta;
    row.value = k.k;
    const Eigen::Vector3d v = at_.velocity(row.vertex_to);
    const Eigen::Vector3d omega = at_.twist(component.body).tail<3>();
    const Eigen::Vector3d& arm = at_.arm(row.vertex_to);
    const Vector6 turn = six(k.D1.transpose() * v + k.D3.transpose() * omega,
                             k.D2.transpose() * v + k.D4.transpose() * omega);
    row.turn_to = wrench_at_reference(turn, arm) + turn_of_arm(k.alpha, omega, arm);
    row.bias = row.turn_to.dot(at_.twist(component.body));
    row.condition = static_cast<int>(i);
    rows_.push_back(row);
  }

 private:
  /// The part of a vertex in the bias of a row along `axis`, and how it turns.
  double add_end(const Eigen::Vector3d& axis, int vertex, Vector6& turn) const {
    const NetworkVertex& end = graph_.vertices[vertex];
    if (end.body == kNoBody)
      return end.driver < 0 ? 0 : axis.dot(at_.driven()[end.driver].acceleration);
    if (end.body < 0) return 0;
    const Vector6 x = at_.twist(end.body);
    turn = turn_of_arm(axis, x.tail<3>(), at_.arm(vertex));
    return turn.dot(x);
  }

  const Network& network_;
  const NetworkGraph& graph_;
  const Kinematics& at_;
  std::vector<ConstraintRow>& rows_;
};

}  // namespace

/// A row along n: n.(twist of the contact point) = 0. The normal turns and the point wanders as the
/// contact rolls and slides: dn/dt = -K dc/dt, ds/dt = dc/dt - v. With q = n x ω and p = q - K v_c,
/// n.v_c changes by p.dc - q.v_O for motions of the origin O.
ConstraintRow contact_row(const Network& network,
                          const NetworkGraph& graph,
                          const Kinematics& at,
                          const ContactLinearization& contact,
                          std::size_t index) {
  ConstraintRow row;
  row.edge = graph.contact_edge[index];
  row.vertex_to = graph.graph.edges[row.edge].to;
  const Vector6 x = at.twist(network.contacts[index].body);
  const Eigen::Vector3d &n = contact.B.n, omega = x.tail<3>();
  const Eigen::Vector3d q = n.cross(omega);
  const Eigen::Vector3d p = q - contact.B.K * at.velocity(row.vertex_to);
  const Eigen::Vector2d p_T = contact.T.transpose() * p;
  const Eigen::Vector3d to_O = at.arm(row.vertex_to) - contact.s;
  const Vector6 turn = six(contact.S1.transpose() * p_T - q, contact.S2.transpose() * p_T);
  row.direction.head<3>() = n;
  row.value = contact.gap();
  row.turn_to = wrench_at_reference(turn, to_O) + turn_of_arm(n, omega, to_O);
  row.bias = row.turn_to.dot(x);
  row.contact = static_cast<int>(index);
  return row;
}

void constraint_rows(const Network& network,
                     const NetworkGraph& graph,
                     const Kinematics& at,
                     const std::vector<SettledContact>& contacts,
                     const NetworkState& state,
                     std::vector<ConstraintRow>& rows) {
  rows.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (state.contacts[i].closed)
      rows.push_back(contact_row(network, graph, at, contacts[i].at, i));
  RowMaker maker(network, graph, at, rows);
  for (std::size_t i = 0; i < network.joints.size(); ++i) maker.add_joint(i);
  for (std::size_t i = 0; i < network.motions.size(); ++i) maker.add_driven(i);
  for (std::size_t i = 0; i < network.conditions.size(); ++i) maker.add_condition(i, state);
}

}  // namespace condyle
