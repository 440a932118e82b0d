#include "accuracy/phantom_regions.h"

#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle::accuracy {

std::vector<PhantomRegion> phantom_regions(const TriangleMesh& femur, const TriangleMesh& tibia) {
  using Eigen::Vector3d;
  using phantom::Bone;
  const BoneFrame frame{Vector3d::Zero(), Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
  const CondylarAxis axis = fit_condylar_axis(femur, vertex_normals(femur), frame);
  return {
      {"medial condyle", Bone::kFemur, femoral_region(femur, axis, Half::kMedial)},
      {"lateral condyle", Bone::kFemur, femoral_region(femur, axis, Half::kLateral)},
      {"medial plateau", Bone::kTibia, tibial_region(tibia, frame, Half::kMedial)},
      {"lateral plateau", Bone::kTibia, tibial_region(tibia, frame, Half::kLateral)},
  };
}

}  // namespace condyle::accuracy
