#pragma once

/// A calibration in words and tables, as it is told without being asked.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Lines for people: what the data determine and what they do not, the weakest directions in words
/// ("pPCL.reference_strain: 0.99"), prior to posterior of each parameter, chi square and what it says of
/// the model, errors on fitted and unseen rows before and after with the coverage of their intervals,
/// ligaments that carry nothing, parameters at a bound, starts that found another least, where samples
/// and delta method part.
[[nodiscard]] std::vector<std::string> calibration_lines(const Scene& scene,
                                                         const CalibrationResult& result);

/// Those of these lines that are no rows of a table; what belongs to the line before it begins with two
/// blanks.
[[nodiscard]] std::vector<std::string> calibration_remarks(const Scene& scene,
                                                           const CalibrationResult& result);

/// Directions of the parameters that are not at a bound: the first ones. Those at one follow, a direction each.
[[nodiscard]] Eigen::Index free_directions(const CalibrationResult& result);

/// A line for each of these that is weaker than 1, weakest first, at most `most`: its singular value and
/// the parameters whose share is above 0.3.
[[nodiscard]] std::vector<std::string> weak_directions(const CalibrationResult& result, int most);

/// parameter, unit, scene, prior sd, posterior mean, posterior sd, sample sd, shrinkage, at bound; units as
/// ToldParameter. LaTeX: a tabular of its own, without packages.
[[nodiscard]] std::string parameter_csv(const CalibrationResult& result);
[[nodiscard]] std::string parameter_latex(const CalibrationResult& result);
/// A column for each θ (change from the scene; mm, deg, 1), a row for each sample.
[[nodiscard]] std::string samples_csv(const CalibrationResult& result);

/// The text of the scene with the fitted numbers in place of its own: comments and order stay, only
/// numbers of parameters of the knee change, and a first line says where they are from. Of a text that
/// will stand in another folder, as `file`, relative paths change too. Throws InputError where a number
/// has no place of its own in the text.
[[nodiscard]] std::string fitted_scene_text(const Scene& scene,
                                            const CalibrationResult& result,
                                            const std::filesystem::path& file = {});

}  // namespace condyle
