#pragma once

/// Knees and tables of measurements of this study: made, not measured.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/calibration/measurement_table.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle::calibration_study {

struct StudyKnee {
  Scene scene;  ///< with loads drawer, varus and internal, and [calibrate] without parameters
  std::vector<FittedSurface> surfaces;
  std::vector<TriangleMesh> meshes;  ///< by bodies
};

/// The scene of a file, with its surfaces fitted and the loads of laxity tests added on the tibia, in
/// the directions of its frame: 1 N forwards, 1 N mm of adduction and of internal rotation.
[[nodiscard]] StudyKnee study_knee(const std::filesystem::path& file);

/// Which tests are made: unloaded, and each load at -1, -1/2, 1/2 and 1 of its greatest level.
struct TestPlan {
  std::vector<double> flexions;                   ///< [deg]
  double drawer = 100, varus = 10, internal = 5;  ///< [N], [N m], [N m]
  std::vector<double> fractions = {-1, -0.5, 0.5, 1};
  bool all_coordinates =
      true;  ///< else of loaded poses the coordinate that is loaded, and it unloaded
  double sd_length = 0.5, sd_angle = 0.5;  ///< [mm], [deg]
};

/// Rows without values, in the order flexion, load, level, coordinate.
[[nodiscard]] MeasurementTable planned_table(const StudyKnee& knee, const TestPlan& plan);

/// Free numbers of all ligaments whose law has them.
void free_numbers(StudyKnee& knee, ParameterKind kind, double prior_sd, int body = -1);
/// One strain for each bundle of strands (scene/ligament_bundles.h).
void free_bundle_strains(StudyKnee& knee, double prior_sd);

}  // namespace condyle::calibration_study
