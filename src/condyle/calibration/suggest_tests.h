#pragma once

/// Which test next: how much each would shrink the posterior, were its predictions linear in θ.

#include "condyle/calibration/calibration.h"

namespace condyle {

/// Flexions 0, 15, 30, 60, 90 deg, each without a load and with each [[calibrate.load]] that the table
/// has, at plus and minus its largest level there. What is measured: the joint coordinates, and the
/// reaction of a held one, with the median sd of such rows of the table (of all angles, of all lengths,
/// where a coordinate itself was not measured); the zero of a curve is as uncertain as curve_sd says.
/// Best first, those without a pose last, with a reason. Needs the fit and what it knows; its poses are
/// counted in `result`.
[[nodiscard]] std::vector<SuggestedTest> suggest_tests(const Scene& scene,
                                                       const std::vector<FittedSurface>& surfaces,
                                                       CalibrationResult& result);

}  // namespace condyle
