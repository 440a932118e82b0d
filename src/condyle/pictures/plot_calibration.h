#pragma once

/// Charts of a knee fitted to measurements. Grey is the knee as the scene has it, with its prior;
/// blue the fitted one, with its posterior; hollow and vermilion what was measured but not fitted.

#include <string>
#include <vector>

#include "condyle/pictures/chart_page.h"

namespace condyle {

struct CalibrationResult;
struct Scene;

/// What was measured over what the knee answers: main coordinates (calibration_curves), the other
/// ones of the same poses (calibration_other_curves).
[[nodiscard]] std::vector<NamedPage> measured_pages(const Scene& scene,
                                                    const CalibrationResult& result);
/// Prior and posterior over flexion, 5 to 95 %: joint and contacts (calibration_bands), ligaments that
/// carry (calibration_ligament_bands).
[[nodiscard]] std::vector<NamedPage> band_pages(const Scene& scene,
                                                const CalibrationResult& result);
/// Correlations of the posterior, and by how much each parameter's deviation shrinks.
[[nodiscard]] std::vector<NamedPage> parameter_pages(const Scene& scene,
                                                     const CalibrationResult& result);
/// Singular values, and the weakest directions.
[[nodiscard]] std::vector<NamedPage> spectrum_pages(const Scene& scene,
                                                    const CalibrationResult& result);
/// χ² along each parameter.
[[nodiscard]] std::vector<NamedPage> profile_pages(const Scene& scene,
                                                   const CalibrationResult& result);
/// Residuals in standard deviations, by test.
[[nodiscard]] std::vector<NamedPage> residual_pages(const Scene& scene,
                                                    const CalibrationResult& result);
/// Tests that were not made, by what they would tell.
[[nodiscard]] std::vector<NamedPage> suggestion_pages(const Scene& scene,
                                                      const CalibrationResult& result);

/// All of the above; those without a value are left out.
[[nodiscard]] std::vector<NamedPage> calibration_pages(const Scene& scene,
                                                       const CalibrationResult& result);

}  // namespace condyle
