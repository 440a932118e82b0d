/// Energies of a network and the power at its edges.

#include "condyle/network/network_equations.h"

namespace condyle {

EnergySum NetworkEquations::energies() const {
  EnergySum sum;
  for (std::size_t b = 0; b < inertia_.size(); ++b) {
    const NetworkBody& body = network_.bodies[b];
    if (!body.mass) continue;
    const Vector6 x = at_.twist(static_cast<int>(b));
    sum.kinetic += x.dot(inertia_[b].P * x) / 2;
    sum.gravity -= body.mass->mass * network_.gravity.dot(at_.poses()[b] * body.mass->center);
  }
  for (const LineState& line : lines_) {
    sum.elastic += line.energy;
    sum.dissipation += line.dissipation;
  }
  for (const PotentialComponent& contact : network_.potentials)
    sum.layers += contact.potential->energy(at_.poses()[contact.body]);
  sum.driver_power = driver_power();
  return sum;
}

double NetworkEquations::driver_power() const {
  double power = 0;
  for (std::size_t i = 0; i < network_.forces.size(); ++i) {
    const int edge = graph_.force_edge[i];
    power -= through_.col(edge).dot(at_.vertex_twist(graph_.graph.edges[edge].to));
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
        at_.vertex_twist(edges[e].to) - at_.vertex_twist(edges[e].from);
  through = through_;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    // The edge of a driven port belongs to its body, which takes in what the row gives.
    const double sign = edges[rows_[k].edge].kind == EdgeKind::kConstraint ? 1 : -1;
    through.col(rows_[k].edge) +=
        sign * multipliers_[static_cast<Eigen::Index>(k)] * rows_[k].direction;
  }
  Eigen::VectorXd at_ports = Eigen::VectorXd::Zero(at_.twists().size());
  const auto add_port_wrench = [&](int edge) {
    const int vertex = edges[edge].to, body = graph_.vertices[vertex].body;
    at_ports.segment<6>(6 * body) += wrench_at_reference(through.col(edge), at_.arm(vertex));
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
