#include "condyle/network/linear_graph.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/input_error.h"
#include "condyle/math/disjoint_sets.h"

namespace condyle {
namespace {

/// Which vertices are joined so far: the ground, the lowest, stays the root of what it holds.
using Joined = DisjointSets;

std::string listed_edges(const LinearGraph& graph, const std::vector<int>& edges) {
  std::string text;
  for (const int e : edges) text += (text.empty() ? "\"" : ", \"") + graph.edges[e].name + "\"";
  return text;
}

[[noreturn]] void fail_loop(const LinearGraph& graph, const std::vector<int>& branches, int e) {
  std::vector<int> loop = {e};
  const GraphEdge& edge = graph.edges[e];
  for (const SignedEdge& step : path_in_tree(graph, branches, edge.from, edge.to))
    loop.push_back(step.edge);
  throw InputError("network: the across drivers " + listed_edges(graph, loop) +
                   " form a loop, expected each motion to be prescribed once");
}

[[noreturn]] void fail_cut_set(const LinearGraph& graph, Joined& joined, int e) {
  const GraphEdge& edge = graph.edges[e];
  const int island = std::max(joined.root(edge.from), joined.root(edge.to));
  std::vector<int> cut;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const bool from = joined.root(graph.edges[i].from) == island;
    if (from != (joined.root(graph.edges[i].to) == island)) cut.push_back(static_cast<int>(i));
  }
  throw InputError("network: the through drivers " + listed_edges(graph, cut) +
                   " form a cut-set, expected something that carries their forces at \"" +
                   graph.vertices[island] + "\"");
}

std::vector<int> edges_by_kind(const LinearGraph& graph) {
  std::vector<int> order(graph.edges.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return graph.edges[a].kind < graph.edges[b].kind; });
  return order;
}

/// Signed branches from the ground to each vertex; `reached` tells which have such a way.
struct Paths {
  std::vector<std::vector<SignedEdge>> from_ground;
  std::vector<bool> reached;
};

Paths paths_from(const LinearGraph& graph, const std::vector<int>& branches, int start) {
  const std::size_t n = graph.vertices.size();
  std::vector<std::vector<SignedEdge>> leaving(n);
  for (const int e : branches) {
    leaving[graph.edges[e].from].push_back({e, 1});
    leaving[graph.edges[e].to].push_back({e, -1});
  }
  Paths paths{std::vector<std::vector<SignedEdge>>(n), std::vector<bool>(n)};
  std::vector<int> open = {start};
  paths.reached[start] = true;
  while (!open.empty()) {
    const int v = open.back();
    open.pop_back();
    for (const SignedEdge& step : leaving[v]) {
      const GraphEdge& edge = graph.edges[step.edge];
      const int next = step.sign > 0 ? edge.to : edge.from;
      if (paths.reached[next]) continue;
      paths.reached[next] = true;
      paths.from_ground[next] = paths.from_ground[v];
      paths.from_ground[next].push_back(step);
      open.push_back(next);
    }
  }
  return paths;
}

/// Sum of two ways, the first passed backwards: what both share falls out.
std::vector<SignedEdge> difference(const std::vector<SignedEdge>& back,
                                   const std::vector<SignedEdge>& forth) {
  std::size_t shared = 0;
  while (shared < back.size() && shared < forth.size() && back[shared].edge == forth[shared].edge)
    ++shared;
  std::vector<SignedEdge> way;
  for (std::size_t i = back.size(); i > shared; --i)
    way.push_back({back[i - 1].edge, -back[i - 1].sign});
  way.insert(way.end(), forth.begin() + static_cast<std::ptrdiff_t>(shared), forth.end());
  return way;
}

std::vector<int> choose_branches(const LinearGraph& graph) {
  Joined joined(graph.vertices.size());
  std::vector<int> branches;
  for (const int e : edges_by_kind(graph)) {
    const GraphEdge& edge = graph.edges[e];
    if (edge.kind == EdgeKind::kThroughDriver) {
      if (joined.root(edge.from) != joined.root(edge.to)) fail_cut_set(graph, joined, e);
    } else if (joined.join(edge.from, edge.to)) {
      branches.push_back(e);
    } else if (edge.kind == EdgeKind::kAcrossDriver) {
      fail_loop(graph, branches, e);
    }
  }
  for (std::size_t v = 0; v < graph.vertices.size(); ++v) {
    if (joined.root(static_cast<int>(v)) != 0)
      throw InputError("network: nothing joins \"" + graph.vertices[v] + "\" to the ground");
  }
  return branches;
}

}  // namespace

NormalTree normal_tree(const LinearGraph& graph) {
  NormalTree tree;
  tree.branches = choose_branches(graph);
  std::vector<int> place(graph.edges.size(), -1);
  for (std::size_t i = 0; i < tree.branches.size(); ++i)
    place[tree.branches[i]] = static_cast<int>(i);
  tree.cut_sets.resize(tree.branches.size());
  const Paths paths = paths_from(graph, tree.branches, 0);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (place[e] >= 0) continue;
    const GraphEdge& edge = graph.edges[e];
    const int chord = static_cast<int>(e);
    tree.chords.push_back(chord);
    tree.circuits.push_back(difference(paths.from_ground[edge.from], paths.from_ground[edge.to]));
    for (const SignedEdge& step : tree.circuits.back())
      tree.cut_sets[place[step.edge]].push_back({chord, -step.sign});
  }
  return tree;
}

Eigen::MatrixXi circuit_matrix(const LinearGraph& graph, const NormalTree& tree) {
  Eigen::MatrixXi B = Eigen::MatrixXi::Zero(static_cast<Eigen::Index>(tree.chords.size()),
                                            static_cast<Eigen::Index>(graph.edges.size()));
  for (std::size_t i = 0; i < tree.chords.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    B(row, tree.chords[i]) = 1;
    for (const SignedEdge& step : tree.circuits[i]) B(row, step.edge) = -step.sign;
  }
  return B;
}

Eigen::MatrixXi cut_set_matrix(const LinearGraph& graph, const NormalTree& tree) {
  Eigen::MatrixXi C = Eigen::MatrixXi::Zero(static_cast<Eigen::Index>(tree.branches.size()),
                                            static_cast<Eigen::Index>(graph.edges.size()));
  for (std::size_t i = 0; i < tree.branches.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    C(row, tree.branches[i]) = 1;
    for (const SignedEdge& chord : tree.cut_sets[i]) C(row, chord.edge) = -chord.sign;
  }
  return C;
}

std::vector<SignedEdge> path_in_tree(const LinearGraph& graph,
                                     const std::vector<int>& branches,
                                     int from,
                                     int to) {
  return paths_from(graph, branches, from).from_ground[to];
}

Eigen::MatrixXi tree_transformation(const LinearGraph& old_tree, const LinearGraph& new_tree) {
  const auto n = static_cast<Eigen::Index>(old_tree.edges.size());
  Eigen::MatrixXi T = Eigen::MatrixXi::Zero(n, n);
  std::vector<int> branches(old_tree.edges.size());
  std::iota(branches.begin(), branches.end(), 0);
  const Paths paths = paths_from(old_tree, branches, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const GraphEdge& edge = new_tree.edges[static_cast<std::size_t>(i)];
    for (const SignedEdge& step :
         difference(paths.from_ground[edge.from], paths.from_ground[edge.to]))
      T(i, step.edge) = step.sign;
  }
  return T;
}

TellegenSum tellegen_sum(const EdgeVariables& across, const EdgeVariables& through) {
  TellegenSum total;
  for (Eigen::Index e = 0; e < across.cols(); ++e) {
    const double power = across.col(e).dot(through.col(e));
    total.sum += power;
    total.scale += std::abs(power);
  }
  return total;
}

}  // namespace condyle
