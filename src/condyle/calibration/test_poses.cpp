#include "condyle/calibration/test_poses.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace condyle {
namespace {

TestPose unloaded_pose(double flexion) {
  TestPose pose;
  pose.flexion = flexion;
  return pose;
}

TestPose pose_of(const Measurement& row, const Scene& scene, const MeasuredModels& models) {
  TestPose pose = unloaded_pose(row.flexion);
  if (row.load < 0) return pose;
  const CalibrationLoad& load = scene.calibration->loads[static_cast<std::size_t>(row.load)];
  pose.level = row.level;
  if (load.displacement_control)
    pose.model = models.that_holds(load.index);
  else if (row.level != 0)
    pose.load = load.index;
  return pose;
}

bool is_relative(const Measurement& row, const CalibrationDescription& calibration) {
  const std::vector<std::string>& curves = calibration.relative;
  return row.kind == MeasuredKind::kJointCoordinate &&
         std::find(curves.begin(), curves.end(), row.test) != curves.end();
}

/// The pose whose number is taken from that of the row, if there is one.
std::optional<TestPose> told_from(const Measurement& row,
                                  const Scene& scene,
                                  const MeasuredModels& models) {
  if (row.laxity) {
    Measurement opposite = row;
    opposite.level = -row.level;
    return pose_of(opposite, scene, models);
  }
  if (is_relative(row, *scene.calibration))
    return unloaded_pose(row.zero_flexion.value_or(row.flexion));
  return std::nullopt;
}

using Key = std::tuple<std::size_t, double, int, double>;

/// Poses by their keys; what asks for them is counted in the order of the table.
class Collected {
 public:
  void add(TestPose pose, std::size_t row, bool fitted) {
    pose.row = row;
    pose.fitted = fitted;
    const auto [at, is_new] = poses_.try_emplace(key(pose), pose);
    if (!is_new && fitted && !at->second.fitted) at->second = pose;
  }
  [[nodiscard]] std::size_t find(const TestPose& pose) const {
    return static_cast<std::size_t>(std::distance(poses_.begin(), poses_.find(key(pose))));
  }
  [[nodiscard]] std::vector<TestPose> in_order() const {
    std::vector<TestPose> poses;
    for (const auto& [of, pose] : poses_) poses.push_back(pose);
    return poses;
  }

 private:
  static Key key(const TestPose& pose) { return {pose.model, pose.flexion, pose.load, pose.level}; }
  std::map<Key, TestPose> poses_;
};

bool is_of_tests(const CalibrationDescription& calibration, std::size_t load) {
  return std::any_of(calibration.loads.begin(), calibration.loads.end(),
                     [load](const CalibrationLoad& of) {
                       return !of.displacement_control && of.index == static_cast<int>(load);
                     });
}

}  // namespace

TestPoses test_poses(const Scene& scene,
                     const MeasurementTable& table,
                     const MeasuredModels& models) {
  Collected collected;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Measurement& row = table.rows[i];
    const bool fitted = row.use == MeasuredUse::kFit;
    collected.add(pose_of(row, scene, models), i, fitted);
    if (const auto from = told_from(row, scene, models)) collected.add(*from, i, fitted);
  }
  TestPoses result;
  result.poses = collected.in_order();
  for (const Measurement& row : table.rows) {
    RowPlace& place = result.rows.emplace_back();
    place.pose = collected.find(pose_of(row, scene, models));
    if (const auto from = told_from(row, scene, models))
      place.from = static_cast<int>(collected.find(*from));
  }
  return result;
}

double nominal_scale(const TestPose& pose, const Scene& scene, std::size_t load) {
  if (pose.load == static_cast<int>(load)) return pose.level / scene.loads[load].vector.norm();
  return is_of_tests(*scene.calibration, load) ? 0 : scene.loads[load].scale;
}

Drive drive_of(const TestPose& pose,
               const Scene& scene,
               const MeasuredModel& model,
               const std::vector<double>& factors) {
  Drive drive = drive_of(*model.model);
  const auto set = [&](int condition, double value) {
    if (condition >= 0)
      drive
          .values[static_cast<std::size_t>(model.conditions[static_cast<std::size_t>(condition)])] =
          value;
  };
  set(scene.calibration->flexion, pose.flexion);
  set(model.held, pose.level);
  for (std::size_t i = 0; i < drive.scales.size(); ++i)
    drive.scales[i] = factors[i] * nominal_scale(pose, scene, i);
  return drive;
}

}  // namespace condyle
