#pragma once

/// Where a straight line meets a surface, and how far aside it would just touch it, frame of the surface
/// [mm].

#include <Eigen/Core>

#include <optional>

#include "condyle/wrapping/wrap_shape.h"

namespace condyle {

/// Least height of the line from U to V over the surface, negative inside [mm]; exact where it is 0, of
/// sphere, cylinder and torus everywhere. `part`: where, 0 at U, 1 at V.
[[nodiscard]] double clearance(const WrapShape& shape,
                               const Eigen::Vector3d& U,
                               const Eigen::Vector3d& V,
                               double* part = nullptr);

/// A line shifted by `shift` along w touches the surface from outside at `point`.
struct TouchingLine {
  Eigen::Vector3d w;
  double shift;
  Eigen::Vector3d point;
  double part;  ///< 0 at U, 1 at V, outside of it beyond them
};

/// The line through U and V shifted towards the side of w, w not along it; the shift is negative where
/// the line passes clear of the surface on that side. Nothing where a line so shifted passes it by, or
/// would touch where the surface is hollow along it.
[[nodiscard]] std::optional<TouchingLine> touching_line(const WrapShape& shape,
                                                        const Eigen::Vector3d& U,
                                                        const Eigen::Vector3d& V,
                                                        const Eigen::Vector3d& w);

/// The shortest way to leave the surface, at right angles to the line; where one touches between U and V,
/// the shortest of these.
[[nodiscard]] std::optional<TouchingLine> nearest_touching_line(const WrapShape& shape,
                                                                const Eigen::Vector3d& U,
                                                                const Eigen::Vector3d& V);

}  // namespace condyle
