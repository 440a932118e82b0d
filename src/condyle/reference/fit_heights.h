#pragma once

/// From the surfaces of a scene to height polynomials, fitted by least squares to the points that
/// the patches were fitted to.
///
/// A height over a plane cannot follow a condyle round the back. The plane of a tibial surface is
/// across its mean normal; that of a femoral one faces the tibial surfaces that it meets, in the
/// middle of the flexion that is swept, and points that are seen from there at more than half the
/// sweep and 20 degrees, at most 70, have no say.

#include <string>
#include <vector>

#include "condyle/reference/height_surface.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

inline constexpr int kLowestDegree = 2, kHighestDegree = 6, kUsualDegree = 4;

struct HeightFit {
  HeightSurface surface;
  bool fitted = false;      ///< else the scene's surface is such a polynomial itself
  int degree = 0;           ///< total
  int points = 0;           ///< that were fitted
  double rms = 0, max = 0;  ///< distance of the points from the surface [mm]
};

/// One per Scene::surfaces; only those of contacts are fitted. Needs [joint]. Throws InputError
/// where a surface has too few points.
[[nodiscard]] std::vector<HeightFit> fit_heights(const Scene& scene,
                                                 const std::vector<FittedSurface>& surfaces,
                                                 int degree = kUsualDegree);

/// The polynomial of total degree `degree` through points (weights > 0) by least squares; `surface`
/// gives origin and axes, and gets terms and outline.
void fit_height_polynomial(const std::vector<Eigen::Vector3d>& points,
                           const std::vector<double>& weights,
                           int degree,
                           HeightSurface& surface);

}  // namespace condyle
