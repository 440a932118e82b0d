#include "condyle/study/rank_correlation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace condyle {

namespace {

/// Ranks about their mean of the samples that are known, by place: of a group of ties the middle.
std::vector<double> ranks_by_place(const Places& places, const std::vector<std::uint32_t>& known) {
  std::vector<std::uint32_t> count(places.distinct);
  for (const std::uint32_t k : known) ++count[places.of[k]];
  std::vector<double> rank(places.distinct);
  const double middle = (static_cast<double>(known.size()) - 1) / 2;
  double below = 0;
  for (std::size_t place = 0; place < rank.size(); ++place) {
    rank[place] = below + (count[place] - 1.) / 2 - middle;
    below += count[place];
  }
  return rank;
}

/// Ranks of the known samples about their mean.
void ranks_of(const Places& places,
              const std::vector<std::uint32_t>& known,
              std::vector<double>& ranks) {
  ranks.resize(known.size());
  if (places.distinct == known.size() &&
      places.of.size() == known.size()) {  // no ties, none missing
    const double middle = (static_cast<double>(known.size()) - 1) / 2;
    for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i] = places.of[i] - middle;
    return;
  }
  const std::vector<double> by_place = ranks_by_place(places, known);
  for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i] = by_place[places.of[known[i]]];
}

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  std::array<double, 4> sums{};  // as one would have to wait for each addition
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t c = 0; c < 4; ++c) sums[c] += a[i + c] * b[i + c];
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
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
  std::vector<double> correlations(parameters.size(), std::numeric_limits<double>::quiet_NaN());
  if (known.size() < 3) return correlations;
  std::vector<std::uint32_t> all(y.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  std::vector<double> rank_y, rank;
  ranks_of(places(y), all, rank_y);
  const double square_y = dot(rank_y, rank_y);
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    ranks_of(parameters[j], known, rank);
    const double squares = square_y * dot(rank, rank);
    if (squares > 0) correlations[j] = dot(rank, rank_y) / std::sqrt(squares);
  }
  return correlations;
}

}  // namespace condyle
