#include "condyle/verify/winding.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <unordered_map>

namespace condyle::verification {
namespace {

using Eigen::Vector3d;

/// The solid angle of a triangle seen from the origin [van Oosterom and Strackee 1983].
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double A = a.norm(), B = b.norm(), C = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), A * B * C + a.dot(b) * C + b.dot(c) * A + c.dot(a) * B);
}

double squared_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double t = std::clamp((p - a).dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
  return (p - a - t * way).squaredNorm();
}

double squared_to_triangle(const Vector3d& p,
                           const Vector3d& a,
                           const Vector3d& b,
                           const Vector3d& c) {
  const Vector3d n = (b - a).cross(c - a);
  const bool over = n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
                    n.dot((a - c).cross(p - c)) >= 0;
  if (over && n.squaredNorm() > 0) {
    const double height = n.normalized().dot(p - a);
    return height * height;
  }
  return std::min(
      {squared_to_segment(p, a, b), squared_to_segment(p, b, c), squared_to_segment(p, c, a)});
}

bool is_closed(const TriangleMesh& mesh) {
  std::unordered_map<std::uint64_t, int> count;
  count.reserve(2 * mesh.triangles.size());
  for (const std::array<int, 3>& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      ++count[(static_cast<std::uint64_t>(low) << 32) | static_cast<std::uint32_t>(high)];
    }
  std::size_t rim = 0;
  for (const auto& [edge, triangles] : count) rim += triangles == 1 ? 1 : 0;
  return rim * 1000 <= count.size();
}

}  // namespace

Winding::Winding(const TriangleMesh& mesh)
    : mesh_(mesh), order_(mesh.triangles.size()), closed_(is_closed(mesh)) {
  std::iota(order_.begin(), order_.end(), 0);
  build(0, static_cast<int>(order_.size()));
}

int Winding::build(int begin, int end) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node{{}, Vector3d::Zero(), Vector3d::Zero(), 0, begin, end, -1};
  double total = 0;
  const auto corner = [&](int i, std::size_t k) -> const Vector3d& {
    return mesh_.vertices[static_cast<std::size_t>(
        mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])][k])];
  };
  for (int i = begin; i < end; ++i) {
    const Vector3d &a = corner(i, 0), &b = corner(i, 1), &c = corner(i, 2);
    const Vector3d area = (b - a).cross(c - a) / 2;
    node.area += area;
    node.middle += area.norm() * (a + b + c) / 3;
    total += area.norm();
    node.box.extend(a), node.box.extend(b), node.box.extend(c);
  }
  node.middle = total > 0 ? Vector3d(node.middle / total) : node.box.center();
  for (int i = begin; i < end; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      node.radius = std::max(node.radius, (corner(i, k) - node.middle).norm());
  if (end - begin > 8) {
    int axis = 0;
    node.box.sizes().maxCoeff(&axis);
    const int middle = (begin + end) / 2;
    const auto place = [&](int triangle) {
      const std::array<int, 3>& t = mesh_.triangles[static_cast<std::size_t>(triangle)];
      double sum = 0;
      for (const int v : t) sum += mesh_.vertices[static_cast<std::size_t>(v)][axis];
      return sum;
    };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](int a, int b) { return place(a) < place(b); });
    build(begin, middle);
    node.right = build(middle, end);
  }
  nodes_[static_cast<std::size_t>(index)] = node;
  return index;
}

double Winding::angle(const Node& node, const Vector3d& p) const {
  const Vector3d way = node.middle - p;
  const double distance = way.norm();
  if (distance > 2.5 * node.radius) return node.area.dot(way) / (distance * distance * distance);
  if (node.right >= 0)
    return angle(*(&node + 1), p) + angle(nodes_[static_cast<std::size_t>(node.right)], p);
  double sum = 0;
  for (int i = node.begin; i < node.end; ++i) {
    const std::array<int, 3>& t =
        mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
    const auto corner = [&](std::size_t k) -> Vector3d {
      return mesh_.vertices[static_cast<std::size_t>(t[k])] - p;
    };
    sum += solid_angle(corner(0), corner(1), corner(2));
  }
  return sum;
}

double Winding::number(const Vector3d& p) const {
  return angle(nodes_[0], p) / (4 * std::numbers::pi);
}

double Winding::distance(const Vector3d& p) const {
  double best = std::numeric_limits<double>::infinity();
  const auto search = [&](const auto& self, const Node& node) -> void {
    if (node.box.squaredExteriorDistance(p) >= best) return;
    if (node.right >= 0) {
      const Node &left = *(&node + 1), &right = nodes_[static_cast<std::size_t>(node.right)];
      const bool left_first =
          left.box.squaredExteriorDistance(p) < right.box.squaredExteriorDistance(p);
      self(self, left_first ? left : right);
      self(self, left_first ? right : left);
      return;
    }
    for (int i = node.begin; i < node.end; ++i) {
      const std::array<int, 3>& t =
          mesh_.triangles[static_cast<std::size_t>(order_[static_cast<std::size_t>(i)])];
      const auto corner = [&](std::size_t k) -> const Vector3d& {
        return mesh_.vertices[static_cast<std::size_t>(t[k])];
      };
      best = std::min(best, squared_to_triangle(p, corner(0), corner(1), corner(2)));
    }
  };
  search(search, nodes_[0]);
  return std::sqrt(best);
}

}  // namespace condyle::verification
