#include "condyle/reference/fit_heights.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene/swept_quantity.h"
#include "condyle/surface/affordable_samples.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSampleSpacing = 1;  // [mm] of points on exact surfaces
constexpr double kMargin = 20 * kDegree, kWidest = 70 * kDegree;

struct Points {
  std::vector<Vector3d> c, n;
  std::vector<double> weights;
};

Points points_of(const FittedSurface& fitted) {
  Points points;
  if (!fitted.region.vertices.empty()) {
    points.c = fitted.region.vertices;
    points.n = vertex_normals(fitted.region);
    points.weights = vertex_areas(fitted.region);
    return points;
  }
  for (const Place& place : affordable_samples(*fitted.surface, kSampleSpacing)) {
    const SurfacePoint at = fitted.surface->evaluate_frame(place);
    points.c.push_back(at.c);
    points.n.push_back(at.n);
    points.weights.push_back(1);
  }
  return points;
}

/// Only those that are seen along `direction` at less than `angle`.
Points facing(const Points& points, const Vector3d& direction, double angle) {
  Points kept;
  for (std::size_t i = 0; i < points.c.size(); ++i) {
    if (!(points.n[i].dot(direction) > std::cos(angle)) || !(points.weights[i] > 0)) continue;
    kept.c.push_back(points.c[i]);
    kept.n.push_back(points.n[i]);
    kept.weights.push_back(points.weights[i]);
  }
  return kept;
}

Vector3d mean_of(const std::vector<Vector3d>& vectors, const std::vector<double>& weights) {
  Vector3d sum = Vector3d::Zero();
  double total = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    sum += weights[i] * vectors[i];
    total += weights[i];
  }
  return sum / total;
}

/// Flexion over the sweep: its middle and half its width.
struct FlexionRange {
  double middle = 0, half = 0;
  explicit FlexionRange(const Scene& scene) {
    double low = 1e300, high = -1e300;
    const auto include = [&](double value) {
      low = std::min(low, value);
      high = std::max(high, value);
    };
    const int swept = quantity_of_sweep(scene).condition;
    for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
      if (scene.conditions[i].kind != ConditionKind::kFlexion) continue;
      include(scene.conditions[i].value);
      if (swept != static_cast<int>(i)) continue;
      low = high = scene.sweep->values.front();
      for (const double value : scene.sweep->values) include(value);
    }
    if (scene.laxity)
      for (const double value : scene.laxity->flexions) include(value);
    if (low > high) return;
    middle = (low + high) / 2;
    half = (high - low) / 2;
  }
};

/// Where the plane of a surface faces, and how far from that its points may.
struct Facing {
  Vector3d direction;
  double angle;
};

class HeightFitter {
 public:
  HeightFitter(const Scene& scene, const std::vector<FittedSurface>& surfaces, int degree)
      : scene_(scene), surfaces_(surfaces), degree_(degree), range_(scene) {}

  /// `opposites`: the surfaces that it meets in contacts.
  [[nodiscard]] HeightFit fit(std::size_t index, const std::vector<std::size_t>& opposites) const {
    const SurfaceDescription& description = scene_.surfaces[index];
    if (description.kind == SurfaceKind::kPlane || description.kind == SurfaceKind::kPolynomial)
      return as_it_is(description, middle_of(index));
    const Facing toward = is_femoral(index) ? femoral_facing(opposites) : own_facing(index);
    return fit_points(facing(points_of(surfaces_[index]), toward.direction, toward.angle),
                      description, toward.direction);
  }

 private:
  [[nodiscard]] bool is_femoral(std::size_t index) const {
    return scene_.surfaces[index].body == scene_.joint->femur.body;
  }

  [[nodiscard]] Facing own_facing(std::size_t index) const {
    const SurfaceDescription& description = scene_.surfaces[index];
    if (description.kind == SurfaceKind::kPlane) return {description.direction, kWidest};
    if (description.kind == SurfaceKind::kPolynomial)
      return {description.solid_inside ? Vector3d(description.axes.col(2))
                                       : Vector3d(-description.axes.col(2)),
              kWidest};
    const Points points = points_of(surfaces_[index]);
    Vector3d mean = mean_of(points.n, points.weights);
    // A whole ball or torus has no mean normal: the side that faces the femur is meant.
    if (mean.norm() < 0.2) mean = scene_.joint->tibia.proximal;
    return {mean.normalized(), kWidest};
  }

  /// Against the mean normal of the tibial surfaces, as the femur sees it at the middle of the sweep.
  [[nodiscard]] Facing femoral_facing(const std::vector<std::size_t>& opposites) const {
    Vector3d mean = Vector3d::Zero();
    for (const std::size_t opposite : opposites) mean += own_facing(opposite).direction;
    if (mean.norm() < 0.2) mean = scene_.joint->tibia.proximal;
    const JointFrames frames = joint_frames(scene_);
    const Eigen::Matrix3d R_BA = rotation_from_joint_angles(frames, range_.middle, 0, 0);
    const Eigen::Matrix3d R_FT = frames.tibia_moves ? R_BA : Eigen::Matrix3d(R_BA.transpose());
    return {-(R_FT * mean.normalized()), std::min(range_.half + kMargin, kWidest)};
  }

  /// The joint's origin in the frame of the surface's body.
  [[nodiscard]] const Vector3d& middle_of(std::size_t index) const {
    return is_femoral(index) ? scene_.joint->femur.origin : scene_.joint->tibia.origin;
  }

  /// A plane or a polynomial of the scene needs no fit. Of a plane without end the point that is nearest to the middle stands
  /// for it, whichever names it.
  static HeightFit as_it_is(const SurfaceDescription& description, const Vector3d& middle) {
    HeightFit fit;
    HeightSurface& surface = fit.surface;
    surface.origin = description.point;
    if (description.kind == SurfaceKind::kPlane) {
      const Vector3d& n = description.direction;
      if (!std::isfinite(description.known_radius))
        surface.origin = middle + n.dot(description.point - middle) * n;
      surface.axes.col(2) = description.direction;
      surface.axes.col(0) = description.direction.unitOrthogonal();
      surface.axes.col(1) = surface.axes.col(2).cross(surface.axes.col(0));
    } else {
      surface.axes = description.axes;
      surface.terms = description.terms;
      surface.solid_below = description.solid_inside;
      for (const PolynomialTerm& term : surface.terms)
        fit.degree = std::max(fit.degree, term.i + term.j);
    }
    constexpr int kCorners = 48;
    for (int i = 0; i < kCorners && std::isfinite(description.known_radius); ++i) {
      const double angle = 2 * M_PI * i / kCorners;
      surface.outline.push_back(description.known_radius *
                                Vector2d(std::cos(angle), std::sin(angle)));
    }
    return fit;
  }

  [[nodiscard]] HeightFit fit_points(const Points& points,
                                     const SurfaceDescription& description,
                                     const Vector3d& direction) const {
    const int unknowns = (degree_ + 1) * (degree_ + 2) / 2;
    if (static_cast<int>(points.c.size()) < 2 * unknowns) {
      throw InputError(fmt::format(
          "{}: surface \"{}\": {} points face the other bone, expected at least {} for a "
          "polynomial "
          "of degree {}",
          scene_.file.string(), description.name, points.c.size(), 2 * unknowns, degree_));
    }
    HeightFit fit;
    fit.fitted = true;
    fit.degree = degree_;
    fit.points = static_cast<int>(points.c.size());
    const JointDescription& joint = *scene_.joint;
    const bool femoral = description.body == joint.femur.body;
    const Vector3d lateral = femoral ? joint.femur.lateral : joint.tibia.lateral;
    Eigen::Matrix3d& axes = fit.surface.axes;
    axes.col(2) = direction;
    axes.col(1) = (lateral - lateral.dot(direction) * direction).normalized();
    axes.col(0) = axes.col(1).cross(axes.col(2));
    fit.surface.origin = mean_of(points.c, points.weights);
    fit_height_polynomial(points.c, points.weights, degree_, fit.surface);
    measure(points, fit);
    return fit;
  }

  /// Distances at right angles to the surface, to first order in what is left.
  static void measure(const Points& points, HeightFit& fit) {
    double sum = 0, total = 0;
    for (std::size_t i = 0; i < points.c.size(); ++i) {
      const HeightPoint at = evaluate(fit.surface, coordinates_of(fit.surface, points.c[i]));
      const double distance = std::abs(at.n.dot(points.c[i] - at.c));
      sum += points.weights[i] * distance * distance;
      total += points.weights[i];
      fit.max = std::max(fit.max, distance);
    }
    fit.rms = std::sqrt(sum / total);
  }

  const Scene& scene_;
  const std::vector<FittedSurface>& surfaces_;
  int degree_;
  FlexionRange range_;
};

}  // namespace

std::vector<HeightFit> fit_heights(const Scene& scene,
                                   const std::vector<FittedSurface>& surfaces,
                                   int degree) {
  std::vector<std::vector<std::size_t>> opposites(scene.surfaces.size());
  for (const ContactDescription& contact : scene.contacts) {
    if (contact.state == ContactState::kOpen) continue;
    const auto first = static_cast<std::size_t>(contact.surfaces[0]),
               second = static_cast<std::size_t>(contact.surfaces[1]);
    opposites[first].push_back(second);
    opposites[second].push_back(first);
  }
  const HeightFitter fitter(scene, surfaces, degree);
  std::vector<HeightFit> fits(scene.surfaces.size());
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (!opposites[i].empty()) fits[i] = fitter.fit(i, opposites[i]);
  return fits;
}

}  // namespace condyle
