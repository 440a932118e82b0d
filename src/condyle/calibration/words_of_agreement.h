#pragma once

/// Parts of calibration_words.cpp: what is said of the fit, and of how well it meets the rows.

#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"

namespace condyle {

using Lines = std::vector<std::string>;

/// A table: fitted and unseen rows and each test, before and after.
[[nodiscard]] Lines agreement_lines(const CalibrationResult& result);
/// Chi square, and what it says of the model.
[[nodiscard]] Lines chi_square_lines(const CalibrationResult& result);
/// How many starts reached the least, and what became of the others.
[[nodiscard]] Lines start_lines(const CalibrationResult& result);
/// What was done and what it cost; where it stopped.
[[nodiscard]] Lines fit_lines(const CalibrationResult& result);
/// Other equilibria, samples that were lost.
[[nodiscard]] Lines caution_lines(const CalibrationResult& result);
/// Tests that were not made, best first.
[[nodiscard]] Lines suggestion_lines(const Scene& scene, const CalibrationResult& result);

}  // namespace condyle
