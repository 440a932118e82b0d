#pragma once

/// A study made ready: its knees with their surfaces, what varies, the design, and what is kept.
/// Constant, and shared by threads; a sample is a function of the plan and its number.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"
#include "condyle/design/sample_design.h"
#include "condyle/design/spread.h"
#include "condyle/on_progress.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/study_with_scenes.h"
#include "condyle/study/study_output.h"

namespace condyle {

/// One number that varies.
struct StudyParameter {
  std::string name;          ///< "aACL.reference_strain"; of the roughness "roughness.seed"
  std::string units;         ///< of θ: "1", "mm"
  bool logarithmic = false;  ///< θ = ln(number/number of the scene)
  Spread spread;  ///< of the first knee; each is cut at bounds of its own (StudyKnee::parameters)
};

struct StudyKnee {
  std::string name;  ///< of its scene's file, without the ending
  Scene scene;
  std::vector<FittedSurface> surfaces;
  std::vector<FreeParameter> parameters;  ///< kNumber, as StudyPlan::parameters but roughness
  std::vector<StudyOutput> outputs;       ///< as StudyPlan::outputs, each where this scene has it
};

struct StudyPlan {
  StudyDescription study;
  std::vector<StudyKnee> knees;
  std::vector<StudyParameter> parameters;  ///< roughness last
  std::vector<StudyOutput> outputs;
  std::vector<double> values;  ///< of the sweep, of all knees the same [rad], [mm] or [-]
  std::shared_ptr<const SampleDesign> design;  ///< null: the table
  std::vector<std::vector<double>> table;      ///< kTable: θ of each row
  std::uint64_t points = 0;                    ///< of the design, for each knee

  /// Of all knees: sample k is point k % points of knee k / points.
  [[nodiscard]] std::uint64_t samples() const { return points * knees.size(); }
  [[nodiscard]] std::uint64_t point_of(std::uint64_t sample) const { return sample % points; }
  [[nodiscard]] std::size_t knee_of(std::uint64_t sample) const {
    return static_cast<std::size_t>(sample / points);
  }
  /// θ of a sample; of the roughness the point of the unit interval.
  void theta(std::uint64_t sample, std::vector<double>& theta) const;
  /// How many numbers a sample leaves: poses times outputs.
  [[nodiscard]] std::size_t numbers() const { return values.size() * outputs.size(); }
};

/// Fits the surfaces of all knees, and reads the table where there is one (study_table.h). A range of a
/// factor is one of its logarithm. Throws InputError.
[[nodiscard]] StudyPlan study_plan(ReadStudy study, const OnProgress& on_knee = {});

}  // namespace condyle
