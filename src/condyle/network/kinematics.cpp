#include "condyle/network/kinematics.h"

#include <Eigen/Geometry>

#include "condyle/math/rotation.h"
#include "condyle/math/simd.h"

namespace condyle {

Kinematics::Kinematics(const Network& network, const NetworkGraph& graph)
    : network_(network),
      graph_(graph),
      poses_(network.bodies.size()),
      driven_(network.motions.size()),
      twists_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * network.bodies.size()))),
      references_(network.bodies.size()),
      offsets_(graph.vertices.size(), Eigen::Vector3d::Zero()),
      points_(offsets_),
      arms_(offsets_),
      vertex_twist_(EdgeVariables::Zero(6, static_cast<Eigen::Index>(graph.vertices.size()))) {
  for (std::size_t v = 1; v < graph.vertices.size(); ++v) {
    const NetworkVertex& vertex = graph.vertices[v];
    if (vertex.body >= 0) offsets_[v] = vertex.at - network.bodies[vertex.body].reference;
    if (vertex.body == kNoBody) points_[v] = vertex.at;
  }
}

CONDYLE_FMA_CLONE
void Kinematics::place(const NetworkState& state) {
  for (std::size_t i = 0; i < driven_.size(); ++i) driven_[i] = network_.motions[i].motion(state.t);
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const BodyState& body = state.bodies[b];
    twists_.segment<6>(static_cast<Eigen::Index>(6 * b)) << body.v, body.omega;
    poses_[b] = body.X;
    references_[b] = body.X * network_.bodies[b].reference;
  }
  for (std::size_t v = 1; v < graph_.vertices.size(); ++v) {
    const NetworkVertex& vertex = graph_.vertices[v];
    double* twist = vertex_twist_.col(static_cast<Eigen::Index>(v)).data();
    if (vertex.body >= 0) {
      const BodyState& body = state.bodies[vertex.body];
      const Eigen::Vector3d arm = body.X.R * offsets_[v];
      arms_[v] = arm;
      points_[v] = references_[vertex.body] + arm;
      Eigen::Map<Eigen::Vector3d>{twist} = body.v + body.omega.cross(arm);
      Eigen::Map<Eigen::Vector3d>(twist + 3) = body.omega;
    } else if (vertex.driver >= 0) {
      points_[v] = driven_[vertex.driver].position;
      Eigen::Map<Eigen::Vector3d>{twist} = driven_[vertex.driver].velocity;
    }
  }
}

void Kinematics::set_contact_point(std::size_t contact, const Eigen::Vector3d& at) {
  const int vertex = graph_.graph.edges[graph_.contact_edge[contact]].to;
  offsets_[vertex] = at - network_.bodies[network_.contacts[contact].body].reference;
}

void Kinematics::displacement(const NetworkState& state, Eigen::VectorXd& moved) const {
  moved.resize(twists_.size());
  for (std::size_t b = 0; b < state.bodies.size(); ++b) {
    const RigidTransform& X = state.bodies[b].X;
    const auto row = static_cast<Eigen::Index>(6 * b);
    moved.segment<3>(row) = X * network_.bodies[b].reference - references_[b];
    moved.segment<3>(row + 3) = cayley_vector(X.R * poses_[b].R.transpose());
  }
}

}  // namespace condyle
