#include "condyle/network/network_graph.h"

#include <algorithm>

#include "condyle/input_error.h"

namespace condyle {
namespace {

class GraphMaker {
 public:
  explicit GraphMaker(const Network& network) : network_(network) {
    g_.graph.vertices = {"ground"};
    g_.vertices.emplace_back();
  }

  NetworkGraph make() {
    add_bodies();
    add_ports();
    add_components();
    g_.tree = normal_tree(g_.graph);
    check_branches();
    return std::move(g_);
  }

 private:
  int add_edge(const std::string& name, int from, int to, EdgeKind kind) {
    g_.graph.edges.push_back({name, from, to, kind});
    return static_cast<int>(g_.graph.edges.size()) - 1;
  }

  /// A vertex on a body, with the edge that the body puts between it and the ground.
  int add_vertex(const std::string& name, int body, const Eigen::Vector3d& at, EdgeKind kind) {
    const int vertex = static_cast<int>(g_.vertices.size());
    g_.graph.vertices.push_back(name);
    g_.vertices.push_back({body, at, body == kNoBody ? -1 : add_edge(name, 0, vertex, kind), -1});
    return vertex;
  }

  void add_bodies() {
    for (std::size_t i = 0; i < network_.bodies.size(); ++i) {
      const NetworkBody& body = network_.bodies[i];
      const int vertex = add_vertex(body.name + ": reference port", static_cast<int>(i),
                                    body.reference, EdgeKind::kMass);
      g_.reference_edge.push_back(g_.vertices[vertex].edge);
    }
  }

  void add_ports() {
    for (const NetworkPort& port : network_.ports) {
      if (port.body == kGround) {
        g_.port_vertex.push_back(0);
        continue;
      }
      if (port.body >= 0) check_point_mass(port);
      g_.port_vertex.push_back(add_vertex(port.name, port.body, port.at, EdgeKind::kPort));
    }
  }

  void check_point_mass(const NetworkPort& port) const {
    const NetworkBody& body = network_.bodies[port.body];
    if (body.point_mass && body.mass && port.at != body.mass->center)
      throw InputError("network: port \"" + port.name + "\" of the point mass \"" + body.name +
                       "\" is not where the mass is");
  }

  void add_components() {
    const auto vertex = [&](int port) { return g_.port_vertex[port]; };
    for (const LineComponent& line : network_.lines)
      g_.line_edge.push_back(
          add_edge(line.name, vertex(line.from), vertex(line.to), EdgeKind::kElement));
    for (std::size_t i = 0; i < network_.motions.size(); ++i) {
      const MotionDriver& driver = network_.motions[i];
      g_.motion_edge.push_back(
          add_edge(driver.name, 0, vertex(driver.port), EdgeKind::kAcrossDriver));
      g_.vertices[vertex(driver.port)].driver = static_cast<int>(i);
    }
    for (const BallJoint& joint : network_.joints)
      g_.joint_edge.push_back(
          add_edge(joint.name, vertex(joint.from), vertex(joint.to), EdgeKind::kConstraint));
    for (const ForceDriver& force : network_.forces)
      g_.force_edge.push_back(
          add_edge(force.name, 0, origin(force.body, force.name), EdgeKind::kThroughDriver));
    for (const ConditionComponent& condition : network_.conditions)
      g_.condition_edge.push_back(add_edge(
          condition.name, 0, origin(condition.body, condition.name), EdgeKind::kConstraint));
    for (const PotentialComponent& contact : network_.potentials)
      g_.potential_edge.push_back(
          add_edge(contact.name, 0, origin(contact.body, contact.name), EdgeKind::kElement));
    for (const ContactComponent& contact : network_.contacts)
      g_.contact_edge.push_back(add_edge(
          contact.name, 0,
          add_vertex(contact.name + ": contact point", contact.body, {0, 0, 0}, EdgeKind::kPort),
          EdgeKind::kConstraint));
  }

  int origin(int body, const std::string& name) {
    return add_vertex(name + ": origin of \"" + network_.bodies[body].name + "\"", body, {0, 0, 0},
                      EdgeKind::kPort);
  }

  /// Bodies and drivers give every vertex its motion; a node that only elements hold has none.
  void check_branches() const {
    for (const int e : g_.tree.branches) {
      const GraphEdge& edge = g_.graph.edges[e];
      if (edge.kind == EdgeKind::kElement || edge.kind == EdgeKind::kConstraint)
        throw InputError("network: \"" + edge.name +
                         "\" ends at a port that belongs to no body and "
                         "has no driver, expected a body or a point mass there");
    }
  }

  const Network& network_;
  NetworkGraph g_;
};

}  // namespace

int add_port(Network& network, const std::string& name, int body, const Eigen::Vector3d& at) {
  network.ports.push_back({name, body, at});
  return static_cast<int>(network.ports.size()) - 1;
}

NetworkGraph make_graph(const Network& network) { return GraphMaker(network).make(); }

}  // namespace condyle
