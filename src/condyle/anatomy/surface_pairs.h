#pragma once

/// Which point of one surface belongs to which of another, as far as they lie near each other now:
/// nearest points that face the same way, looked for from both sides.

#include <memory>
#include <optional>
#include <vector>

#include "condyle/anatomy/surface_samples.h"

namespace condyle {

/// Where a surface, known by samples, lies under a point.
struct Opposite {
  std::size_t sample = 0;
  double height = 0;  ///< of the point over the sample's tangent plane [mm]
};

class SampledSurface {
 public:
  explicit SampledSurface(SurfaceSamples samples);
  ~SampledSurface();
  SampledSurface(SampledSurface&&) noexcept;

  [[nodiscard]] const SurfaceSamples& samples() const;
  /// Nearest sample within `reach` [mm] whose normal is within 60 degrees of `normal`; none where
  /// the surface ends beside the point (its edge, the rim of a cut).
  [[nodiscard]] std::optional<Opposite> under(const Eigen::Vector3d& p,
                                              const Eigen::Vector3d& normal,
                                              double reach) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

/// A point of the one surface and the plane of the other that it belongs on.
struct PointPair {
  Eigen::Vector3d from;        ///< before the field moves it [mm]
  Eigen::Vector3d to, normal;  ///< on the other surface [mm], unit
  double gap = 0;              ///< along the normal, now [mm]
  double weight = 0;           ///< area [mm²] times what trimming leaves of it
};

/// A surface as it stands and as it was before a field moved it, sample by sample.
struct MovedSurface {
  SurfaceSamples before;
  std::vector<Eigen::Vector3d> points, normals;  ///< now
};

struct SurfacePairs {
  std::vector<PointPair> pairs;
  std::vector<double> trust;  ///< of each sample of `from`: 0 none facing it, to 1
  std::vector<double> gaps;   ///< of each sample of `from` [mm]; 0 where none
  double rms = 0;             ///< gap of what is trusted [mm]
};

/// Pairs seen from `coarse` towards `other`, and from `other_coarse` towards `fine`. Gaps count
/// less the more they stand out of the others (biweight, 4 robust standard deviations).
[[nodiscard]] SurfacePairs pair_surfaces(const MovedSurface& coarse,
                                         const MovedSurface& fine,
                                         const SurfaceSamples& other_coarse,
                                         const SampledSurface& other,
                                         double reach);

}  // namespace condyle
