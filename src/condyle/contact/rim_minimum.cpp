#include "condyle/contact/rim_minimum.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kNone = std::numeric_limits<double>::infinity();
// Of the change from the lowest look to the next: no parabola dips lower between them than by 1/4.
constexpr double kBetween = 0.5;

/// Places on the edge by their way along it from a start.
class Rim {
 public:
  Rim(const Surface& surface, const Place& start, double reach)
      : surface_(surface), start_(start), at_(surface.evaluate_frame(start)), reach_(reach) {
    const Vector3d t = at_.n.unitOrthogonal(), s = at_.n.cross(t);
    inward_ = slope_along(t) * t + slope_along(s) * s;
    found_ = inward_.allFinite() && inward_.norm() > 0.1;  // of a distance it is 1
    if (!found_) return;
    inward_.normalize();
    along_ = at_.n.cross(inward_);
  }
  [[nodiscard]] bool found() const { return found_; }

  /// Straight to the edge from `way` [mm] beside the start, by the secant: the edge distance falls as
  /// one goes.
  [[nodiscard]] std::optional<Place> at(double way) const {
    constexpr int kMost = 20;
    constexpr double kOn = 1e-9;     // [mm]
    constexpr double kUneven = 0.3;  // of a fall by as much as one goes: less, or more, is a kink
    const Place base = surface_.moved(start_, at_, way * along_);
    const SurfacePoint from = surface_.evaluate_frame(base);
    Place place = base;
    double outward = 0, gone = 0, edge_before = 0;
    for (int i = 0; i < kMost; ++i) {
      const double edge = surface_.edge_distance(place);
      if (std::abs(edge) < kOn) return place;
      const double fall = i == 0 ? 1 : (edge_before - edge) / gone;
      gone = fall > kUneven && fall < 1 / kUneven ? edge / fall : edge;
      edge_before = edge;
      outward += gone;
      if (!(std::abs(outward) < 4 * reach_)) return std::nullopt;
      place = surface_.moved(base, from, -outward * inward_);
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] double slope_along(const Vector3d& direction) const {
    const double step = 0.05 * reach_;
    const auto edge = [&](double way) {
      return surface_.edge_distance(surface_.moved(start_, at_, way * direction));
    };
    return (edge(step) - edge(-step)) / (2 * step);
  }

  const Surface& surface_;
  Place start_;
  SurfacePoint at_;
  double reach_;
  Vector3d inward_, along_;
  bool found_ = false;
};

/// To either side of the lowest of them, the greater.
template <std::size_t N>
double change_beside_lowest(const std::array<double, N>& gaps) {
  const auto lowest = std::min_element(gaps.begin(), gaps.end());
  double change = 0;
  const auto look = [&](double gap) {
    if (gap < kNone) change = std::max(change, gap - *lowest);
  };
  if (lowest != gaps.begin()) look(lowest[-1]);
  if (lowest + 1 != gaps.end()) look(lowest[1]);
  return change;
}

}  // namespace

std::optional<RimMinimum> rim_minimum(const Surface& rim,
                                      const Place& start,
                                      const Surface& facing,
                                      const Place& facing_start,
                                      const RigidTransform& X,
                                      double reach,
                                      double cutoff) {
  const Rim edge(rim, start, reach);
  if (!edge.found()) return std::nullopt;
  std::optional<RimMinimum> lowest;
  double best = 0;
  const auto look = [&](double way) {
    const std::optional<Place> place = edge.at(way);
    double gap = kNone;
    if (!place) return gap;
    const SurfacePoint own = rim.evaluate_frame(*place);
    const Vector3d p = X * own.c;
    const Place there = facing.closest(p, lowest ? lowest->facing : facing_start);
    if (facing.edge_distance(there) < 0) return gap;
    const SurfacePoint at = facing.evaluate_frame(there);
    gap = at.n.dot(p - at.c);
    if (lowest && gap >= lowest->gap) return gap;
    lowest = RimMinimum{*place, there, gap};
    best = way;
    return gap;
  };
  constexpr int kParts = 4;        // of the reach
  constexpr double kLeast = 1e-4;  // of the reach
  constexpr std::size_t kGaps = 2 * kParts + 1;
  std::array<double, kGaps> gaps;
  for (int i = -kParts; i <= kParts; ++i)
    gaps[static_cast<std::size_t>(i) + kParts] = look(reach * i / kParts);
  // Where what it faces ends, it may lie lowest: at a corner of both edges.
  const auto look_where_it_ends = [&](double facing_way, double other_way) {
    constexpr int kHalvings = 10;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (facing_way + other_way);
      (look(middle) < kNone ? facing_way : other_way) = middle;
    }
  };
  const double part = reach / kParts;
  for (int i = 0; i < 2 * kParts; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool faces = gaps[k] < kNone, faces_next = gaps[k + 1] < kNone;
    // By the way of one part a gap falls by no more than that.
    if (faces == faces_next || std::min(gaps[k], gaps[k + 1]) - part > cutoff) continue;
    const double way = part * (i - kParts);
    look_where_it_ends(faces ? way : way + part, faces ? way + part : way);
  }
  if (!lowest || lowest->gap - kBetween * change_beside_lowest(gaps) > cutoff) return std::nullopt;
  for (double step = 0.5 * reach / kParts; step > kLeast * reach; step *= 0.5) {
    const double middle = best;
    look(middle - step);
    look(middle + step);
  }
  return lowest;
}

}  // namespace condyle
