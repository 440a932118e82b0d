#include "condyle/study/summarise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "condyle/calibration/in_parallel.h"
#include "condyle/design/permutation.h"
#include "condyle/math/no_number.h"
#include "condyle/study/quantiles.h"
#include "condyle/study/sobol_indices.h"

namespace condyle {

namespace {

/// Fewer values than these are told before a thread is there.
constexpr std::size_t kWorthAThread = 50000;

void for_each_pose(const OutputSamples& samples,
                   int threads,
                   const std::function<void(std::size_t)>& work) {
  if (samples.values.size() < kWorthAThread) threads = 1;
  StudyProgress silent({});
  in_parallel(
      "", static_cast<int>(samples.poses), threads,
      [&] { return [&](int pose) { work(static_cast<std::size_t>(pose)); }; }, silent);
}

std::size_t sample_count(const OutputSamples& samples) {
  return samples.poses == 0 ? 0 : samples.values.size() / samples.poses;
}

std::vector<double> known_values(const OutputSamples& samples, std::size_t pose) {
  std::vector<double> known;
  known.reserve(sample_count(samples));
  for (std::size_t i = pose; i < samples.values.size(); i += samples.poses)
    if (!std::isnan(samples.values[i])) known.push_back(samples.values[i]);
  return known;
}

/// In two passes: about the mean. NaN of fewer than two.
double deviation(const std::vector<double>& values, double mean) {
  if (values.size() < 2) return kNoNumber;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

/// To kMostRanked at most, which are drawn: every fourth of a grid, or of Sobol's points, would hold some
/// of what varies fixed.
void thin_out(std::vector<std::uint32_t>& samples) {
  if (samples.size() <= kMostRanked) return;
  constexpr std::uint64_t kSeed = 1, kOfNoDesign = ~std::uint64_t{0};
  const Permutation order(samples.size(), kSeed, kOfNoDesign);
  std::vector<std::uint32_t> drawn(kMostRanked);
  for (std::size_t i = 0; i < kMostRanked; ++i) drawn[i] = samples[order(i)];
  std::sort(drawn.begin(), drawn.end());
  samples = std::move(drawn);
}

/// Else ranks are those of rounding.
bool varies(const std::vector<double>& y) {
  double largest = 0, sum = 0;
  for (const double value : y) {
    largest = std::max(largest, std::abs(value));
    sum += value;
  }
  return deviation(y, sum / static_cast<double>(y.size())) > kLeastDeviation * largest;
}

std::vector<double> correlations_at(const OutputSamples& samples,
                                    const RankedParameters& parameters,
                                    std::size_t pose) {
  std::vector<std::uint32_t> known;
  std::vector<double> y;
  for (std::uint32_t i = 0; i < parameters.samples.size(); ++i) {
    const double value = samples.values[parameters.samples[i] * samples.poses + pose];
    if (std::isnan(value)) continue;
    known.push_back(i);
    y.push_back(value);
  }
  if (!varies(y)) return std::vector<double>(parameters.places.size(), kNoNumber);
  return rank_correlations(parameters.places, known, y);
}

}  // namespace

StudyBand study_band(const OutputSamples& samples,
                     const std::vector<double>& nominal,
                     int threads) {
  StudyBand band;
  band.nominal = nominal;
  band.mean.resize(samples.poses);
  band.sd.resize(samples.poses);
  band.samples.resize(samples.poses);
  for (std::vector<double>& quantile : band.quantiles) quantile.resize(samples.poses);
  for_each_pose(samples, threads, [&](std::size_t pose) {
    std::vector<double> known = known_values(samples, pose);
    const auto n = static_cast<double>(known.size());
    band.samples[pose] = static_cast<long>(known.size());
    band.mean[pose] = std::accumulate(known.begin(), known.end(), 0.) / n;  // NaN of none
    band.sd[pose] = deviation(known, band.mean[pose]);
    const std::vector<double> quantiles = take_quantiles(known, kBandLevels);
    for (std::size_t q = 0; q < quantiles.size(); ++q) band.quantiles[q][pose] = quantiles[q];
  });
  return band;
}

std::vector<std::uint32_t> own_samples(std::size_t samples, std::size_t parameters, bool saltelli) {
  std::vector<std::uint32_t> own;
  for (std::uint32_t k = 0; k < samples; ++k)
    if (!saltelli || k % (parameters + 2) < 2) own.push_back(k);
  return own;
}

RankedParameters ranked_parameters(const std::vector<std::vector<double>>& theta, bool saltelli) {
  RankedParameters ranked;
  ranked.saltelli = saltelli;
  const std::size_t samples = theta.empty() ? 0 : theta.front().size();
  ranked.samples = own_samples(samples, theta.size(), saltelli);
  thin_out(ranked.samples);
  std::vector<double> values(ranked.samples.size());
  for (const std::vector<double>& parameter : theta) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = parameter[ranked.samples[i]];
    ranked.places.push_back(places(values));
  }
  return ranked;
}

StudyEffects study_effects(const OutputSamples& samples,
                           const RankedParameters& parameters,
                           int threads) {
  const std::size_t count = parameters.places.size();
  StudyEffects effects;
  effects.rank.assign(count, std::vector<double>(samples.poses));
  if (parameters.saltelli) {
    assert(sample_count(samples) % (count + 2) == 0);
    effects.first.assign(count, std::vector<IndexEstimate>(samples.poses));
    effects.total = effects.first;
  }
  const std::size_t base_points = sample_count(samples) / (count + 2);
  for_each_pose(samples, threads, [&](std::size_t pose) {
    const std::vector<double> rank = correlations_at(samples, parameters, pose);
    for (std::size_t j = 0; j < count; ++j) effects.rank[j][pose] = rank[j];
    if (!parameters.saltelli) return;
    const SobolIndices indices =
        sobol_indices(samples.values.data() + pose, base_points, count, samples.poses);
    for (std::size_t j = 0; j < count; ++j) {
      effects.first[j][pose] = indices.first[j];
      effects.total[j][pose] = indices.total[j];
    }
  });
  return effects;
}

StudyEffects study_effects(const OutputSamples& samples,
                           const std::vector<std::vector<double>>& theta,
                           bool saltelli) {
  return study_effects(samples, ranked_parameters(theta, saltelli));
}

}  // namespace condyle
