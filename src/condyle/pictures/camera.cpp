#include "condyle/pictures/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "condyle/input_error.h"

namespace condyle {
namespace {

constexpr std::array<const char*, kViewCount> kNames = {
    "anterior", "posterior", "medial", "lateral", "plateau", "condyles", "exploded"};
constexpr double kElevation = 28 * M_PI / 180, kAzimuth = 20 * M_PI / 180;  // of the exploded view

/// The directions as a camera needs them: exactly perpendicular.
Eigen::Matrix3d rows_from(const Eigen::Vector3d& forward, const Eigen::Vector3d& up) {
  const Eigen::Vector3d right = forward.cross(up).normalized();
  Eigen::Matrix3d R;
  R.row(0) = right;
  R.row(1) = right.cross(forward).normalized();
  R.row(2) = -forward.normalized();
  return R;
}

}  // namespace

const char* name(View view) { return kNames[static_cast<std::size_t>(view)]; }

View view_from_name(const std::string& text) {
  for (int i = 0; i < kViewCount; ++i) {
    if (text == kNames[static_cast<std::size_t>(i)]) return static_cast<View>(i);
  }
  std::string all;
  for (const char* known : kNames) all += (all.empty() ? "" : ", ") + std::string(known);
  throw InputError("view \"" + text + "\" is not known, expected one of " + all);
}

Anatomy anatomy_of(const Scene& scene) {
  if (!scene.joint)
    return {Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), false};
  const AnatomicalFrame& tibia = scene.joint->tibia;
  return {tibia.lateral, tibia.anterior, tibia.proximal};
}

Eigen::Matrix3d view_rotation(View view, const Anatomy& anatomy) {
  switch (view) {
    case View::kAnterior:
      return rows_from(-anatomy.anterior, anatomy.proximal);
    case View::kPosterior:
      return rows_from(anatomy.anterior, anatomy.proximal);
    case View::kMedial:
      return rows_from(anatomy.lateral, anatomy.proximal);
    case View::kLateral:
      return rows_from(-anatomy.lateral, anatomy.proximal);
    case View::kPlateau:
      return rows_from(-anatomy.proximal, anatomy.anterior);
    case View::kCondyles:
      return rows_from(anatomy.proximal, anatomy.anterior);
    case View::kExploded:
      return rows_from(-std::cos(kElevation) * (std::cos(kAzimuth) * anatomy.anterior +
                                                std::sin(kAzimuth) * anatomy.lateral) -
                           std::sin(kElevation) * anatomy.proximal,
                       anatomy.proximal);
  }
  return Eigen::Matrix3d::Identity();
}

Camera fit_camera(const Eigen::Matrix3d& R_VP,
                  const std::vector<Eigen::Vector3d>& points,
                  const Frame& frame) {
  assert(!points.empty());
  Eigen::Vector3d low = R_VP * points.front(), high = low;
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d v = R_VP * p;
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Eigen::Vector3d size = (high - low).cwiseMax(1.0);
  Camera camera;
  camera.R_VP = R_VP;
  camera.target = R_VP.transpose() * (0.5 * (low + high));
  camera.center = {0.5 * (frame.left + frame.right), 0.5 * (frame.top + frame.bottom)};
  camera.mm_per_pixel =
      std::max(size.x() / (frame.right - frame.left), size.y() / (frame.bottom - frame.top));
  return camera;
}

std::string direction_letter(const Anatomy& anatomy, const Eigen::Vector3d& direction) {
  const std::array<Eigen::Vector3d, 3> axes = {anatomy.lateral, anatomy.anterior, anatomy.proximal};
  constexpr std::array<const char*, 6> kAnatomical = {"L", "M", "A", "P", "S", "I"},
                                       kAxes = {"z", "−z", "x", "−x", "y", "−y"};
  int best = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(direction.dot(axes[i])) > std::abs(direction.dot(axes[best]))) best = i;
  }
  const std::size_t letter =
      2 * static_cast<std::size_t>(best) + (direction.dot(axes[best]) < 0 ? 1 : 0);
  return anatomy.known ? kAnatomical[letter] : kAxes[letter];
}

}  // namespace condyle
