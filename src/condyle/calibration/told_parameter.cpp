#include "condyle/calibration/told_parameter.h"

#include <algorithm>
#include <cmath>

#include "condyle/calibration/least_squares_problem.h"
#include "condyle/calibration/told_units.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

double entry(const Eigen::VectorXd& v, Eigen::Index at) {
  return at < v.size() ? v[at] : kNoNumber;
}

/// By how much two deviations may differ, relative: 10 %, or what so many samples leave open.
double parting(Eigen::Index samples) {
  constexpr double kParting = 0.1, kTwoSided = 2;
  const double open =
      kTwoSided / std::sqrt(2.0 * std::max<double>(1, static_cast<double>(samples) - 1));
  return std::max(kParting, open);
}

// Of the prior's deviation: of a number without prior that the data do not tell as much is left.
constexpr double kUnknown = 0.5;

ToldParameter told_of(const CalibrationResult& result, std::size_t j) {
  const FreeParameter& parameter = result.parameters[j];
  const auto at = static_cast<Eigen::Index>(j);
  const Unit unit = unit_for_people(parameter);
  ToldParameter told;
  told.name = parameter.name;
  told.unit = parameter.logarithmic ? "factor" : unit.name;
  const double theta = result.fit.theta[at];
  told.scene = parameter.logarithmic ? 1 : parameter.start / unit.factor;
  told.mean = parameter.logarithmic ? std::exp(theta) : (parameter.start + theta) / unit.factor;
  told.prior_sd = parameter.prior_sd / unit.factor;
  told.sd = entry(result.known.sd, at) / unit.factor;
  told.sample_sd = entry(result.sample_sd, at) / unit.factor;
  told.at_bound = j < result.at_bound.size() && result.at_bound[j];
  // Samples draw what the data and the prior say; where both say nothing they never leave the least.
  const bool is_known = has_prior(parameter.prior_sd) || told.sd < kUnknown * told.prior_sd;
  told.parts = is_known && !told.at_bound &&
               std::abs(told.sample_sd - told.sd) > parting(result.samples.rows()) * told.sd;
  told.shrinkage = told.best_sd() / told.prior_sd;
  return told;
}

}  // namespace

std::vector<ToldParameter> told_parameters(const CalibrationResult& result) {
  std::vector<ToldParameter> told;
  for (std::size_t j = 0; j < result.parameters.size(); ++j) told.push_back(told_of(result, j));
  return told;
}

}  // namespace condyle
