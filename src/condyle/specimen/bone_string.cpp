#include "condyle/specimen/bone_string.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

/// One step of the string: nodes with the solid's surface replaced by planes, n·dx >= -height.
struct Planes {
  std::vector<SurfaceHeight> at;  ///< of the inner nodes
  std::vector<bool> active;       ///< the node lies on its plane
  std::vector<double> hold;  ///< ½ hold |dx|² is added: what the bending of the surface may take
};

constexpr double kStiff = 1e7;  // of a plane, where a piece of the string has 1

/// Steps of the inner nodes for the planes that are active: block tridiagonal, from the first to
/// the last and back.
void solve(const Points& x, const Planes& planes, Points& dx) {
  const std::size_t n = dx.size();
  static thread_local std::vector<Matrix3d> inverse;
  inverse.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    Matrix3d D = 2 * Matrix3d::Identity();
    Vector3d r = x[k] + x[k + 2] - 2 * x[k + 1];
    if (planes.active[k]) {
      const auto& [height, normal] = planes.at[k];
      D += kStiff * normal * normal.transpose() + planes.hold[k] * Matrix3d::Identity();
      r -= kStiff * height * normal;
    }
    if (k > 0) D -= inverse[k - 1], r += dx[k - 1];
    inverse[k] = D.inverse();
    dx[k] = inverse[k] * r;
  }
  for (std::size_t k = n - 1; k-- > 0;) dx[k] += inverse[k] * dx[k + 1];
}

/// Finds the planes that the string presses on [Hintermueller 2002].
void solve_with_planes(const Points& x, Planes& planes, Points& dx) {
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    solve(x, planes, dx);
    bool same = true;
    for (std::size_t k = 0; k < dx.size(); ++k) {
      const double over = planes.at[k].height + planes.at[k].normal.dot(dx[k]);
      // On an active plane -over is the pressure, in units of 1/kStiff.
      const bool active = over < (planes.active[k] ? 0 : -1e-9);
      same = same && active == planes.active[k];
      planes.active[k] = active;
    }
    if (same) return;
  }
}

/// The planes leave out that the surface bends: λ κ, with λ the pressure on a plane, of the stiffness
/// of a node. Where the surface is hollow across the string, steps would be too long and never end;
/// with a bound of κ they shrink. The bound grows until it is one on the roughest bone.
void hold_nodes(int iteration, const Points& dx, Planes& planes) {
  constexpr int kFree = 12, kUsual = 100;  // iterations
  constexpr double kUsualBend = 0.3;       // [1/mm]
  const double grown = std::pow(std::max(1.0, iteration / double{kUsual}), 1.5);
  const double bend = iteration < kFree ? 0 : kUsualBend * grown;
  for (std::size_t k = 0; k < dx.size(); ++k) {
    const double over = planes.at[k].height + planes.at[k].normal.dot(dx[k]);
    planes.hold[k] = planes.active[k] ? bend * kStiff * std::max(0.0, -over) : 0;
  }
}

double length_of(const Points& x) {
  double length = 0;
  for (std::size_t k = 1; k < x.size(); ++k) length += (x[k] - x[k - 1]).norm();
  return length;
}

/// Whether the last lengths differ by less.
bool settled(const std::vector<double>& lengths, double tolerance) {
  constexpr std::size_t kLast = 10;
  if (lengths.size() < kLast) return false;
  const auto [low, high] = std::minmax_element(lengths.end() - kLast, lengths.end());
  return *high - *low < tolerance;
}

/// Onto the surface, where p lies inside.
Vector3d moved_out(const SmoothedMesh& bone, Vector3d p) {
  constexpr int kSteps = 50;
  double step = bone.signed_distance(p) < 0 ? -1.0 : 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const auto [height, normal] = bone.height(p);
    if (i == 0 && height >= 0) break;
    step = -height;
    p += step * normal;
    if (std::abs(step) < 1e-9) break;
  }
  return p;
}

/// How far p has to go along d to be outside [mm].
double way_out(const SmoothedMesh& bone, const Vector3d& p, const Vector3d& d) {
  constexpr double kFarthest = 80, kLeast = 0.25;  // [mm]
  double t = 0;
  while (t < kFarthest) {
    const double distance = bone.signed_distance(p + t * d);
    if (distance >= 0) break;
    t += std::max(kLeast, -distance);
  }
  return t;
}

/// Nodes on the straight line, those deep in the bone moved out of it, all in the one direction
/// across the line for which the longest of these ways is shortest.
Points beside_the_bone(const SmoothedMesh& bone, const Vector3d& x, const Vector3d& y, int pieces) {
  constexpr int kDirections = 24;
  constexpr double kShallow = 0.5;  // planes move these out [mm]
  Points nodes;
  for (int k = 0; k <= pieces; ++k) nodes.push_back(x + (y - x) * k / pieces);
  std::vector<std::size_t> deep;
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k)
    if (bone.signed_distance(nodes[k]) < -kShallow) deep.push_back(k);
  if (deep.empty()) return nodes;
  const Vector3d u = (y - x).unitOrthogonal(), v = (y - x).normalized().cross(u);
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> best;
  Vector3d direction = u;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * M_PI * i / kDirections;
    const Vector3d d = std::cos(angle) * u + std::sin(angle) * v;
    std::vector<double> ways;
    double longest = 0;
    for (std::size_t k = 0; k < deep.size() && longest < least; ++k) {
      ways.push_back(way_out(bone, nodes[deep[k]], d));
      longest = std::max(longest, ways.back());
    }
    if (longest >= least) continue;
    least = longest, best = ways, direction = d;
  }
  for (std::size_t k = 0; k < deep.size(); ++k) nodes[deep[k]] += best[k] * direction;
  return nodes;
}

}  // namespace

BonePath relaxed_string(const HeightOver& solid, Points nodes, const StringOptions& options) {
  BonePath path;
  path.straight = (nodes.back() - nodes.front()).norm();
  const std::size_t inner = nodes.size() - 2;
  Planes planes{std::vector<SurfaceHeight>(inner), std::vector<bool>(inner, false),
                std::vector<double>(inner, 0.0)};
  Points dx(inner, Vector3d::Zero());
  std::vector<double> lengths;
  for (int iteration = 0; iteration < options.iterations && !path.found; ++iteration) {
    for (std::size_t k = 0; k < inner; ++k) planes.at[k] = solid(nodes[k + 1]);
    solve_with_planes(nodes, planes, dx);
    hold_nodes(iteration, dx, planes);
    double longest = 0;
    for (const Vector3d& step : dx) longest = std::max(longest, step.norm());
    const double part = std::min(1.0, options.longest_step / std::max(longest, 1e-300));
    for (std::size_t k = 0; k < inner; ++k) nodes[k + 1] += part * dx[k];
    lengths.push_back(length_of(nodes));
    path.found = longest < options.tolerance;
  }
  path.found = path.found || settled(lengths, options.settled);
  for (std::size_t k = 0; k < inner; ++k)
    if (planes.active[k]) path.touches.push_back({nodes[k + 1], planes.at[k].normal});
  path.length = lengths.empty() ? path.straight : lengths.back();
  path.points = std::move(nodes);
  return path;
}

BonePath bone_string(const SmoothedMesh& bone,
                     const Vector3d& x,
                     const Vector3d& y,
                     const StringOptions& options) {
  const Vector3d from = moved_out(bone, x), to = moved_out(bone, y);
  BonePath path = relaxed_string([&](const Vector3d& p) { return bone.height(p); },
                                 beside_the_bone(bone, from, to, options.pieces), options);
  path.depth = depth_of_line(bone, x, y);
  path.moved = {(from - x).norm(), (to - y).norm()};
  return path;
}

double depth_of_line(const SmoothedMesh& bone, const Vector3d& x, const Vector3d& y) {
  constexpr double kLeast = 0.5;  // [mm]
  const double length = (y - x).norm();
  double depth = 0;
  for (double s = 0; s < length;) {
    const double distance = bone.signed_distance(x + s / length * (y - x));
    depth = std::max(depth, -distance);
    s += std::max(kLeast, distance);
  }
  return depth;
}

}  // namespace condyle
