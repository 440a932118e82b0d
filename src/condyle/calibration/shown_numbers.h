#pragma once

/// Names, values and units of a calibration, as charts and tables have them.

#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// "aACL strain", "aMCL insertion femur normal"
[[nodiscard]] std::string shown_name(const FreeParameter& parameter);
[[nodiscard]] std::string shown_name(std::string name);  ///< "aACL.reference_strain"
[[nodiscard]] std::vector<std::string> shown_names(const CalibrationResult& result);

[[nodiscard]] std::string load_name(const Scene& scene, int load);

/// Of numbers: a minus sign in place of the hyphen before a digit.
[[nodiscard]] std::string with_minus(std::string text);
/// "°" for deg, others as they are.
[[nodiscard]] std::string shown_unit(const std::string& units);
/// 30.000000001 as 30.
[[nodiscard]] std::string shown_degrees(double angle);

/// θ as it is shown: a factor of logarithmic ones, the number itself of those that have one, strains in
/// %, turns in degrees.
[[nodiscard]] double shown_value(const FreeParameter& parameter, double theta);
[[nodiscard]] std::string shown_axis(const FreeParameter& parameter);
/// A standard deviation of θ with its unit; of ln of the factor of logarithmic ones.
[[nodiscard]] std::string shown_deviation(const FreeParameter& parameter, double sd);

}  // namespace condyle
