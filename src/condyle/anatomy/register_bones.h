#pragma once

/// One bone laid over another of the same kind, both in anatomical components (anterior, proximal,
/// lateral) [mm]: samples, alignment, and a smooth field from stiff to soft.

#include "condyle/anatomy/align_surfaces.h"
#include "condyle/anatomy/lattice_field.h"
#include "condyle/anatomy/surface_pairs.h"

namespace condyle {

struct BoneRegistration {
  Alignment alignment;
  LatticeField field;    ///< over aligned points
  SampledSurface to;     ///< the other bone
  MovedSurface surface;  ///< samples of the one, aligned and where the field takes them
  SurfacePairs found;    ///< of these samples

  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d aligned = alignment.at(p);
    return aligned + field.at(aligned);
  }
};

/// `points`: what the registration is for, on `from`; of shafts no more is looked at than lies within
/// some cm of them. Neither mesh need be closed; where `to` is open its sides are told by `from`.
[[nodiscard]] BoneRegistration register_bones(const TriangleMesh& from,
                                              const TriangleMesh& to,
                                              const std::vector<Eigen::Vector3d>& points);

}  // namespace condyle
