#include "condyle/network/linear_graph.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "condyle/input_error.h"
#include "support/random.h"

namespace condyle {
namespace {

/// A body with three ports, two springs to the ground, one between a port and a driven support, a
/// force and the ground's own loop.
LinearGraph body_with_springs() {
  LinearGraph graph;
  graph.vertices = {"ground", "A0", "A1", "A2", "support"};
  graph.edges = {{"pull", 0, 1, EdgeKind::kThroughDriver},  {"spring 1", 0, 2, EdgeKind::kElement},
                 {"spring 2", 3, 4, EdgeKind::kElement},    {"body 1", 0, 2, EdgeKind::kPort},
                 {"body 0", 0, 1, EdgeKind::kMass},         {"body 2", 0, 3, EdgeKind::kPort},
                 {"shaker", 0, 4, EdgeKind::kAcrossDriver}, {"stop", 2, 3, EdgeKind::kConstraint}};
  return graph;
}

std::string message_of(const LinearGraph& graph) {
  try {
    (void)normal_tree(graph);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(LinearGraph, NormalTreeTakesAcrossDriversAndBodiesAndLeavesForcesOut) {
  const NormalTree tree = normal_tree(body_with_springs());
  EXPECT_EQ(tree.branches, (std::vector<int>{6, 4, 3, 5}));
  EXPECT_EQ(tree.chords, (std::vector<int>{0, 1, 2, 7}));
}

// B Cᵀ = 0 is the orthogonality of circuits and cut-sets: what Tellegen's theorem rests on.
TEST(LinearGraph, CircuitsAndCutSetsAreOrthogonal) {
  const LinearGraph graph = body_with_springs();
  const NormalTree tree = normal_tree(graph);
  const Eigen::MatrixXi B = circuit_matrix(graph, tree), C = cut_set_matrix(graph, tree);
  EXPECT_TRUE((B * C.transpose()).isZero());
  EXPECT_EQ(B.rows(), 4);
  EXPECT_EQ(C.rows(), 4);
}

// Vertex twists taken at random obey every circuit; wrenches of the chords taken at random, with
// those of the branches from their cut-sets, balance at every vertex but the ground.
TEST(LinearGraph, FundamentalEquationsAreThoseOfTheVertices) {
  test::Random random(7);
  const LinearGraph graph = body_with_springs();
  const NormalTree tree = normal_tree(graph);
  const Eigen::MatrixXi B = circuit_matrix(graph, tree), C = cut_set_matrix(graph, tree);
  EdgeVariables across(6, 8), through(6, 8);
  std::vector<Eigen::Vector3d> v(5, Eigen::Vector3d::Zero()), w = v;
  for (std::size_t i = 1; i < 5; ++i) {
    v[i] = random.vector(3);
    w[i] = random.vector(3);
  }
  for (std::size_t e = 0; e < 8; ++e) {
    const GraphEdge& edge = graph.edges[e];
    across.col(static_cast<int>(e)) << v[edge.to] - v[edge.from], w[edge.to] - w[edge.from];
  }
  for (const int chord : tree.chords) through.col(chord) << random.vector(2), random.vector(2);
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    through.col(tree.branches[b]).setZero();
    for (const SignedEdge& chord : tree.cut_sets[b])
      through.col(tree.branches[b]) += chord.sign * through.col(chord.edge);
  }
  EXPECT_LT((across * B.transpose().cast<double>()).norm(), 1e-13);
  EXPECT_LT((through * C.transpose().cast<double>()).norm(), 1e-13);
  for (int vertex = 1; vertex < 5; ++vertex) {
    Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t e = 0; e < 8; ++e) {
      if (graph.edges[e].to == vertex) sum += through.col(static_cast<int>(e));
      if (graph.edges[e].from == vertex) sum -= through.col(static_cast<int>(e));
    }
    EXPECT_LT(sum.norm(), 1e-13) << graph.vertices[vertex];
  }
  const TellegenSum power = tellegen_sum(across, through);
  EXPECT_LT(std::abs(power.sum), 1e-14 * power.scale);
  EXPECT_GT(power.scale, 1);
}

TEST(LinearGraph, ALoopOfAcrossDriversIsNamed) {
  LinearGraph graph = body_with_springs();
  graph.edges.push_back({"second shaker", 4, 0, EdgeKind::kAcrossDriver});
  EXPECT_EQ(message_of(graph),
            "network: the across drivers \"second shaker\", \"shaker\" form a loop, expected each "
            "motion to be prescribed once");
}

TEST(LinearGraph, ACutSetOfThroughDriversIsNamed) {
  LinearGraph graph = body_with_springs();
  graph.vertices.push_back("node");
  graph.edges.push_back({"push", 0, 5, EdgeKind::kThroughDriver});
  graph.edges.push_back({"tow", 5, 2, EdgeKind::kThroughDriver});
  EXPECT_EQ(message_of(graph),
            "network: the through drivers \"push\", \"tow\" form a cut-set, expected something "
            "that carries their forces at \"node\"");
}

TEST(LinearGraph, AVertexWithoutAnEdgeIsNamed) {
  LinearGraph graph = body_with_springs();
  graph.vertices.push_back("nowhere");
  EXPECT_EQ(message_of(graph), "network: nothing joins \"nowhere\" to the ground");
}

// Star from the ground to the ports, and star from A0 to the other ports: power is the same.
TEST(LinearGraph, ATreeTransformationKeepsThePower) {
  LinearGraph star, from_A0;
  star.vertices = from_A0.vertices = {"ground", "A0", "A1", "A2"};
  star.edges = {{"0", 0, 1}, {"1", 0, 2}, {"2", 0, 3}};
  from_A0.edges = {{"0", 0, 1}, {"1", 1, 2}, {"2", 1, 3}};
  const Eigen::MatrixXi T = tree_transformation(star, from_A0);
  Eigen::Matrix3i expected;
  expected << 1, 0, 0, -1, 1, 0, -1, 0, 1;
  EXPECT_EQ(T, expected);
  EXPECT_EQ(tree_transformation(from_A0, star) * T, Eigen::Matrix3i::Identity());
}

}  // namespace
}  // namespace condyle
