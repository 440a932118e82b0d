#pragma once

/// Measured poses of one knee: a tidy table (CSV), a number a row, with the header
///
///     specimen,test,flexion,load,level,coordinate,value,sd,use
///
///   test         name of a curve: poses that were measured in one go
///   flexion      prescribed, unit of the scene's angles
///   load         a name of [[calibrate.load]], or none
///   level        of that load: N, or the unit of moments; of a held coordinate its value
///   coordinate   flexion, adduction, internal_rotation, lateral_shift, anterior_drawer, distraction;
///                reaction: what holds the coordinate of a displacement-controlled test, positive where
///                it drives it to greater values; COORDINATE.laxity: at the level less at the opposite
///                one; LIGAMENT.force, CONTACT.force
///   value, sd    in the scene's units, standard deviation > 0
///   use          fit, test (predicted, never fitted), skip

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/scene/scene.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

enum class MeasuredUse { kFit, kTest, kSkip };
enum class MeasuredKind { kJointCoordinate, kReaction, kLigamentForce, kContactForce };

/// One number, in the units used inside.
struct Measurement {
  int line = 0;        ///< of the file
  std::string test;    ///< the curve
  double flexion = 0;  ///< [rad]
  int load = -1;       ///< of CalibrationDescription::loads; -1: none
  double level = 0;  ///< [N] or [N mm]; [mm] or [rad] under displacement control; 0 without a load
  MeasuredKind kind = MeasuredKind::kJointCoordinate;
  /// kJointCoordinate: the coordinate at the level less that at the opposite one.
  bool laxity = false;
  std::size_t index = 0;  ///< joint coordinate (joint_table.h), ligament or contact
  double value = 0, sd = 1;
  /// Of a relative curve: of the unloaded pose that the value is told from [rad]; empty: at `flexion`.
  std::optional<double> zero_flexion;
  MeasuredUse use = MeasuredUse::kFit;
};

struct MeasurementTable {
  std::filesystem::path file;
  std::string specimen;
  std::vector<Measurement>
      rows;  ///< of that specimen, in the order of the file, none to be skipped
  std::vector<std::string> warnings = {};  ///< what a reader should know of it, one line each
};

/// The table that the scene's [calibrate] names. Throws InputError with file, line and column for what
/// it cannot mean: unknown names, numbers that are none, deviations that are not positive, a row that
/// stands twice, a coordinate that is prescribed in its own test, values that no knee has in the
/// scene's units (angles beyond 180 deg, displacements beyond 200 mm), no row to fit.
[[nodiscard]] MeasurementTable read_measurements(const Scene& scene);

/// The condition that a load of the tests is; null for one that pulls, and for none (-1).
[[nodiscard]] const ConditionDescription* held_condition(int load, const Scene& scene);

/// The level of that load is a moment; false for none (-1) and for a condition that is held.
[[nodiscard]] bool is_moment(int load, const Scene& scene);

/// How a row is called in messages: "knee.csv:7: ap30, 30 deg, anterior 88".
[[nodiscard]] std::string name_of(const Measurement& row,
                                  const MeasurementTable& table,
                                  const Scene& scene);
/// "anterior drawer", "reaction", "force of aACL".
[[nodiscard]] std::string quantity_of(const Measurement& row, const Scene& scene);
/// In which a row is told: "deg", "mm", "N", "N m" or "N mm".
[[nodiscard]] Unit unit_of(const Measurement& row, const Scene& scene);

}  // namespace condyle
