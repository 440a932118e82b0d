#pragma once

/// The linear graph of a network, and which edge belongs to which component.

#include <vector>

#include "condyle/network/linear_graph.h"
#include "condyle/network/network.h"

namespace condyle {

/// What moves a vertex of the graph.
struct NetworkVertex {
  int body = kGround;                            ///< kNoBody: an across driver
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< body frame; ports at contacts move
  int edge = -1;    ///< from the ground to it: of its body, or of its driver
  int driver = -1;  ///< index into Network::motions, where one moves this port
};

struct NetworkGraph {
  LinearGraph graph;
  NormalTree tree;
  std::vector<NetworkVertex> vertices;  ///< 0 is the ground
  std::vector<int> port_vertex;         ///< of each port
  std::vector<int> reference_edge;      ///< of each body
  std::vector<int> line_edge, force_edge, motion_edge, joint_edge, contact_edge, potential_edge,
      condition_edge;
};

/// Throws InputError where the parts do not fit together.
[[nodiscard]] NetworkGraph make_graph(const Network& network);

}  // namespace condyle
