#include "condyle/verify/taut_string.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/verify/parts.h"
#include "condyle/verify/wrap_field.h"

namespace condyle::verification {
namespace {

using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double kTouch = 1e-8;  ///< [mm]

Vector3d normal_of(const WrapAt& wrap, const Vector3d& x) {
  return field_at(wrap.wrap->shape, wrap.larger, x).gradient.normalized();
}

Vector3d along(const Vector3d& n, const Vector3d& t) { return (t - n.dot(t) * n).normalized(); }

}  // namespace

TautString::TautString(const Scene& scene, const PoseResult& told, std::size_t ligament)
    : scene_(scene), ligament_(ligament), X_BA_(told.X_BA) {
  const std::vector<WrapAt> wraps = wraps_at(scene, told.X_BA, ligament);
  if (ligament >= told.paths.size()) return;
  const std::vector<LineTouch>& touches = told.paths[ligament].touches;
  for (std::size_t w = 0; w < touches.size(); ++w) {
    if (!touches[w].touching) continue;
    const RigidTransform body = touches[w].on_moving ? told.X_BA : RigidTransform{};
    const Eigen::Matrix3d R_own = wraps[w].X.R.transpose() * body.R;
    arcs_.push_back({w, wraps[w].own(body * touches[w].P), R_own * touches[w].t_P, touches[w].arc});
  }
}

TautString::Place TautString::place_at(const RigidTransform& X_BA) const {
  Place at;
  at.wraps = wraps_at(scene_, X_BA, ligament_);
  at.first = begin_of(scene_, X_BA, ligament_, false, at.wraps);
  at.last = begin_of(scene_, X_BA, ligament_, true, at.wraps);
  return at;
}

/// Slid along t and b, turned from t towards b, made longer.
TautString::Arc TautString::changed(const Place& at, const Arc& arc, const Vector4d& by) {
  const WrapAt& wrap = at.wraps[arc.wrap];
  const Vector3d b = arc.t.cross(normal_of(wrap, arc.P));
  Arc next = arc;
  next.P = closest_on(wrap.wrap->shape, wrap.larger, arc.P + by[0] * arc.t + by[1] * b);
  next.t = along(normal_of(wrap, next.P), std::cos(by[2]) * arc.t + std::sin(by[2]) * b);
  next.length += by[3];
  return next;
}

TautString::Ends TautString::ends_of(const Place& at, const Arc& arc) {
  const WrapAt& wrap = at.wraps[arc.wrap];
  const Eigen::Matrix3d& R = wrap.X.R;
  Vector3d x = arc.P, t = arc.t;
  follow_geodesic(wrap.wrap->shape, wrap.larger, arc.length, x, t);
  Ends ends;
  ends.P = wrap.X * arc.P;
  ends.t_P = R * arc.t;
  ends.n_P = R * normal_of(wrap, arc.P);
  ends.b_P = ends.t_P.cross(ends.n_P);
  ends.Q = wrap.X * x;
  ends.t_Q = R * t.normalized();
  ends.n_Q = R * normal_of(wrap, x);
  ends.b_Q = ends.t_Q.cross(ends.n_Q);
  return ends;
}

std::vector<TautString::Ends> TautString::all_ends(const Place& at, const std::vector<Arc>& arcs) {
  std::vector<Ends> ends;
  for (const Arc& arc : arcs) ends.push_back(ends_of(at, arc));
  return ends;
}

/// Angles between pieces and tangents [rad]; of an end that lies on the surface how far the arc's end
/// is from it [mm]. All 0 of a string that is taut.
Eigen::VectorXd TautString::bends(const Place& at,
                                  const std::vector<Arc>& arcs,
                                  const std::vector<Ends>& ends) {
  const std::size_t n = arcs.size();
  Eigen::VectorXd result(4 * static_cast<Eigen::Index>(n));
  const auto set = [&](std::size_t row, const Vector3d& d, double length, const Vector3d& u,
                       const Vector3d& v) {
    result.segment<2>(static_cast<Eigen::Index>(row)) << d.dot(u) / length, d.dot(v) / length;
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Ends& e = ends[i];
    const Vector3d d1 = e.P - (i == 0 ? at.first.x : ends[i - 1].Q);
    const Vector3d d2 = (i + 1 == n ? at.last.x : ends[i + 1].P) - e.Q;
    if (i == 0 && at.first.wrap == static_cast<int>(arcs[i].wrap))
      set(4 * i, d1, 1, e.t_P, e.b_P);
    else
      set(4 * i, d1, d1.norm(), e.n_P, e.b_P);
    if (i + 1 == n && at.last.wrap == static_cast<int>(arcs[i].wrap))
      set(4 * i + 2, d2, 1, e.t_Q, e.b_Q);
    else
      set(4 * i + 2, d2, d2.norm(), e.n_Q, e.b_Q);
  }
  return result;
}

/// By differences.
void TautString::set_rates(const Place& at, const std::vector<Ends>& ends) {
  constexpr double kStep = 1e-5;
  const auto size = static_cast<Eigen::Index>(4 * arcs_.size());
  Eigen::MatrixXd rates(size, size);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    for (int k = 0; k < 4; ++k) {
      std::vector<Ends> up = ends, down = ends;
      up[i] = ends_of(at, changed(at, arcs_[i], kStep * Vector4d::Unit(k)));
      down[i] = ends_of(at, changed(at, arcs_[i], -kStep * Vector4d::Unit(k)));
      rates.col(static_cast<Eigen::Index>(4 * i) + k) =
          (bends(at, arcs_, up) - bends(at, arcs_, down)) / (2 * kStep);
    }
  }
  rates_.emplace(rates);
}

/// Newton with rates that are kept while they do. Of the length the error goes as the square of the
/// bends that are left.
bool TautString::tighten(const Place& at) {
  constexpr double kTaut = 1e-9, kLongest = 0.3;
  constexpr int kRounds = 40;
  double before = INFINITY;
  for (int round = 0; round < kRounds && !arcs_.empty(); ++round) {
    const std::vector<Ends> ends = all_ends(at, arcs_);
    const Eigen::VectorXd bent = bends(at, arcs_, ends);
    const double now = bent.cwiseAbs().maxCoeff();
    if (!std::isfinite(now)) return false;
    if (now < kTaut) break;
    if (round + 1 == kRounds) return false;
    if (!rates_ || rates_->rows() != bent.size() || !(now < 0.1 * before)) set_rates(at, ends);
    before = now;
    Eigen::VectorXd step = -rates_->solve(bent);
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      const Eigen::Index row = 4 * static_cast<Eigen::Index>(i);
      const double radius = least_radius(at.wraps[arcs_[i].wrap].wrap->shape);
      const double size = std::max({std::abs(step[row]) / radius, std::abs(step[row + 1]) / radius,
                                    std::abs(step[row + 2]), std::abs(step[row + 3]) / radius});
      if (!std::isfinite(size)) return false;
      if (size > kLongest) step *= kLongest / size;
    }
    for (std::size_t i = 0; i < arcs_.size(); ++i)
      arcs_[i] = changed(at, arcs_[i], step.segment<4>(4 * static_cast<Eigen::Index>(i)));
  }
  return true;
}

std::optional<double> TautString::pulled_to(const RigidTransform& X_BA) {
  if (!tighten(place_at(X_BA))) return std::nullopt;
  X_BA_ = X_BA;
  return length();
}

double TautString::length() const {
  const Place at = place_at(X_BA_);
  double length = 0;
  Vector3d last = at.first.x;
  for (const Arc& arc : arcs_) {
    const Ends e = ends_of(at, arc);
    length += (e.P - last).norm() + arc.length;
    last = e.Q;
  }
  return length + (at.last.x - last).norm();
}

bool TautString::is_passed_over(const WrapAt& wrap) const {
  return passed_over(scene_.ligaments[ligament_], wrap, X_BA_, scene_);
}

bool TautString::touches(std::size_t wrap) const {
  return std::any_of(arcs_.begin(), arcs_.end(), [&](const Arc& arc) { return arc.wrap == wrap; });
}

TautString::Piece TautString::piece_at(const Place& at, std::size_t wrap) const {
  std::size_t k = 0;
  while (k < arcs_.size() && arcs_[k].wrap < wrap) ++k;
  return {k, k == 0 ? at.first.x : ends_of(at, arcs_[k - 1]).Q,
          k == arcs_.size() ? at.last.x : at.wraps[arcs_[k].wrap].X * arcs_[k].P};
}

/// An arc of negative length is left; a surface that a straight piece runs into is come to.
bool TautString::changes_touch(const Place& at) {
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (arcs_[i].length >= -kTouch) continue;
    arcs_.erase(arcs_.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  for (std::size_t w = 0; w < at.wraps.size(); ++w) {
    if (touches(w) || is_passed_over(at.wraps[w])) continue;
    const Piece piece = piece_at(at, w);
    const Deepest deepest = runs_into(at.wraps[w], piece.from, piece.to);
    if (deepest.depth <= kTouch) continue;
    const WrapAt& wrap = at.wraps[w];
    Vector3d P = closest_on(wrap.wrap->shape, wrap.larger, wrap.own(deepest.x));
    if (at.first.wrap == static_cast<int>(w)) P = wrap.own(at.first.x);
    if (at.last.wrap == static_cast<int>(w)) P = wrap.own(at.last.x);
    const Vector3d t = along(normal_of(wrap, P), wrap.X.R.transpose() * (piece.to - piece.from));
    arcs_.insert(arcs_.begin() + static_cast<std::ptrdiff_t>(piece.after), {w, P, t, 0});
    return true;
  }
  return false;
}

/// An end lies inside a surface of the other body: no string goes on from there.
bool TautString::ends_inside(const Place& at) const {
  return std::any_of(at.wraps.begin(), at.wraps.end(), [&](const WrapAt& wrap) {
    const bool of_first = wrap.wrap->body == scene_.fixed_body();
    const Vector3d& other = of_first ? at.last.x : at.first.x;
    return field_at(wrap.wrap->shape, wrap.larger, wrap.own(other)).f < -kTouch &&
           !is_passed_over(wrap);
  });
}

/// Its end on the moving body goes straight, and that turns about it, in steps of a quarter of the least radius
/// of what it may touch: so it does not matter where the bodies have their origins.
std::vector<RigidTransform> TautString::way_to(const RigidTransform& X_BA) const {
  constexpr double kStep = 0.25;
  constexpr int kFewest = 40, kMost = 400;
  const Place from = place_at(X_BA_);
  const Vector3d end = X_BA_.inverse() * from.last.x;
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(X_BA.R * X_BA_.R.transpose()));
  double least = INFINITY;
  for (const WrapAt& wrap : from.wraps) least = std::min(least, least_radius(wrap.wrap->shape));
  const double moved =
      (X_BA * end - from.last.x).norm() + turn.angle() * (from.last.x - from.first.x).norm();
  const int steps = parts_of(moved / (kStep * least), kFewest, kMost);
  std::vector<RigidTransform> way;
  for (int step = 1; step < steps; ++step) {
    const double part = static_cast<double>(step) / steps;
    RigidTransform& X = way.emplace_back();
    X.R = Eigen::AngleAxisd(part * turn.angle(), turn.axis()) * X_BA_.R;
    X.p = (1 - part) * from.last.x + part * (X_BA * end) - X.R * end;
  }
  way.push_back(X_BA);
  return way;
}

std::optional<double> TautString::led_to(const RigidTransform& X_BA) {
  constexpr int kChanges = 8;
  std::optional<double> length;
  for (const RigidTransform& X : way_to(X_BA)) {
    const Place at = place_at(X);
    if (ends_inside(at)) return std::nullopt;
    int changes = 0;
    do {
      length = pulled_to(X);
      if (!length || ++changes > kChanges) return std::nullopt;
    } while (changes_touch(at));
  }
  return length;
}

}  // namespace condyle::verification
