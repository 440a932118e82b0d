#pragma once

/// The gap between articular surfaces in colours: from each point of one surface to the nearest
/// point of the surface that its contact pairs it with, both as the contact mechanics has them
/// (fitted patches or exact surfaces, never the mesh).

#include <memory>
#include <vector>

#include "condyle/pictures/shaded_mesh.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// Gaps from 0 to this have colours of their own; wider ones have the last [mm].
inline constexpr double kGapLimit = 6;
/// Surfaces that are deeper than this in each other have the alarm colour; less is touching [mm].
inline constexpr double kLeastOverlap = 1e-3;

class GapMap {
 public:
  /// `run` must outlive the map.
  explicit GapMap(const Run& run);

  struct Gap {
    double width = 0;    ///< negative where the surfaces overlap [mm]
    double inside = -1;  ///< of the opposite point to the edge of what is known; < 0: nothing known
    int contact = -1;    ///< of the scene, that pairs the surfaces
  };
  /// Of a drawn vertex of a surface: exact surfaces have that of the surface itself.
  [[nodiscard]] Eigen::Vector3d normal(std::size_t surface, const ShadedVertex& vertex) const;
  /// From the point p with the unit normal n of a surface of the scene, in the frame of its body.
  [[nodiscard]] Gap gap(std::size_t surface,
                        const Eigen::Vector3d& p,
                        const Eigen::Vector3d& n,
                        const std::vector<RigidTransform>& X_P) const;

  /// Puts the colours of the gap on the vertices of a mesh of that surface; `beyond` where the gap
  /// is not known, fading into it over the last millimetre. X_P are poses of the bodies as they
  /// stand. Returns the deepest overlap that has been painted, 0 where there is none [mm].
  double paint(ShadedMesh& mesh,
               std::size_t surface,
               const std::vector<RigidTransform>& X_P,
               const Paint& beyond) const;

 private:
  const Run& run_;
  std::vector<std::shared_ptr<const Surface>> surfaces_;  ///< as in the scene; null: not known
};

}  // namespace condyle
