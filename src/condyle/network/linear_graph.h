#pragma once

/// The oriented graph of a network of components [Tokad 1992]: vertices are ports and the ground,
/// edges are terminal pairs. Each edge carries a twist x = x_to - x_from (across) and a wrench y
/// (through), so that x.y is the power that its component takes in. At each vertex the wrenches of
/// the edges that end there equal those of the edges that start there.

#include <Eigen/Core>

#include <string>
#include <vector>

namespace condyle {

/// In the order in which edges are taken into the tree.
enum class EdgeKind { kAcrossDriver, kMass, kPort, kElement, kConstraint, kThroughDriver };

struct GraphEdge {
  std::string name;
  int from = 0, to = 0;  ///< vertices
  EdgeKind kind = EdgeKind::kElement;
};

/// Vertex 0 is the ground.
struct LinearGraph {
  std::vector<std::string> vertices;
  std::vector<GraphEdge> edges;
};

/// An edge and whether it is passed along (+1) or against (-1) its direction.
struct SignedEdge {
  int edge;
  int sign;
};

struct NormalTree {
  std::vector<int> branches, chords;  ///< edges of the tree and of the cotree
  /// For each chord the branches with x_chord = Σ sign x_branch: its fundamental circuit.
  std::vector<std::vector<SignedEdge>> circuits;
  /// For each branch the chords with y_branch = Σ sign y_chord: its fundamental cut-set.
  std::vector<std::vector<SignedEdge>> cut_sets;
};

/// A spanning tree with every across driver in it and no through driver. Throws InputError naming a
/// loop of across drivers, a cut-set of through drivers, or a vertex that nothing joins to the
/// ground.
[[nodiscard]] NormalTree normal_tree(const LinearGraph& graph);

/// B with B x = 0, chords x edges, and C with C y = 0, branches x edges; B Cᵀ = 0. The equations
/// are written without them; tests hold tree, circuits and cut-sets against them.
[[nodiscard]] Eigen::MatrixXi circuit_matrix(const LinearGraph& graph, const NormalTree& tree);
[[nodiscard]] Eigen::MatrixXi cut_set_matrix(const LinearGraph& graph, const NormalTree& tree);

/// The branches from vertex `from` to vertex `to`.
[[nodiscard]] std::vector<SignedEdge> path_in_tree(const LinearGraph& graph,
                                                   const std::vector<int>& branches,
                                                   int from,
                                                   int to);

/// T with x' = T x and y = Tᵀ y', from the tree `old_tree` to the tree `new_tree` of one component:
/// two terminal graphs on the same vertices [Tokad 1992, Fig. 4]. For tests of the theory alone.
[[nodiscard]] Eigen::MatrixXi tree_transformation(const LinearGraph& old_tree,
                                                  const LinearGraph& new_tree);

/// One column of six numbers for each edge.
using EdgeVariables = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Tellegen's theorem: Σ x.y over all edges, zero; and the sum of the magnitudes, to compare with.
/// For tests of a network's equations.
struct TellegenSum {
  double sum = 0, scale = 0;
};
[[nodiscard]] TellegenSum tellegen_sum(const EdgeVariables& across, const EdgeVariables& through);

}  // namespace condyle
