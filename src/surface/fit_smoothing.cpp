#include "surface/fit_smoothing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/patch.h"

namespace condyle {
namespace {

constexpr double kReference = 1;  // smoothing length at which the texture is measured [mm]

/// (1/2π) ∫ s(k) weight(H(k)) k dk for texture of unit variance and correlation length l, where the
/// fit passes H = 1/(1 + (ℓk)⁶) of a wave of wave number k.
template <class Weight>
double over_spectrum(double smoothing_length, double l, Weight weight) {
  constexpr int kSteps = 200;
  const double last = 6 / l, step = last / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double k = (i + 0.5) * step;
    const double H = 1 / (1 + std::pow(smoothing_length * k, 6));
    sum += l * l * std::exp(-k * k * l * l / 2) * weight(H) * k * step;
  }
  return sum;
}

/// Share of the texture's variance that a fit leaves beside the patch.
double share_left(double smoothing_length, double l) {
  return over_spectrum(smoothing_length, l, [](double H) { return (1 - H) * (1 - H); });
}
/// Covariance of fit and texture, in units of the texture's variance.
double share_followed(double smoothing_length, double l) {
  return over_spectrum(smoothing_length, l, [](double H) { return H; });
}

/// Mean squared distance of the judged points at right angles to the patch, parameters held.
double mean_square_distance(const SplineGrid& grid,
                            const std::vector<DataPoint>& points,
                            const std::vector<bool>& judged,
                            const DataTerm& data,
                            const PenaltyTerm& penalty,
                            double smoothing_length) {
  const Patch patch(patch_data(grid, solve_fit(data, penalty, smoothing_length)));
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!judged[i]) continue;
    const PatchDerivatives d = patch.derivatives(points[i].uv.x(), points[i].uv.y());
    const double r = d.c_u.cross(d.c_v).stableNormalized().dot(points[i].p - d.c);
    sum += points[i].weight * r * r;
    weight += points[i].weight;
  }
  return sum / std::max(weight, 1e-300);
}

}  // namespace

SmoothingChoice choose_smoothing(const SplineGrid& grid,
                                 const std::vector<DataPoint>& points,
                                 const std::vector<bool>& judged,
                                 const PenaltyTerm& penalty,
                                 const SmoothingOptions& options) {
  assert(judged.size() == points.size());
  const DataTerm data = assemble_data(grid, points);
  const double l = options.texture_correlation;
  const auto left = [&](double length) {
    return mean_square_distance(grid, points, judged, data, penalty, length);
  };
  const double variance = std::max(left(kReference) / share_left(kReference, l),
                                   options.least_texture * options.least_texture);
  const auto expected_error = [&](double length) {
    return left(length) + 2 * variance * share_followed(length, l);
  };

  // Golden section over log ℓ: the error falls while texture is smoothed away and rises when shape
  // is.
  const double golden = (std::sqrt(5.0) - 1) / 2;
  double a = std::log(options.least), b = std::log(options.greatest);
  double x = b - golden * (b - a), y = a + golden * (b - a);
  double at_x = expected_error(std::exp(x)), at_y = expected_error(std::exp(y));
  while (b - a > 0.1) {
    if (at_x < at_y) {
      b = y, y = x, at_y = at_x;
      x = b - golden * (b - a);
      at_x = expected_error(std::exp(x));
    } else {
      a = x, x = y, at_x = at_y;
      y = a + golden * (b - a);
      at_y = expected_error(std::exp(y));
    }
  }
  return {.length = std::exp(at_x < at_y ? x : y), .texture = std::sqrt(variance)};
}

}  // namespace condyle
