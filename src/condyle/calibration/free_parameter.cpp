#include "condyle/calibration/free_parameter.h"

#include <fmt/format.h>

#include <set>

#include "condyle/elements/joint_table.h"

namespace condyle {
namespace {

void add_frame(const std::optional<std::array<double, 2>>& sd,
               FreeParameter::Kind kind,
               const char* name,
               std::vector<FreeParameter>& parameters) {
  if (!sd) return;
  constexpr const char* kAxes[] = {"lateral", "anterior", "proximal"};
  for (int i = 0; i < 6; ++i) {
    const bool turn = i >= 3;
    if (!((*sd)[turn ? 1 : 0] > 0)) continue;
    FreeParameter& made = parameters.emplace_back();
    made.name = fmt::format("{} frame.{}.{}", name, turn ? "turn" : "shift", kAxes[i % 3]);
    made.units = turn ? "rad" : "mm";
    made.kind = kind;
    made.component = i;
    made.prior_sd = (*sd)[turn ? 1 : 0];
  }
}

void add_offsets(const CalibrationDescription& calibration,
                 const MeasurementTable& table,
                 std::vector<FreeParameter>& parameters) {
  if (!calibration.curve_sd) return;
  std::set<std::pair<std::string, std::size_t>> made_for;
  for (const Measurement& row : table.rows) {
    if (row.use != MeasuredUse::kFit || row.kind != MeasuredKind::kJointCoordinate || row.laxity)
      continue;
    const JointCoordinate& coordinate = kJointCoordinates[row.index];
    const double sd = (*calibration.curve_sd)[coordinate.angle ? 1 : 0];
    if (!(sd > 0) || !made_for.insert({row.test, row.index}).second) continue;
    FreeParameter& made = parameters.emplace_back();
    made.name = fmt::format("{}.{} offset", row.test, coordinate.name);
    made.units = coordinate.angle ? "rad" : "mm";
    made.kind = FreeParameter::Kind::kCurveOffset;
    made.test = row.test;
    made.coordinate = row.index;
    made.prior_sd = sd;
  }
}

}  // namespace

std::vector<FreeParameter> free_parameters(const Scene& scene,
                                           const std::vector<TriangleMesh>& meshes,
                                           const MeasurementTable& table) {
  const CalibrationDescription& calibration = scene.calibration.value();
  std::vector<FreeParameter> parameters = free_numbers(
      scene, calibration.parameters, meshes, scene.file.string() + ": [[calibrate.parameter]]");
  add_frame(calibration.femur_frame_sd, FreeParameter::Kind::kFemurFrame, "femur", parameters);
  add_frame(calibration.tibia_frame_sd, FreeParameter::Kind::kTibiaFrame, "tibia", parameters);
  add_offsets(calibration, table, parameters);
  return parameters;
}

}  // namespace condyle
