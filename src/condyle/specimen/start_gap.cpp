#include "condyle/specimen/start_gap.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "condyle/scene/start_pose.h"
#include "condyle/surface/affordable_samples.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kSpacing = 2;  // of the points where gaps are looked for [mm]

/// The gap from places of one surface to another one, its frame being that of the place's body.
class GapFrom {
 public:
  GapFrom(const Surface& a, const Surface& b, const RigidTransform& X_ba)
      : a_(a), b_(b), X_ba_(X_ba) {}

  struct At {
    Place on_a, on_b;
    double gap = std::numeric_limits<double>::infinity();  ///< where they do not face each other
    SurfacePoint a, b;
  };
  [[nodiscard]] At at(const Place& place, const Place* near = nullptr) const {
    At at{place, {}, std::numeric_limits<double>::infinity(), a_.evaluate(place), {}};
    const Vector3d p = X_ba_ * at.a.c;
    at.on_b = b_.closest(p, near != nullptr ? *near : b_.seed(p));
    at.b = b_.evaluate(at.on_b);
    const bool faces = (X_ba_.R * at.a.n).dot(at.b.n) <= -0.5;
    if (faces && a_.edge_distance(at.on_a) >= 0 && b_.edge_distance(at.on_b) >= 0)
      at.gap = at.b.n.dot(p - at.b.c);
    return at;
  }

  /// From a place near it, to 1e-9 mm where it lies within both surfaces: Newton's steps where the gap bends upwards, with
  /// the second derivative -(K_a + K_b), else along its slope, halved until it falls.
  [[nodiscard]] double least_near(At at) const {
    constexpr int kSteps = 30, kHalvings = 20;
    for (int k = 0; k < kSteps; ++k) {
      const double before = at.gap;
      Vector3d step = step_from(at);
      bool fell = false;
      for (int half = 0; half < kHalvings && !fell; ++half, step /= 2) {
        const At next = this->at(a_.moved(at.on_a, at.a, step), &at.on_b);
        fell = next.gap < at.gap;
        if (fell) at = next;
      }
      if (!fell || before - at.gap < 1e-9) break;
    }
    return at.gap;
  }

 private:
  [[nodiscard]] Vector3d step_from(const At& at) const {
    constexpr double kFarthest = 2;  // [mm]
    const Vector3d t = at.a.n.unitOrthogonal();
    Eigen::Matrix<double, 3, 2> tangents;
    tangents << t, at.a.n.cross(t);
    const Eigen::Vector2d slope = tangents.transpose() * (X_ba_.R.transpose() * at.b.n);
    const Eigen::Matrix2d bend =
        -tangents.transpose() * (at.a.K + X_ba_.R.transpose() * at.b.K * X_ba_.R) * tangents;
    const bool upwards = bend(0, 0) > 0 && bend.determinant() > 0;
    Eigen::Vector2d step = upwards ? Eigen::Vector2d(-bend.inverse() * slope)
                                   : Eigen::Vector2d(-slope * kFarthest / slope.norm());
    if (!(step.norm() <= kFarthest)) step *= kFarthest / step.norm();
    return tangents * step;
  }

  const Surface &a_, &b_;
  RigidTransform X_ba_;
};

}  // namespace

double start_gap(const Scene& scene,
                 const std::vector<FittedSurface>& surfaces,
                 const ContactDescription& contact) {
  const RigidTransform X_BA = start_pose(scene);
  const auto pose = [&](int s) {
    return scene.surfaces[s].body == scene.moving_body() ? X_BA : RigidTransform{};
  };
  double least = std::numeric_limits<double>::infinity();
  for (const bool turned : {false, true}) {
    const int from = contact.surfaces[turned ? 1 : 0], to = contact.surfaces[turned ? 0 : 1];
    const Surface& a = *surfaces[from].surface;
    if (!std::isfinite(a.extent().radius)) continue;  // no places to look from
    const GapFrom gap(a, *surfaces[to].surface, pose(to).inverse() * pose(from));
    std::optional<GapFrom::At> lowest;
    for (const Place& place : affordable_samples(a, kSpacing))
      if (GapFrom::At at = gap.at(place); !lowest || at.gap < lowest->gap) lowest = std::move(at);
    if (lowest && std::isfinite(lowest->gap)) least = std::min(least, gap.least_near(*lowest));
  }
  return least;
}

}  // namespace condyle
