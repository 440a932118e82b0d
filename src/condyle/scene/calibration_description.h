#pragma once

/// What [calibrate] of a scene asks for: which table of measurements the knee is fitted to, what the
/// names in it mean, and which numbers of the knee are free. Plain data in the units used inside.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/scene/parameter_kind.h"

namespace condyle {

/// What a name in the column `load` of the table means ([[calibrate.load]]).
struct CalibrationLoad {
  std::string name;
  /// Force control: the level is the size of a load, which acts along its vector in the scene.
  /// Displacement control: the level is the value of a condition, which holds in the tests of this
  /// name and is absent from all others.
  bool displacement_control = false;
  int index = -1;  ///< of Scene::loads, or of Scene::conditions
};

/// Numbers that are fitted ([[calibrate.parameter]]): one for each of `of`, three of an insertion.
struct CalibrationParameter {
  ParameterKind what = ParameterKind::kReferenceStrain;
  std::vector<int> of;  ///< of Scene::ligaments; kLoadScale: of Scene::loads
  int body = -1;        ///< kInsertion: on which body
  /// Standard deviation of the prior about the scene's value: [-] of strains, [mm] of lengths and of
  /// insertions in the tangent plane of the bone, of ln k for a stiffness and of ln scale for a load.
  double prior_sd = 0;
  std::optional<double>
      normal_sd;  ///< of insertions along the bone's normal [mm]; absent: prior_sd/4
  /// Of the number itself; of a stiffness or load of the factor on it; of an insertion of its move [mm].
  std::optional<std::array<double, 2>> bounds;
  bool together =
      false;  ///< one change for all: a factor on stiffnesses and loads, else an addition
};

struct CalibrationDescription {
  std::filesystem::path measurements;  ///< CSV, as it can be opened
  std::string specimen;                ///< whose rows are taken; empty: the table has but one
  int flexion = -1;                    ///< the condition that prescribes the flexion of a test
  double moment_to_nmm = 1;            ///< of levels and reactions that are moments
  std::vector<std::string> relative;   ///< curves told from their own unloaded pose
  std::optional<double> huber;         ///< in standard deviations; absent: squares
  /// Sds of nuisance parameters; absent: none. Length [mm] and angle [rad].
  std::optional<std::array<double, 2>> curve_sd;        ///< an offset of each curve and coordinate
  std::optional<std::array<double, 2>> femur_frame_sd;  ///< the frames of the measurement against
  std::optional<std::array<double, 2>> tibia_frame_sd;  ///< the scene's: three shifts, three turns
  double flexion_sd = 0;  ///< of the flexion of a test [rad]: more variance, (dy/dflexion sd)²
  double level_sd = 0;    ///< of the level of a test, of it [-]
  int starts = 8;         ///< of the search for the least, the scene's own the first
  unsigned seed = 1;      ///< of all random numbers
  int samples = 200;      ///< of the posterior
  std::vector<CalibrationLoad> loads;
  std::vector<CalibrationParameter> parameters;
};

}  // namespace condyle
