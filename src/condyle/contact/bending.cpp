#include "condyle/contact/bending.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/contact/curvature_tensor.h"

namespace condyle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kInnermost = 3;  // radius of the first shell, in spacings

}  // namespace

Facing over_quadric(const SurfacePoint& at, const Eigen::Vector3d& point) {
  const Eigen::Vector3d d = point - at.c;
  const double along = d.dot(at.n);
  return {&at, 0, 0, d - along * at.n, along};
}

Facing facing_cell(const SurfaceCover& cover, const Eigen::Vector3d& p, int near) {
  Facing facing = over_quadric(cover.sample(near), p);
  facing.bend = cover.cell_change(near);
  facing.error = 0.5 * facing.bend * facing.beside.squaredNorm();
  return facing;
}

Bending::Radii Bending::shells(double spacing, double greatest) {
  const double least = kInnermost * spacing;
  const double ratio = std::pow(std::max(greatest / least, 1.0), 1.0 / (kLevels - 1));
  Radii radii;
  for (std::size_t level = 0; level < kLevels; ++level)
    radii[level] = least * std::pow(ratio, static_cast<double>(level));
  return radii;
}

Bending::Bending(const SurfaceCover& cover, const Radii& radii)
    : cover_(&cover), quadrics_(cover), radii_(radii) {
  if (cover.bends_evenly()) return;
  shells_.resize(static_cast<std::size_t>(cover.size()));
}

/// Its curvature differs from the sample's, and so do height and slope on the way there, by less
/// than half as much again.
double Bending::shift(int sample, const Eigen::Matrix3d& K) const {
  if (cover_->bends_evenly() || sample < 0) return 0;
  const SurfacePoint& at = cover_->sample(sample);
  return 1.5 * tangent_change(K, at.K, at.n);
}

Rise Bending::in_shell(int level, int sample, const Eigen::Matrix3d& K) {
  const auto shell = static_cast<std::size_t>(level);
  if (cover_->bends_evenly()) return even_rise(radii_[shell], K);
  if (sample < 0) return {kInfinity, kInfinity};
  Shells& shells = shells_[static_cast<std::size_t>(sample)];
  if (!shells.measured[shell]) {
    shells.of[shell] = quadrics_.rise(cover_->sample(sample), cover_->cell_radius(sample),
                                      shell == 0 ? 0 : radii_[shell - 1], radii_[shell]);
    shells.measured[shell] = true;
  }
  return shells.of[shell];
}

bool Bending::pays(int sample) {
  if (cover_->bends_evenly() || sample < 0) return true;
  return std::exchange(shells_[static_cast<std::size_t>(sample)].asked, now_) == now_;
}

}  // namespace condyle
