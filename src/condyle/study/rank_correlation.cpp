#include "condyle/study/rank_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "condyle/math/no_number.h"

namespace condyle {

namespace {

/// Twice the ranks of some samples by place, from 0, and the sum of squares of the ranks about their mean.
/// Ties have the middle of their ranks; twice of it is a whole number.
struct Ranks {
  std::vector<std::uint32_t> twice;
  double squares = 0;
};

/// Of all samples but `missing`.
Ranks ranks_without(const Places& places, const std::vector<std::uint32_t>& missing) {
  const bool ties = places.distinct != places.of.size();
  Ranks ranks;
  ranks.twice.assign(places.distinct, ties ? 0 : 1);  // at first how many there are
  if (ties)
    for (const std::uint32_t place : places.of) ++ranks.twice[place];
  for (const std::uint32_t k : missing) --ranks.twice[places.of[k]];
  const double n = static_cast<double>(places.of.size() - missing.size());
  ranks.squares = n * (n * n - 1) / 12;
  std::uint32_t below = 0;
  for (std::uint32_t& rank : ranks.twice) {
    const std::uint32_t count = rank;
    if (ties) ranks.squares -= count * (static_cast<double>(count) * count - 1.) / 12;
    rank = 2 * below + count - 1;
    below += count;
  }
  return ranks;
}

/// Ranks about their mean of all values of a sample, at the places `known` of the result; 0 elsewhere.
std::vector<double> spread_ranks(const Places& y,
                                 const Ranks& ranks,
                                 const std::vector<std::uint32_t>& known,
                                 std::size_t samples) {
  std::vector<double> spread(samples);
  const double twice_mean = static_cast<double>(known.size()) - 1;
  for (std::size_t i = 0; i < known.size(); ++i)
    spread[known[i]] = (ranks.twice[y.of[i]] - twice_mean) / 2;
  return spread;
}

/// Sum of products of y's ranks and of the parameter's about their mean.
double product(const std::vector<double>& y, const Places& places, const Ranks& ranks, double n) {
  std::array<double, 4> sums{};  // of one each addition would wait for the one before it
  const std::uint32_t* of = places.of.data();
  std::size_t i = 0;
  for (; i + 4 <= y.size(); i += 4)
    for (std::size_t c = 0; c < 4; ++c) sums[c] += y[i + c] * (ranks.twice[of[i + c]] - (n - 1));
  for (; i < y.size(); ++i) sums[0] += y[i] * (ranks.twice[of[i]] - (n - 1));
  return ((sums[0] + sums[1]) + (sums[2] + sums[3])) / 2;
}

std::vector<std::uint32_t> all_but(const std::vector<std::uint32_t>& known, std::size_t samples) {
  std::vector<std::uint32_t> missing;
  std::size_t next = 0;
  for (std::uint32_t k = 0; k < samples; ++k)
    if (next < known.size() && known[next] == k)
      ++next;
    else
      missing.push_back(k);
  return missing;
}

}  // namespace

Places places(std::span<const double> values) {
  std::vector<std::pair<double, std::uint32_t>> sorted(values.size());
  for (std::uint32_t k = 0; k < sorted.size(); ++k) sorted[k] = {values[k], k};
  std::sort(sorted.begin(), sorted.end());
  Places places;
  places.of.resize(values.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (i == 0 || sorted[i - 1].first != sorted[i].first) ++places.distinct;
    places.of[sorted[i].second] = places.distinct - 1;
  }
  return places;
}

std::vector<double> rank_correlations(const std::vector<Places>& parameters,
                                      const std::vector<std::uint32_t>& known,
                                      std::span<const double> y) {
  std::vector<double> correlations(parameters.size(), kNoNumber);
  if (known.size() < 3 || parameters.empty()) return correlations;
  const std::size_t samples = parameters.front().of.size();
  const auto n = static_cast<double>(known.size());
  const Places places_y = places(y);
  const Ranks ranks_y = ranks_without(places_y, {});
  const std::vector<double> spread_y = spread_ranks(places_y, ranks_y, known, samples);
  const std::vector<std::uint32_t> missing = all_but(known, samples);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const Ranks ranks = ranks_without(parameters[j], missing);
    const double squares = ranks_y.squares * ranks.squares;
    if (squares > 0)
      correlations[j] = product(spread_y, parameters[j], ranks, n) / std::sqrt(squares);
  }
  return correlations;
}

}  // namespace condyle
