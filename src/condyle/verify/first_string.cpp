/// A string where nothing is known of it: a surface that it runs through is moved aside until the straight line
/// just touches it, and moved back in steps.

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "condyle/verify/taut_string.h"
#include "condyle/verify/wrap_field.h"

namespace condyle::verification {
namespace {

using Eigen::Vector3d;

/// How far the line has to be moved along w to come clear of the surface, and where it then touches that.
struct WayOut {
  double shift = INFINITY;  ///< [mm]
  Vector3d w, touches;      ///< ground frame
};

/// The least one: in steps of at most a quarter of the least radius, then by halves between the last one that is
/// not clear and the first that is. Depths near a surface's middle are told too large. Of a ring it may end in its
/// hole.
WayOut way_out(const WrapAt& wrap, const Vector3d& from, const Vector3d& to, const Vector3d& w) {
  constexpr double kFine = 1e-4;  // [mm]
  constexpr int kMost = 400, kHalves = 30;
  const double longest = 0.25 * least_radius(wrap.wrap->shape);
  WayOut way{0, w, from};
  double inside = 0;
  const auto is_clear = [&](double shift) {
    const Deepest deepest = runs_into(wrap, from + shift * w, to + shift * w);
    if (deepest.depth < kFine) return true;
    way.touches = deepest.x;
    inside = shift;
    return false;
  };
  for (int k = 0; !is_clear(way.shift); ++k) {
    if (k == kMost) return {INFINITY, w, from};
    way.shift += longest;
  }
  for (int k = 0; k < kHalves && way.shift - inside > kFine; ++k) {
    const double middle = 0.5 * (inside + way.shift);
    if (is_clear(middle)) way.shift = middle;
  }
  return way;
}

constexpr int kWays = 36;  // that are tried across a line

bool is_ring(const WrapAt& wrap) { return std::holds_alternative<WrapTorus>(wrap.wrap->shape); }

/// Of a ring the way out of the tube where the line lies deepest comes first, if it leads across the line; or
/// that of number `across_ring`.
WayOut nearest_way_out(const WrapAt& wrap,
                       const Vector3d& from,
                       const Vector3d& to,
                       std::optional<int> across_ring) {
  const Vector3d d = (to - from).normalized(), u = d.unitOrthogonal(), v = d.cross(u);
  const auto way_at = [&](int k) {
    const double angle = 2 * std::numbers::pi * k / kWays;
    return way_out(wrap, from, to, std::cos(angle) * u + std::sin(angle) * v);
  };
  if (is_ring(wrap)) {
    if (across_ring) return way_at(*across_ring);
    const Vector3d own = wrap.own(runs_into(wrap, from, to).x);
    const Vector3d n =
        wrap.X.R * field_at(wrap.wrap->shape, wrap.larger, own).gradient.normalized();
    const Vector3d across = n - n.dot(d) * d;
    if (across.norm() > 0.5) return way_out(wrap, from, to, across.normalized());
  }
  WayOut nearest;
  for (int k = 0; k < kWays; ++k) {
    const WayOut way = way_at(k);
    if (way.shift < nearest.shift) nearest = way;
  }
  return nearest;
}

}  // namespace

bool TautString::lay_over(const Place& at, std::size_t wrap, std::optional<int> across_rings) {
  constexpr int kSteps = 24;
  const Piece piece = piece_at(at, wrap);
  const WayOut way = nearest_way_out(at.wraps[wrap], piece.from, piece.to, across_rings);
  if (std::isinf(way.shift)) return false;
  Place moved = at;
  WrapAt& there = moved.wraps[wrap];
  const Vector3d aside = -way.shift * way.w;
  const Vector3d P = closest_on(there.wrap->shape, there.larger, there.own(way.touches));
  const Vector3d n = field_at(there.wrap->shape, there.larger, P).gradient.normalized();
  const Vector3d d = there.X.R.transpose() * (piece.to - piece.from);
  arcs_.insert(arcs_.begin() + static_cast<std::ptrdiff_t>(piece.after),
               {wrap, P, (d - n.dot(d) * n).normalized(), 0});
  rates_.reset();
  for (int step = 0; step <= kSteps; ++step) {
    there.X.p = at.wraps[wrap].X.p + (1 - static_cast<double>(step) / kSteps) * aside;
    if (!tighten(moved)) return false;
  }
  return true;
}

int TautString::deepest_in_the_way(const Place& at) const {
  int deepest = -1;
  double depth = 1e-8;
  for (std::size_t w = 0; w < at.wraps.size(); ++w) {
    if (touches(w) || is_passed_over(at.wraps[w])) continue;
    const Piece piece = piece_at(at, w);
    const double here = runs_into(at.wraps[w], piece.from, piece.to).depth;
    if (here > depth) depth = here, deepest = static_cast<int>(w);
  }
  return deepest;
}

bool TautString::lay(const Place& at, int deepest, std::optional<int> across_rings) {
  constexpr int kMost = 8;
  for (int change = 0; change < kMost; ++change, deepest = deepest_in_the_way(at)) {
    if (deepest < 0) return true;
    if (at.first.wrap == deepest || at.last.wrap == deepest) return false;
    if (!lay_over(at, static_cast<std::size_t>(deepest), across_rings)) return false;
    // Bends are none, too, where a piece runs backwards.
    Vector3d from = at.first.x;
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      const Ends ends = ends_of(at, arcs_[i]);
      const Vector3d to = i + 1 < arcs_.size() ? ends_of(at, arcs_[i + 1]).P : at.last.x;
      const bool ahead = (ends.P - from).dot(ends.t_P) > 0 && (to - ends.Q).dot(ends.t_Q) > 0;
      if (arcs_[i].length < 0 || !ahead) return false;
      from = ends.Q;
    }
  }
  return false;
}

std::optional<TautString> TautString::laid(const Scene& scene,
                                           const RigidTransform& X_BA,
                                           std::size_t ligament,
                                           std::optional<int> across_rings) {
  const LigamentWraps& path = scene.ligaments[ligament].path;
  for (const int wrap : path.wraps)
    if (scene.wraps[static_cast<std::size_t>(wrap)].fit) return std::nullopt;
  TautString string(scene, X_BA, ligament);
  const Place at = string.place_at(X_BA);
  if (string.ends_inside(at)) return std::nullopt;
  // Where a side is named only a ring that is not in the way is passed straight, on whichever side.
  const bool sided = !path.sides.empty();
  if (sided && !std::all_of(at.wraps.begin(), at.wraps.end(), is_ring)) return std::nullopt;
  const int deepest = string.deepest_in_the_way(at);
  if ((sided && deepest >= 0) || !string.lay(at, deepest, across_rings)) return std::nullopt;
  return string;
}

std::optional<TautString> TautString::first(const Scene& scene,
                                            const RigidTransform& X_BA,
                                            std::size_t ligament) {
  return laid(scene, X_BA, ligament, std::nullopt);
}

std::vector<TautString> TautString::about_rings(const Scene& scene,
                                                const RigidTransform& X_BA,
                                                std::size_t ligament) {
  constexpr double kSame = 1e-9;  // [mm]
  std::vector<TautString> strings;
  const std::vector<int>& wraps = scene.ligaments[ligament].path.wraps;
  const bool rings = std::any_of(wraps.begin(), wraps.end(), [&](int wrap) {
    return std::holds_alternative<WrapTorus>(scene.wraps[static_cast<std::size_t>(wrap)].shape);
  });
  for (int k = 0; rings && k < kWays; ++k) {
    std::optional<TautString> string = laid(scene, X_BA, ligament, k);
    const auto is_known = [&](const TautString& other) {
      return std::abs(other.length() - string->length()) < kSame;
    };
    if (string && std::none_of(strings.begin(), strings.end(), is_known))
      strings.push_back(std::move(*string));
  }
  return strings;
}

}  // namespace condyle::verification
