#include "condyle/anatomy/tibial_frame.h"

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/anatomy/shaft_line.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/surface/face_out.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kTibialShaftFirst = 0.6, kTibialShaftLast = 0.95,
                 kTibialShaftLeast = 0.22;  // below the plateau, of its width
// Of plateaus against shafts: 3.9 to 7.5 degrees in ten knees, 7 in the literature.
constexpr double kMeanSlope = 6.5 * M_PI / 180;

}  // namespace

TibialShape find_tibial_frame(CleanMesh& tibia, const KneeEnds& ends, const Vector3d& anterior) {
  BoneFrame rough;
  rough.proximal = ends.proximal;
  face_out_of_tibia(tibia, rough);
  TibialShape shape;
  const TriangleMesh end = crop_ball(tibia.mesh, ends.joint, 1.1 * ends.tibia_width);
  shape.plateau = fit_plateau(end, vertex_normals(end), ends.joint, ends.proximal, ends.across);
  Plateau& plateau = shape.plateau;
  if (anterior.dot(plateau.normal.cross(plateau.halves)) < 0) {
    plateau.halves *= -1;
    plateau.across *= -1;
  }
  BoneFrame& frame = shape.frame;
  frame.origin = plateau.middle;
  frame.lateral = plateau.halves;
  const Vector3d forward = plateau.normal.cross(frame.lateral).normalized();
  const Vector3d upward =
      frame.lateral.cross(forward);  // the normal, but at right angles to lateral
  frame.proximal = upward * std::cos(kMeanSlope) + forward * std::sin(kMeanSlope);
  const double w = plateau.width;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const auto line =
        find_shaft_line(tibia.mesh, frame.origin, -frame.proximal,
                        {kTibialShaftFirst * w, kTibialShaftLast * w, kTibialShaftLeast * w});
    if (!line) break;
    shape.shaft = line->length;
    shape.shaft_first = kTibialShaftFirst * w;
    frame.proximal =
        -(line->direction - frame.lateral * frame.lateral.dot(line->direction)).normalized();
  }
  frame.anterior = frame.proximal.cross(frame.lateral);
  shape.slope = -std::asin(frame.anterior.dot(plateau.normal));
  return shape;
}

}  // namespace condyle
