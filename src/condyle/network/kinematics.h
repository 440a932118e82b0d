#pragma once

/// Where the vertices of a network's graph are and how they move, at one state.

#include "condyle/network/network_graph.h"
#include "condyle/network/rigid_body_component.h"

namespace condyle {

class Kinematics {
 public:
  /// Keeps references.
  Kinematics(const Network& network, const NetworkGraph& graph);

  /// Poses and twists of the bodies and points of the across drivers; then the vertices.
  void place(const NetworkState& state);
  /// The port of a contact is where the contact is, in the body's frame.
  void set_contact_point(std::size_t contact, const Eigen::Vector3d& at);

  [[nodiscard]] const std::vector<RigidTransform>& poses() const { return poses_; }
  [[nodiscard]] const std::vector<DrivenPoint>& driven() const { return driven_; }
  [[nodiscard]] const Eigen::VectorXd& twists() const { return twists_; }  ///< six for each body
  [[nodiscard]] Vector6 twist(int body) const { return twists_.segment<6>(Eigen::Index{6} * body); }
  [[nodiscard]] const Eigen::Vector3d& point(int port) const {  ///< ground frame
    const int vertex = graph_.port_vertex[port];
    return vertex == 0 ? network_.ports[port].at : points_[vertex];
  }
  /// Of a vertex, from the reference port of its body.
  [[nodiscard]] const Eigen::Vector3d& arm(int vertex) const { return arms_[vertex]; }
  [[nodiscard]] Vector6 vertex_twist(int vertex) const { return vertex_twist_.col(vertex); }
  [[nodiscard]] Eigen::Vector3d velocity(int vertex) const {
    return vertex_twist_.col(vertex).head<3>();
  }

  /// What has been moved since place(), six numbers for each body: of the reference port [mm] and
  /// the rotation vector [rad], for small rotations.
  void displacement(const NetworkState& state, Eigen::VectorXd& moved) const;

 private:
  const Network& network_;
  const NetworkGraph& graph_;
  std::vector<RigidTransform> poses_;
  std::vector<DrivenPoint> driven_;  ///< of each across driver
  Eigen::VectorXd twists_;
  std::vector<Eigen::Vector3d> references_;  ///< of each body, ground frame
  std::vector<Eigen::Vector3d> offsets_;     ///< of each vertex: its arm in the body's frame
  std::vector<Eigen::Vector3d> points_, arms_;
  EdgeVariables vertex_twist_;
};

}  // namespace condyle
