#pragma once

/// The poses that a table of measurements asks for: one for each flexion, load and level, and those
/// that rows are told from: unloaded ones of relative curves, the opposite ones of laxities.

#include <vector>

#include "condyle/calibration/measured_models.h"
#include "condyle/calibration/measurement_table.h"

namespace condyle {

struct TestPose {
  std::size_t model = 0;  ///< of MeasuredModels::models
  double flexion = 0;     ///< [rad]
  int load = -1;          ///< of Scene::loads, force-controlled; -1: none
  double level = 0;       ///< of the load [N] or [N mm], or of what is held [mm] or [rad]
  bool fitted = false;    ///< a row that is fitted needs it
  std::size_t row = 0;    ///< the first that needs it, a fitted one before others
};

/// A row of the table: at which pose it is told, and from which other one.
struct RowPlace {
  std::size_t pose = 0;
  int from = -1;  ///< pose whose number is taken from it, -1: none
};

struct TestPoses {
  std::vector<TestPose> poses;  ///< by model, flexion, load and level: neighbours are near
  std::vector<RowPlace> rows;   ///< as MeasurementTable::rows
};

[[nodiscard]] TestPoses test_poses(const Scene& scene,
                                   const MeasurementTable& table,
                                   const MeasuredModels& models);

/// What drives a pose of a knee whose loads are `factors` times the scene's: those that a test names act
/// in its poses only, all others in each.
[[nodiscard]] Drive drive_of(const TestPose& pose,
                             const Scene& scene,
                             const MeasuredModel& model,
                             const std::vector<double>& factors);

/// Scale of that load in that pose, before its factor.
[[nodiscard]] double nominal_scale(const TestPose& pose, const Scene& scene, std::size_t load);

}  // namespace condyle
