#include "condyle/calibration/measurement_table.h"

#include <fmt/format.h>

#include <cmath>

#include "condyle/elements/joint_table.h"
#include "condyle/input_error.h"

namespace condyle {

const ConditionDescription* held_condition(int load, const Scene& scene) {
  if (load < 0) return nullptr;
  const CalibrationLoad& tested = scene.calibration->loads[static_cast<std::size_t>(load)];
  if (!tested.displacement_control) return nullptr;
  return &scene.conditions[static_cast<std::size_t>(tested.index)];
}

bool is_moment(int load, const Scene& scene) {
  if (load < 0 || held_condition(load, scene)) return false;
  const CalibrationLoad& tested = scene.calibration->loads[static_cast<std::size_t>(load)];
  return scene.loads[static_cast<std::size_t>(tested.index)].moment;
}

std::string name_of(const Measurement& row, const MeasurementTable& table, const Scene& scene) {
  std::string name =
      fmt::format("{}:{}: {}, {:.6g} {}", table.file.string(), row.line, one_line(row.test),
                  row.flexion / scene.angle_to_rad, scene.angle_to_rad == 1 ? "rad" : "deg");
  if (row.load < 0) return name;
  const CalibrationLoad& load = scene.calibration->loads[static_cast<std::size_t>(row.load)];
  double unit = scene.force_to_n;
  if (const ConditionDescription* held = held_condition(row.load, scene))
    unit = is_angle(held->kind) ? scene.angle_to_rad : scene.length_to_mm;
  else if (is_moment(row.load, scene))
    unit = scene.calibration->moment_to_nmm;
  return name + fmt::format(", {} {:.6g}", load.name, row.level / unit);
}

std::string quantity_of(const Measurement& row, const Scene& scene) {
  switch (row.kind) {
    case MeasuredKind::kJointCoordinate:
      return (row.laxity ? "laxity of " : "") + std::string(kJointCoordinates[row.index].words);
    case MeasuredKind::kReaction:
      return "reaction";
    case MeasuredKind::kLigamentForce:
      return "force of " + scene.ligaments[row.index].name;
    case MeasuredKind::kContactForce:
      break;
  }
  return "force of " + scene.contacts[row.index].name;
}

Unit unit_of(const Measurement& row, const Scene& scene) {
  const double to_nmm = scene.calibration ? scene.calibration->moment_to_nmm : 1;
  const Unit degrees = {"deg", M_PI / 180};
  if (row.kind == MeasuredKind::kJointCoordinate)
    return kJointCoordinates[row.index].angle ? degrees : Unit{"mm", 1};
  const bool moment =
      row.kind == MeasuredKind::kReaction && is_angle(scene.conditions[row.index].kind);
  if (!moment) return {"N", 1};
  return to_nmm == 1 ? Unit{"N mm", 1} : Unit{"N m", 1000};
}

}  // namespace condyle
