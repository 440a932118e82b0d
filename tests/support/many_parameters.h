#pragma once

/// Calibrations of any size that nobody computed, for pictures of them: parameters, tests of five
/// coordinates each, bands, profiles and suggestions by smooth formulae.

#include <Eigen/Core>

#include <cmath>
#include <string>
#include <utility>

#include "support/made_up_calibration.h"

namespace condyle::test {

namespace made_up {

inline FreeParameter nth_parameter(int j) {
  static const char* const ligaments[] = {"aACL", "pACL", "aPCL", "pPCL", "aMCL", "sMCL",
                                          "pMCL", "LCL",  "mCAP", "lCAP", "ALL",  "PFL"};
  static const char* const kinds[] = {"reference_strain",       "stiffness",
                                      "insertion.femur.first",  "insertion.femur.second",
                                      "insertion.femur.normal", "insertion.tibia.first",
                                      "insertion.tibia.second", "insertion.tibia.normal"};
  const int kind = j / 12 % 8;
  FreeParameter parameter;
  parameter.name = std::string(ligaments[j % 12]) + "." + kinds[kind];
  parameter.units = kind < 2 ? "1" : "mm";
  parameter.logarithmic = kind == 1;
  parameter.prior_sd = kind == 0 ? 0.03 : kind == 1 ? 0.3 : kind % 3 == 1 ? 0.5 : 2;
  parameter.start = kind == 0 ? 0.02 * std::sin(3.0 * j) : kind == 1 ? 2500 : 0;
  return parameter;
}

/// At a flexion under a load of half and full size both ways and none, five coordinates.
inline void add_curve(MeasurementTable& table,
                      const std::string& test,
                      double flexion,
                      int load,
                      double size,
                      MeasuredUse use) {
  for (const double level : {-size, -size / 2, 0.0, size / 2, size})
    for (std::size_t k = 1; k < 6; ++k) {
      Measurement m = row(static_cast<int>(table.rows.size()) + 2, test.c_str(), flexion,
                          level == 0 ? -1 : load, level, k);
      const double main = load == 0 ? (k == 4 ? 1 : 0.15) : k == 1 ? 1 : 0.2;
      const double unit = k < 3 ? kDegree : 1;
      m.value = unit * 5 * main *
                (std::tanh(1.5 * level / size) + 0.2 * std::sin(flexion + static_cast<double>(k)));
      m.use = use;
      table.rows.push_back(m);
    }
}

}  // namespace made_up

inline std::pair<Scene, CalibrationResult> many_parameters(int parameters, int tests) {
  std::pair<Scene, CalibrationResult> made{made_up_calibration_scene(), {}};
  CalibrationResult& result = made.second;
  result.table.specimen = "k1";
  result.prior_sd.resize(parameters);
  result.fit.theta.resize(parameters);
  for (int j = 0; j < parameters; ++j) {
    result.parameters.push_back(made_up::nth_parameter(j));
    result.prior_sd[j] = result.parameters.back().prior_sd;
    result.fit.theta[j] = result.prior_sd[j] * std::sin(1.7 * j + 1);
  }
  for (int t = 0; t < tests; ++t) {
    const double flexion = 15 * (t / 2);
    const std::string name = (t % 2 ? "vv" : "ap") + std::to_string(static_cast<int>(flexion));
    made_up::add_curve(result.table, name, flexion, t % 2, t % 2 ? 10000 : 100,
                       t % 5 == 3 ? MeasuredUse::kTest : MeasuredUse::kFit);
  }
  const auto n = static_cast<Eigen::Index>(result.table.rows.size());
  Eigen::MatrixXd S(n, parameters);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int j = 0; j < parameters; ++j)
      S(i, j) = 4 * std::exp(-0.06 * j) * std::sin(0.37 * static_cast<double>(i * (j + 1)) + j) /
                (1 + 0.2 * j);
  result.known = made_up::known(S, result.prior_sd);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Measurement& m = result.table.rows[static_cast<std::size_t>(i)];
    const double x = static_cast<double>(i);
    CalibratedRow row;
    row.sd = 1.1 * m.sd;
    row.after = m.value + m.sd * 1.2 * std::sin(9.1 * x);
    row.before = 0.6 * m.value + m.sd * (2 + 2 * std::sin(0.3 * x));
    row.prior_sd = 4 * m.sd;
    row.after_sd = 0.6 * m.sd;
    result.rows.push_back(row);
  }
  result.at_bound.assign(result.parameters.size(), false);
  if (parameters > 5) result.at_bound[5] = true;
  result.sample_sd = result.known.sd;
  if (parameters > 3) result.sample_sd[3] *= 1.3;
  made_up::fill_studies(result);
  for (const char* quantity : {"adduction", "lateral_shift", "distraction", "medial.force",
                               "lateral.force", "pACL.force", "aPCL.force", "pPCL.force"}) {
    Band band = result.bands[0];
    band.quantity = quantity;
    band.units = band.quantity.find("force") != std::string::npos ? "N" : "mm";
    if (band.quantity == "adduction") band.units = "deg";
    result.bands.push_back(band);
  }
  return made;
}

}  // namespace condyle::test
