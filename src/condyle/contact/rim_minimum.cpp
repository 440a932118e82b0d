#include "condyle/contact/rim_minimum.h"

#include <Eigen/Geometry>

#include <cmath>

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kFacing = -0.3;  // cosine between normals of what faces each other, at most

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

  /// Straight to the edge from `way` [mm] beside the start: the edge distance falls as one goes.
  [[nodiscard]] std::optional<Place> at(double way) const {
    constexpr int kMost = 20;
    constexpr double kOn = 1e-9;  // [mm]
    const Place base = surface_.moved(start_, at_, way * along_);
    const SurfacePoint from = surface_.evaluate_frame(base);
    Place place = base;
    double outward = 0;
    for (int i = 0; i < kMost; ++i) {
      const double edge = surface_.edge_distance(place);
      if (std::abs(edge) < kOn) return place;
      outward += edge;
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

}  // namespace

std::optional<RimMinimum> rim_minimum(const Surface& rim,
                                      const Place& start,
                                      const Surface& facing,
                                      const Place& facing_start,
                                      const RigidTransform& X,
                                      double reach) {
  const Rim edge(rim, start, reach);
  if (!edge.found()) return std::nullopt;
  std::optional<RimMinimum> lowest;
  double best = 0;
  const auto look = [&](double way) {
    const std::optional<Place> place = edge.at(way);
    if (!place) return;
    const SurfacePoint own = rim.evaluate_frame(*place);
    const Vector3d p = X * own.c;
    const Place there = facing.closest(p, lowest ? lowest->facing : facing_start);
    if (facing.edge_distance(there) < 0) return;
    const SurfacePoint at = facing.evaluate_frame(there);
    const double gap = at.n.dot(p - at.c);
    if (at.n.dot(X.R * own.n) > kFacing || (lowest && gap >= lowest->gap)) return;
    lowest = RimMinimum{*place, there, gap};
    best = way;
  };
  constexpr int kParts = 4;        // of the reach
  constexpr double kLeast = 1e-4;  // of the reach
  for (int i = -kParts; i <= kParts; ++i) look(reach * i / kParts);
  for (double step = 0.5 * reach / kParts; lowest && step > kLeast * reach; step *= 0.5) {
    const double middle = best;
    look(middle - step);
    look(middle + step);
  }
  return lowest;
}

}  // namespace condyle
