#include "condyle/wrapping/wrapped_path.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

#include "condyle/wrapping/noted_length.h"
#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/path_ends.h"
#include "condyle/wrapping/path_revision.h"
#include "condyle/wrapping/path_state.h"
#include "condyle/wrapping/pull_path.h"
#include "condyle/wrapping/solve_chain.h"
#include "condyle/wrapping/unit_pull.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

class SurfacesPath final : public WrappedPath {
 public:
  SurfacesPath(std::vector<PathWrap> wraps, const PathEnds& ends, InsideRule inside)
      : wraps_(std::move(wraps)), ends_(ends), inside_(inside) {
    for (const PathWrap& wrap : wraps_) surfaces_.push_back(make_surface(wrap));
    lead_ = lead_of(surfaces_, ends_);
  }

  [[nodiscard]] int numbers() const override { return PathState::numbers(wraps_.size()); }

  double pull(const LineEnds& ends,
              const RigidTransform& X_BA,
              double* kept,
              Wrench& unit) const override {
    return at(ends, X_BA, kept, &unit);
  }
  double pull_roughly(const LineEnds& ends,
                      const RigidTransform& X_BA,
                      double* kept,
                      Wrench& unit) const override {
    return at(ends, X_BA, kept, &unit, kRoughStep);
  }
  [[nodiscard]] double length(const LineEnds& ends,
                              const RigidTransform& X_BA,
                              double* kept) const override {
    if (is_followed(ends, X_BA, kept)) return noted(kept)[0];
    return at(ends, X_BA, kept, nullptr);
  }
  [[nodiscard]] double at_most(const LineEnds& ends,
                               const RigidTransform& X_BA,
                               const double* kept) const override {
    if (!are_given(ends, X_BA)) return std::numeric_limits<double>::infinity();
    return length_at_most(lead_, ends, X_BA, noted(kept));
  }
  [[nodiscard]] double last_length(const double* kept) const override {
    return is_noted(noted(kept)) ? noted(kept)[0] : std::numeric_limits<double>::infinity();
  }
  bool revise(const LineEnds& ends, const RigidTransform& X_BA, double* kept) const override;
  void add_points(const LineEnds& ends,
                  const RigidTransform& X_BA,
                  const double* kept,
                  const std::vector<LineTouch>& touches,
                  std::vector<Vector3d>& points) const override;
  bool end_rates(const LineEnds& ends,
                 const RigidTransform& X_BA,
                 const double* kept,
                 LineRates& rates) const override;

  [[nodiscard]] const std::vector<PathWrap>& wraps() const override { return wraps_; }
  void add_touches(const LineEnds& ends,
                   const RigidTransform& X_BA,
                   const double* kept,
                   std::vector<LineTouch>& touches) const override;
  void keep(const std::vector<LineTouch>& touches,
            const LineEnds& ends,
            const RigidTransform& X_BA,
            double* kept) const override;
  [[nodiscard]] std::string objection(const LineEnds& ends,
                                      const RigidTransform& X_BA,
                                      const double* kept) const override;
  [[nodiscard]] std::string remark(const LineEnds& ends,
                                   const RigidTransform& X_BA,
                                   const double* kept) const override;
  [[nodiscard]] Finding finding(const LineEnds& ends,
                                const RigidTransform& X_BA,
                                const double* kept) const override {
    Numbers copy;
    return known(ends, X_BA, kept, copy).finding();
  }

 private:
  using Numbers = std::array<double, kMostPathNumbers>;

  /// Last of all a look at the path that was found.
  [[nodiscard]] std::string run_through(const LineEnds& ends,
                                        const RigidTransform& X_BA,
                                        const PathNumbers& state) const {
    PathEnds other;
    const PathEnds& at = ends_at(ends, X_BA, other);
    const int wrap = surface_run_through({surfaces_, at, X_BA}, state);
    if (wrap < 0) return {};
    return "a straight piece of it runs through \"" + wraps_[static_cast<std::size_t>(wrap)].name +
           "\"";
  }

  static PathSurface make_surface(const PathWrap& wrap) {
    PathSurface surface{wrap.shape, wrap.placement, wrap.placement.inverse(), wrap.on_moving, {}};
    if (wrap.side) surface.side = normal_at(wrap.shape, surface.X_SW * *wrap.side);
    return surface;
  }

  /// Those that were given when the path was made need not be looked at again.
  [[nodiscard]] bool are_given(const LineEnds& ends, const RigidTransform& X_BA) const {
    const Vector3d s_D = X_BA.R.transpose() * ends.q;
    return ends.x_C == ends_.end[0].given &&
           (s_D - ends_.end[1].given).squaredNorm() <= 1e-26 * (1 + s_D.squaredNorm());
  }
  [[nodiscard]] const PathEnds& ends_at(const LineEnds& ends,
                                        const RigidTransform& X_BA,
                                        PathEnds& other) const {
    if (are_given(ends, X_BA)) return ends_;
    return other = path_ends(wraps_, ends.x_C, X_BA.R.transpose() * ends.q, inside_);
  }

  [[nodiscard]] const double* noted(const double* kept) const {
    return PathNumbers::noted(kept, wraps_.size());
  }
  /// The last pull was at this pose, and nothing has changed since.
  [[nodiscard]] bool is_followed(const LineEnds& ends,
                                 const RigidTransform& X_BA,
                                 const double* kept) const {
    return noted_at(lead_, ends, X_BA, noted(kept)) && are_given(ends, X_BA);
  }
  /// It was at another pose.
  [[nodiscard]] bool is_elsewhere(const LineEnds& ends,
                                  const RigidTransform& X_BA,
                                  const double* kept) const {
    return is_noted(noted(kept)) && !noted_at(lead_, ends, X_BA, noted(kept)) &&
           are_given(ends, X_BA);
  }

  /// Numbers of the path at this pose: `kept`, or `copy`, followed from there if it was elsewhere.
  [[nodiscard]] PathNumbers known(const LineEnds& ends,
                                  const RigidTransform& X_BA,
                                  const double* kept,
                                  Numbers& copy) const {
    const PathNumbers as_kept(kept, wraps_.size());
    if (as_kept.known() && !is_elsewhere(ends, X_BA, kept)) return as_kept;
    std::copy(kept, kept + numbers(), copy.begin());
    at(ends, X_BA, copy.data(), nullptr);
    return {copy.data(), wraps_.size()};
  }

  double at(const LineEnds& ends,
            const RigidTransform& X_BA,
            double* kept,
            Wrench* unit,
            double small = kSmallStep) const {
    PathEnds other;
    const PathEnds& found = ends_at(ends, X_BA, other);
    PathState state(kept, wraps_.size());
    LastPiece last;
    const double L = pull_path({surfaces_, found, X_BA}, state, unit, last, small);
    if (last.rest == 0) last.begin = ends_.end[lead_.all_on_A ? 1 : 0].at;
    const bool found_here = &found == &ends_ && state.finding().outcome == Outcome::kFound;
    if (found_here && L > 0)
      note_length(lead_, ends, X_BA, L, last, state.noted());
    else
      state.forget_length();
    return L;
  }

  std::vector<PathWrap> wraps_;
  PathEnds ends_;
  InsideRule inside_;
  std::vector<PathSurface> surfaces_;
  PathLead lead_;
};

/// ∂(anchor)/∂(end), frame of the body: the closest point of a surface with curvature K to a point at
/// the signed distance φ moves by (I - φ K)⁻¹ in the tangent plane.
Eigen::Matrix3d anchor_rate(const PathSurface& surface, const PathEnd& end) {
  const Vector3d n = normal_at(surface.shape, end.anchor);
  const SurfaceFrame f = frame_at(surface.shape, end.anchor, n.unitOrthogonal());
  const double phi = -(end.given - end.at).norm();
  Eigen::Matrix2d bent;
  bent << 1 - phi * f.kappa, -phi * f.tau, -phi * f.tau, 1 - phi * f.kappa_b;
  Eigen::Matrix<double, 3, 2> T;
  T << surface.X_WS.R * f.t, surface.X_WS.R * f.b;
  return T * bent.inverse() * T.transpose();
}

bool SurfacesPath::end_rates(const LineEnds& ends,
                             const RigidTransform& X_BA,
                             const double* kept,
                             LineRates& rates) const {
  Numbers copy;
  const PathNumbers state = known(ends, X_BA, kept, copy);
  PathEnds other;
  const PathEnds& at = ends_at(ends, X_BA, other);
  if (state.finding().outcome != Outcome::kFound) return false;
  PathChain chain = kept_chain({surfaces_, at, X_BA}, state);
  if (chain.n > 0 && !solve(chain)) return false;
  rates = chain.n > 0 ? chain_end_rates(chain, X_BA.p)
                      : straight_end_rates({chain.X, chain.Y, chain.Y - X_BA.p});
  for (const int which : {0, 1}) {
    const PathEnd& end = at.end[which];
    if (end.wrap < 0) continue;
    const Eigen::Matrix3d R = which == 0 ? Eigen::Matrix3d::Identity() : X_BA.R;
    const Eigen::Matrix3d by_end = R * anchor_rate(surfaces_[end.wrap], end) * R.transpose();
    LineEndRates& of = which == 0 ? rates.of_C : rates.of_D;
    of.length = by_end.transpose() * of.length;
    of.f = of.f * by_end;
    of.m = of.m * by_end;
  }
  return true;
}

bool SurfacesPath::revise(const LineEnds& ends, const RigidTransform& X_BA, double* kept) const {
  if (is_elsewhere(ends, X_BA, kept) && !(at(ends, X_BA, kept, nullptr) > 0)) return true;
  PathEnds other;
  const PathEnds& found = ends_at(ends, X_BA, other);
  PathState state(kept, wraps_.size());
  std::array<double, PathNumbers::kNoted> noted;
  const bool has_length = state.noted() != nullptr;
  if (has_length) std::copy_n(state.noted(), PathNumbers::kNoted, noted.begin());
  if (revise_path({surfaces_, found, X_BA}, state)) return true;
  const bool stands = has_length && state.finding().outcome == Outcome::kFound;
  if (stands) std::copy_n(noted.begin(), PathNumbers::kNoted, state.noted());
  return false;
}

/// [rad], of unit vectors.
double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A point of a geodesic with its unit tangent.
struct PathDirections {
  Vector3d x, t;
};

PathDirections directions_at_end(const WrapShape& shape,
                                 const ArcPlace& place,
                                 const std::optional<ArcEnd>& end) {
  if (end) return {end->Q, frame_at(shape, end->Q, end->t).t};
  const Geodesic g = shoot(shape, frame_at(shape, place.P, place.t), place.arc);
  return {g.to.x, g.to.t};
}

void SurfacesPath::add_touches(const LineEnds& ends,
                               const RigidTransform& X_BA,
                               const double* kept,
                               std::vector<LineTouch>& touches) const {
  Numbers copy;
  const PathNumbers state = known(ends, X_BA, kept, copy);
  for (std::size_t i = 0; i < wraps_.size(); ++i) {
    LineTouch& touch = touches.emplace_back();
    touch.on_moving = wraps_[i].on_moving;
    if (!state.touches(static_cast<int>(i))) {
      touch.side = wraps_[i].placement.R * state.side(static_cast<int>(i));
      continue;
    }
    const ArcPlace place = state.place(static_cast<int>(i));
    const WrapShape& shape = wraps_[i].shape;
    const RigidTransform& X = wraps_[i].placement;
    const PathDirections from{place.P, frame_at(shape, place.P, place.t).t};
    const PathDirections to = directions_at_end(shape, place, state.end(static_cast<int>(i)));
    touch.touching = true;
    touch.P = X * from.x;
    touch.Q = X * to.x;
    touch.t_P = X.R * from.t;
    touch.t_Q = X.R * to.t;
    touch.arc = place.arc;
    touch.turn = angle_between(from.t, to.t);
  }
}

void SurfacesPath::keep(const std::vector<LineTouch>& touches,
                        const LineEnds& ends,
                        const RigidTransform& X_BA,
                        double* kept) const {
  if (touches.size() != wraps_.size()) return;
  PathState state(kept, wraps_.size());
  state.set(Outcome::kFound, -1, 1);
  for (std::size_t i = 0; i < wraps_.size(); ++i) {
    const LineTouch& touch = touches[i];
    const RigidTransform& X_SW = surfaces_[i].X_SW;
    if (touch.touching)
      state.touch(static_cast<int>(i), {X_SW * touch.P, X_SW.R * touch.t_P, touch.arc});
    else
      state.leave(static_cast<int>(i), X_SW.R * touch.side);
  }
  PathEnds other;
  const PathPose pose{surfaces_, ends_at(ends, X_BA, other), X_BA};
  PathChain chain = kept_chain(pose, state);
  if (!solve(chain)) return;
  for (int i = 0; i < count(pose); ++i) {
    if (state.touches(i)) continue;
    const Passing line = passing(pose, chain, i);
    state.leave(i, state.side(i), StraightPiece{line.U, line.V});
  }
}

std::string SurfacesPath::objection(const LineEnds& ends,
                                    const RigidTransform& X_BA,
                                    const double* kept) const {
  Numbers copy;
  const PathNumbers state = known(ends, X_BA, kept, copy);
  Finding found = state.finding();
  for (int i = 0; i < static_cast<int>(wraps_.size()); ++i)  // a string does not run back on itself
    if (found.outcome == Outcome::kFound && state.touches(i) && state.place(i).arc < -kTouch)
      found = {Outcome::kNotFound, i, found.conjugate};
  if (found.outcome == Outcome::kFound) return run_through(ends, X_BA, state);
  const std::string name = found.wrap < 0
                               ? "its wraps"
                               : "\"" + wraps_[static_cast<std::size_t>(found.wrap)].name + "\"";
  switch (found.outcome) {
    case Outcome::kNotShortest:
      return "its path over " + name + " is not the shortest: it goes past a conjugate point";
    case Outcome::kEndInside:
      return "an end of it lies inside " + name;
    case Outcome::kFound:
    case Outcome::kNotFound:
      break;
  }
  return "no shortest path over " + name + " was found";
}

/// Of a path that is hardly the shortest any more: its stiffness sideways goes as 1/B.
std::string SurfacesPath::remark(const LineEnds& ends,
                                 const RigidTransform& X_BA,
                                 const double* kept) const {
  constexpr double kNear = 0.05;  // of L
  const Finding found = finding(ends, X_BA, kept);
  if (found.outcome != Outcome::kFound || found.conjugate >= kNear) return {};
  return fmt::format(
      "its path is close to a conjugate point, past which it is not the shortest: B/L = {:.2g}",
      found.conjugate);
}

/// Anchors, and geodesics as chords that turn by 0.1 rad at most.
void SurfacesPath::add_points(const LineEnds& ends,
                              const RigidTransform& X_BA,
                              const double*,
                              const std::vector<LineTouch>& touches,
                              std::vector<Vector3d>& points) const {
  constexpr double kChord = 0.1, kMostTurn = 20;
  PathEnds other;
  const PathEnds& found = ends_at(ends, X_BA, other);
  const auto anchored = [&](int end) {
    const int wrap = found.end[end].wrap;
    return wrap >= 0 && !touches[static_cast<std::size_t>(wrap)].touching;
  };
  const auto in_ground = [&](const LineTouch& touch, const Vector3d& x) {
    return touch.on_moving ? X_BA * x : x;
  };
  if (anchored(0)) points.push_back(found.end[0].at);
  for (std::size_t i = 0; i < wraps_.size(); ++i) {
    const LineTouch& touch = touches[i];
    if (!touch.touching) continue;
    const PathSurface& surface = surfaces_[i];
    const auto frame = [&](const Vector3d& x, const Vector3d& t) {
      return frame_at(surface.shape, surface.X_SW * x, surface.X_SW.R * t);
    };
    const SurfaceFrame from = frame(touch.P, touch.t_P), to = frame(touch.Q, touch.t_Q);
    // More than half a turn is no angle between tangents.
    const double turned = 0.5 * (std::abs(from.kappa) + std::abs(to.kappa)) * touch.arc;
    const int chords =
        static_cast<int>(std::ceil(std::min(std::max(touch.turn, turned), kMostTurn) / kChord));
    points.push_back(in_ground(touch, touch.P));
    if (chords > 1) {
      const RigidTransform X = surface.on_A ? X_BA * surface.X_WS : surface.X_WS;
      add_points_along(surface.shape, from, touch.arc * (chords - 1) / chords, chords - 1, X,
                       points);
    }
    if (chords > 0) points.push_back(in_ground(touch, touch.Q));
  }
  if (anchored(1)) points.push_back(X_BA * found.end[1].at);
}

}  // namespace

std::shared_ptr<const WrappedPath> make_wrapped_path(std::vector<PathWrap> wraps,
                                                     const Vector3d& x_C,
                                                     const Vector3d& s_D,
                                                     InsideRule inside) {
  if (wraps.size() > kMostWraps) throw std::invalid_argument("more than 7 surfaces on a path");
  for (const PathWrap& wrap : wraps)
    if (!has_size(wrap.shape))
      throw std::invalid_argument("a wrapping surface whose size is not positive: " + wrap.name);
  const PathEnds ends = path_ends(wraps, x_C, s_D, inside);
  return std::make_shared<SurfacesPath>(std::move(wraps), ends, inside);
}

}  // namespace condyle
