#include "condyle/wrapping/wrapped_path.h"

#include <Eigen/Geometry>

#include <limits>
#include <stdexcept>

#include "condyle/wrapping/one_surface.h"
#include "condyle/wrapping/path_ends.h"
#include "condyle/wrapping/path_revision.h"
#include "condyle/wrapping/path_state.h"
#include "condyle/wrapping/pull_path.h"
#include "condyle/wrapping/solve_chain.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

class SurfacesPath final : public WrappedPath {
 public:
  SurfacesPath(std::vector<PathWrap> wraps, const PathEnds& ends, InsideRule inside)
      : wraps_(std::move(wraps)), ends_(ends), inside_(inside) {
    for (const PathWrap& wrap : wraps_) surfaces_.push_back(make_surface(wrap));
  }

  [[nodiscard]] int numbers() const override { return PathState::numbers(wraps_.size()); }

  double pull(const LineEnds& ends,
              const RigidTransform& X_BA,
              double* kept,
              Wrench& unit) const override {
    return at(ends, X_BA, kept, &unit);
  }
  [[nodiscard]] double length(const LineEnds& ends,
                              const RigidTransform& X_BA,
                              double* kept) const override {
    return at(ends, X_BA, kept, nullptr);
  }
  bool revise(const LineEnds& ends, const RigidTransform& X_BA, double* kept) const override {
    PathEnds other;
    const PathEnds& found = ends_at(ends, X_BA, other);
    return revise_path({surfaces_, found, X_BA}, PathState(kept, wraps_.size()));
  }
  void add_points(const LineEnds& ends,
                  const RigidTransform& X_BA,
                  const double* kept,
                  std::vector<Vector3d>& points) const override;

  [[nodiscard]] const std::vector<PathWrap>& wraps() const override { return wraps_; }
  void add_touches(const LineEnds& ends,
                   const RigidTransform& X_BA,
                   const double* kept,
                   std::vector<LineTouch>& touches) const override;
  void keep(const std::vector<LineTouch>& touches, double* kept) const override;
  [[nodiscard]] std::string objection(const LineEnds& ends,
                                      const RigidTransform& X_BA,
                                      const double* kept) const override;
  [[nodiscard]] Finding finding(const LineEnds& ends,
                                const RigidTransform& X_BA,
                                const double* kept) const override {
    return PathState(known(ends, X_BA, kept).data(), wraps_.size()).finding();
  }

 private:
  /// Last of all a look at the path that was found.
  [[nodiscard]] std::string run_through(const LineEnds& ends,
                                        const RigidTransform& X_BA,
                                        const double* kept) const {
    auto numbers = known(ends, X_BA, kept);
    PathEnds other;
    const PathEnds& at = ends_at(ends, X_BA, other);
    const int wrap =
        surface_run_through({surfaces_, at, X_BA}, PathState(numbers.data(), wraps_.size()));
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
  [[nodiscard]] const PathEnds& ends_at(const LineEnds& ends,
                                        const RigidTransform& X_BA,
                                        PathEnds& other) const {
    const Vector3d s_D = X_BA.R.transpose() * ends.q;
    const bool same = ends.x_C == ends_.end[0].given &&
                      (s_D - ends_.end[1].given).squaredNorm() <= 1e-26 * (1 + s_D.squaredNorm());
    if (same) return ends_;
    return other = path_ends(wraps_, ends.x_C, s_D, inside_);
  }

  /// `kept`, found where it is unknown.
  [[nodiscard]] std::array<double, kMostPathNumbers> known(const LineEnds& ends,
                                                           const RigidTransform& X_BA,
                                                           const double* kept) const {
    std::array<double, kMostPathNumbers> copy = unknown_path();
    std::copy(kept, kept + numbers(), copy.begin());
    if (std::isnan(copy[0])) at(ends, X_BA, copy.data(), nullptr);
    return copy;
  }

  double at(const LineEnds& ends, const RigidTransform& X_BA, double* kept, Wrench* unit) const {
    PathEnds other;
    const PathEnds& found = ends_at(ends, X_BA, other);
    return pull_path({surfaces_, found, X_BA}, PathState(kept, wraps_.size()), unit);
  }

  std::vector<PathWrap> wraps_;
  PathEnds ends_;
  InsideRule inside_;
  std::vector<PathSurface> surfaces_;
};

/// Angle between the tangents at either end [rad].
double turn_of(const Geodesic& g) {
  return std::atan2(g.from.t.cross(g.to.t).norm(), g.from.t.dot(g.to.t));
}

void SurfacesPath::add_touches(const LineEnds& ends,
                               const RigidTransform& X_BA,
                               const double* kept,
                               std::vector<LineTouch>& touches) const {
  auto numbers = known(ends, X_BA, kept);
  const PathState state(numbers.data(), wraps_.size());
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
    const Geodesic g = shoot(shape, frame_at(shape, place.P, place.t), place.arc);
    touch.touching = true;
    touch.P = X * g.from.x;
    touch.Q = X * g.to.x;
    touch.t_P = X.R * g.from.t;
    touch.t_Q = X.R * g.to.t;
    touch.arc = place.arc;
    touch.turn = turn_of(g);
  }
}

void SurfacesPath::keep(const std::vector<LineTouch>& touches, double* kept) const {
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
}

std::string SurfacesPath::objection(const LineEnds& ends,
                                    const RigidTransform& X_BA,
                                    const double* kept) const {
  const Finding found = finding(ends, X_BA, kept);
  const std::string name = found.wrap < 0
                               ? "its wraps"
                               : "\"" + wraps_[static_cast<std::size_t>(found.wrap)].name + "\"";
  switch (found.outcome) {
    case Outcome::kFound:
      return run_through(ends, X_BA, kept);
    case Outcome::kNotShortest:
      return "its path over " + name + " is not the shortest: it goes past a conjugate point";
    case Outcome::kEndInside:
      return "an end of it lies inside " + name;
    case Outcome::kNotFound:
      break;
  }
  return "no shortest path over " + name + " was found";
}

/// Anchors, and geodesics as chords that turn by 0.1 rad at most.
void SurfacesPath::add_points(const LineEnds& ends,
                              const RigidTransform& X_BA,
                              const double* kept,
                              std::vector<Vector3d>& points) const {
  constexpr double kChord = 0.1;
  auto numbers = known(ends, X_BA, kept);
  const PathState state(numbers.data(), wraps_.size());
  PathEnds other;
  const PathEnds& found = ends_at(ends, X_BA, other);
  const auto anchored = [&](int end) {
    return found.end[end].wrap >= 0 && !state.touches(found.end[end].wrap);
  };
  if (anchored(0)) points.push_back(found.end[0].at);
  for (std::size_t i = 0; i < wraps_.size(); ++i) {
    if (!state.touches(static_cast<int>(i))) continue;
    const ArcPlace place = state.place(static_cast<int>(i));
    const WrapShape& shape = wraps_[i].shape;
    const RigidTransform X = wraps_[i].on_moving ? X_BA * wraps_[i].placement : wraps_[i].placement;
    SurfaceFrame at = frame_at(shape, place.P, place.t);
    const int chords = static_cast<int>(std::ceil(turn_of(shoot(shape, at, place.arc)) / kChord));
    points.push_back(X * at.x);
    for (int k = 0; k < chords; ++k) {
      at = shoot(shape, at, place.arc / chords).to;
      points.push_back(X * at.x);
    }
  }
  if (anchored(1)) points.push_back(X_BA * found.end[1].at);
}

bool has_size(const WrapShape& shape) {
  if (const auto* torus = std::get_if<WrapTorus>(&shape))
    return torus->tube > 0 && torus->ring > torus->tube;
  return least_radius(shape) > 0;
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
