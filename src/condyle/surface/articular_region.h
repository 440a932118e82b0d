#pragma once

/// The articular part of a bone or cartilage mesh, and the chart on which a patch is laid over it.
///
/// Works on open cartilage sheets (one femoral sheet for both condyles, two tibial ones), closed
/// cartilage slabs (the inner face is left out) and whole bones (shaft, trochlea, roof of the notch
/// and rim are left out). A condyle is charted about a line within it (condyle_chart.h), the tibia
/// by its height over the mean plane of the plateau; see docs/surface.md.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"
#include "condyle/surface/condylar_axis.h"

namespace condyle {

/// Which half of the knee; the frame's lateral direction tells.
enum class Half { kMedial, kLateral };

struct ArticularRegion {
  TriangleMesh mesh;                     ///< of the region alone, facing out of the bone
  std::vector<Eigen::Vector3d> normals;  ///< unit normals of the vertices, out of the bone
  std::vector<Eigen::Vector2d> chart;    ///< (u, v) of the vertices [mm of chart length]
  std::vector<double> slope;  ///< cosine between normal and chart direction at the vertices
  std::vector<bool> face;     ///< vertices of the articular face proper, without flanks and crests;
                              ///< empty: all. It sets the smoothing.
  double sheet_below =
      0;  ///< to another sheet of the mesh, left out, as a bone under its cartilage; 0: none [mm]
  std::vector<std::string> notes;  ///< what was chosen and left out, one line each
};

/// Limits of the articular area.
struct RegionOptions {
  double femur_first_angle = -0.98,
         femur_last_angle = 2.45;  ///< about the condylar axis, 0 distal, + posterior [rad]
  double femur_least_cosine =
      0.25;  ///< of normal and radial direction: beyond it lie notch and side walls
  double tibia_least_cosine =
      0.3;  ///< of normal and plateau direction on the side of the eminence: beyond lie its walls
  std::optional<std::array<Eigen::Vector3d, 2>> box =
      {};             ///< two opposite corners of what may belong to the region [mm]; absent: all
  double beyond = 0;  ///< that the region goes on beyond these limits, but for the box, where the
                      ///< mesh goes on and its chart does not fold [mm]
  double normal_smoothing =
      1.5;  ///< normals are averaged over this distance before they decide [mm]
};

/// Region of one compartment. Throws InputError (without the name of the surface) where nothing can
/// be found.
[[nodiscard]] ArticularRegion femoral_region(const TriangleMesh& mesh,
                                             const CondylarAxis& axis,
                                             Half half,
                                             const RegionOptions& options = {});
[[nodiscard]] ArticularRegion tibial_region(const TriangleMesh& mesh,
                                            const BoneFrame& frame,
                                            Half half,
                                            const RegionOptions& options = {});
/// The part of a mesh within the box between two corners [mm] that faces the way most of it does.
[[nodiscard]] ArticularRegion box_region(const TriangleMesh& mesh,
                                         const std::array<Eigen::Vector3d, 2>& corners);

}  // namespace condyle
